//! The report: what became of every mutant, and how many were caught in every folder.
use std::{
    collections::{BTreeMap, HashMap},
    fmt::Write,
};

use crate::{
    hunt::Verdict,
    mutant::Mutant,
    suite::Test,
    survivors::{self, Explained},
};

/// The end of a mutant in the report.
enum End<'a> {
    Caught(&'a str, f64),
    Explained(&'a str),
    /// How many tests reach it.
    Survived(usize),
    Unknown,
}

/// How many mutants came to each end.
#[derive(Default)]
struct Count {
    caught: usize,
    /// Explained as doing the same as the program, so that no test could notice.
    equivalent: usize,
    explained: usize,
    survived: usize,
    unknown: usize,
}

impl Count {
    fn add(&mut self, end: &End) {
        *match end {
            End::Caught(..) => &mut self.caught,
            End::Explained(reason) if reason.starts_with("equivalent") => &mut self.equivalent,
            End::Explained(_) => &mut self.explained,
            End::Survived(_) => &mut self.survived,
            End::Unknown => &mut self.unknown,
        } += 1;
    }

    fn row(&self, name: &str) -> String {
        let Count { caught, equivalent, explained, survived, unknown } = self;
        let tried = caught + explained + survived;
        let share = if tried > 0 { format!("{:.1} %", 100.0 * *caught as f64 / tried as f64) } else { String::new() };
        format!("| {name} | {tried} | {caught} | {share} | {explained} | {survived} | {equivalent} | {unknown} |")
    }
}

/// Writes the report as Markdown, and a summary of few lines.
pub fn report(mutants: &[Mutant], verdicts: &[Verdict], explained: &[Explained], tests: &[Test]) -> (String, String) {
    let verdicts: HashMap<&str, &Verdict> = verdicts.iter().map(|verdict| (verdict.key.as_str(), verdict)).collect();
    let end = |mutant: &Mutant| match (verdicts.get(mutant.key().as_str()), explained.iter().find(|row| row.is(mutant))) {
        (Some(Verdict { caught_by: Some(test), seconds, .. }), _) => End::Caught(test, *seconds),
        (_, Some(row)) => End::Explained(&row.reason),
        (Some(verdict), None) => End::Survived(verdict.tests),
        (None, None) => End::Unknown,
    };
    let (mut rows, mut all, mut open) = (String::new(), Count::default(), String::new());
    let mut folders: BTreeMap<&str, Count> = BTreeMap::new();
    for (id, mutant) in (1..).zip(mutants) {
        let end = end(mutant);
        all.add(&end);
        folders.entry(mutant.folder()).or_default().add(&end);
        let what = match &end {
            End::Caught(test, seconds) => format!("{test}, {seconds:.1} s"),
            End::Explained(reason) => format!("explained: {reason}"),
            End::Survived(0) => "**SURVIVED**: not reached".to_owned(),
            End::Survived(tests) => format!("**SURVIVED** {tests} tests"),
            End::Unknown => "not tried yet".to_owned(),
        };
        if matches!(end, End::Survived(_)) {
            open.push_str(&survivors::row_of(mutant, ""));
            open.push('\n');
        }
        let change = survivors::code(&mutant.change());
        let Mutant { file, line, function, .. } = mutant;
        let _ = writeln!(rows, "| {id} | {file}:{line} | {function} | {change} | {what} |");
    }
    let head =
        "| folder | mutants | caught | | explained | survived | equivalent | not tried |\n|---|---|---|---|---|---|---|---|\n";
    let by_folder: String = folders.iter().map(|(folder, count)| format!("{}\n", count.row(folder))).collect();
    let summary = format!("{head}{by_folder}{}\n", all.row("**all**"));
    let mut text = format!("# Mutation run\n\n{summary}");
    for test in tests.iter().filter(|test| !test.baseline.passed) {
        let _ = writeln!(text, "\nLeft out, for it fails without a mutant: `{}`", test.baseline.test);
    }
    let _ = write!(text, "\n## Mutants\n\n| | place | function | change | caught by |\n|---|---|---|---|---|\n{rows}");
    if !open.is_empty() {
        let _ = write!(text, "\n## Rows for SURVIVORS.md\n\nWrite a test, or else the reason.\n\n{open}");
    }
    (text, summary)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::finder;

    #[test]
    fn every_end_is_counted_and_open_rows_can_be_pasted() {
        let mutants = finder::mutants("src/a/b.rs", "fn f() { g(p + 1 < q, r) }").expect("it is Rust");
        let verdict = |mutant: &Mutant, test: Option<&str>| Verdict {
            key: mutant.key(),
            caught_by: test.map(str::to_owned),
            seconds: 0.1,
            tests: 2,
        };
        let row = |mutant, reason| survivors::row_of(mutant, reason);
        let table = format!("||\n||\n{}\n{}\n", row(&mutants[1], "equivalent: both"), row(&mutants[2], "too slow"));
        let explained = survivors::read(&table).expect("it is a table");
        let verdicts = [
            verdict(&mutants[0], Some("lib::a::t")),
            verdict(&mutants[1], None),
            verdict(&mutants[2], None),
            verdict(&mutants[3], None),
        ];
        let (text, summary) = report(&mutants, &verdicts, &explained, &[]);
        let untried = mutants.len() - 4;
        assert!(summary.contains(&format!("| src/a | 3 | 1 | 33.3 % | 1 | 1 | 1 | {untried} |")), "{summary}");
        assert!(text.ends_with(&format!("{}\n", row(&mutants[3], ""))) && text.contains("lib::a::t, 0.1 s"), "{text}");
    }
}
