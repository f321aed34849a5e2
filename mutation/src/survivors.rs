//! The committed table of survivors that are explained.
use crate::{Outcome, mutant::Mutant};

/// A row of the table: a mutant that no test is to catch.
pub struct Explained {
    file: String,
    source: String,
    change: String,
    pub reason: String,
}

impl Explained {
    pub fn is(&self, mutant: &Mutant) -> bool {
        (&self.file, &self.source, &self.change) == (&mutant.file, &mutant.source, &mutant.change())
    }

    pub fn name(&self) -> String {
        format!("{}: `{}`, {}", self.file, self.source, self.change)
    }
}

/// Reads the table of a Markdown text: file, line, change, reason.
pub fn read(text: &str) -> Outcome<Vec<Explained>> {
    let rows = text.lines().enumerate().filter(|(_, line)| line.starts_with('|'));
    // The heading and the rule below it.
    rows.skip(2).map(|(number, line)| row(line).ok_or_else(|| wrong(number + 1))).collect()
}

fn wrong(line: usize) -> String {
    format!("SURVIVORS.md, line {line}: a row has four columns: file, line, change, reason")
}

fn row(line: &str) -> Option<Explained> {
    let cells = line.trim().strip_prefix('|')?.strip_suffix('|')?.replace("\\|", "\0");
    let cells: Vec<String> = cells.split('|').map(|cell| cell.replace('\0', "|").trim().to_owned()).collect();
    let [file, source, change, reason] = <[String; 4]>::try_from(cells).ok()?;
    let code = |cell: String| cell.trim_matches('`').trim().to_owned();
    (!reason.is_empty()).then(|| Explained { file: code(file), source: code(source), change: code(change), reason })
}

/// A cell of a table with code in it.
pub fn code(text: &str) -> String {
    // Two quotes hold one quote.
    let quote = if text.contains('`') { "``" } else { "`" };
    format!("{quote}{}{quote}", text.replace('|', "\\|"))
}

/// The row that explains a mutant, once its reason is written.
pub fn row_of(mutant: &Mutant, reason: &str) -> String {
    format!("| {} | {} | {} | {reason} |", code(&mutant.file), code(&mutant.source), code(&mutant.change()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::finder;

    #[test]
    fn a_row_that_is_written_is_read_again() {
        let mutants = finder::mutants("src/a.rs", "fn f() {\n    if a || b { c }\n}").expect("it is Rust");
        let mutant = mutants.iter().find(|mutant| mutant.operator == "operator").expect("there is one");
        let table =
            format!("# Survivors\n\n| file | line | change | reason |\n|---|---|---|---|\n{}\n", row_of(mutant, "the same"));
        let read = super::read(&table).expect("it is a table");
        assert!(read.len() == 1 && read[0].is(mutant) && read[0].reason == "the same", "{table}");
        assert!(mutants.iter().filter(|other| read[0].is(other)).count() == 1);
    }

    #[test]
    fn a_row_without_a_reason_is_refused() {
        let table = "| file | line | change | reason |\n|---|---|---|---|\n| `a` | `b` | `c` | |\n";
        assert!(read(table).is_err_and(|error| error.contains("line 3")));
    }
}
