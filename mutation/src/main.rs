//! Plants mutants in a copy of the package, runs the tests against one after the other, and lists those that no test notices.
//!
//! All mutants are in one build, and an environment variable turns one on (mutant schemata: Untch, Offutt and Harrold 1993).
mod cargo;
mod draw;
mod finder;
mod given;
mod hunt;
mod journal;
mod mutant;
mod operators;
mod pace;
mod package;
mod process;
mod report;
mod schemata;
mod suite;
mod survivors;

use std::{
    collections::{HashMap, HashSet},
    fs,
    path::{Path, PathBuf},
    process::ExitCode,
    time::Instant,
};

use clap::Parser;
use serde::{Deserialize, Serialize, de::DeserializeOwned};

use crate::{draw::Draw, hunt::Verdict, journal::Journal, mutant::Mutant, pace::Pace, package::Package, suite::Test};

/// A result whose error is a sentence.
type Outcome<T> = Result<T, String>;

/// Plants mutants in the source, one at a time, and lists those that no test notices.
///
/// Start it at the top of the repository. Results are kept in target/mutation: stop it at any time, and the same command goes on.
#[derive(Parser)]
struct Options {
    /// How many mutants to draw, besides those of mutation/mutants.toml.
    #[arg(long, default_value_t = 240)]
    count: usize,
    /// Decides which mutants are drawn.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Every mutant of a file or folder, such as crates/render/src/render/film.rs, in place of those that are drawn.
    #[arg(long, value_name = "PATH", conflicts_with = "given")]
    all_in: Option<String>,
    /// The mutants of mutation/mutants.toml alone.
    #[arg(long)]
    given: bool,
    /// A table of mutants in the place of mutation/mutants.toml.
    #[arg(long, value_name = "FILE", requires = "given")]
    mutants: Option<PathBuf>,
    /// Run only the tests whose name contains this text. Their verdicts are kept apart from those of all tests.
    #[arg(long, value_name = "TEXT")]
    tests: Option<String>,
    /// Of the mutants, only those that survived when they were tried last, with the tests of now.
    #[arg(long)]
    survivors: bool,
    /// Try only the mutants of these numbers, again if they were tried before.
    #[arg(long, value_name = "N,N", value_delimiter = ',')]
    only: Vec<u32>,
    /// List the mutants and stop.
    #[arg(long)]
    list: bool,
    /// Mutants to try at a time; as many as there are processors if absent.
    #[arg(long)]
    jobs: Option<usize>,
    /// Compile for AVX2 and one lane only, in half of the time.
    #[arg(long)]
    few_levels: bool,
    /// Leave out tests that take longer than so many seconds: a mutant that only they notice seems to survive.
    #[arg(long, value_name = "SECONDS", default_value_t = f64::INFINITY)]
    longest: f64,
    /// Try mutants that SURVIVORS.md explains, too.
    #[arg(long)]
    explained: bool,
    /// Stop after this long (the build is not interrupted).
    #[arg(long)]
    minutes: Option<f64>,
}

fn main() -> ExitCode {
    match run(&Options::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("mutation: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Outcome<()> {
    let pace = Pace::minutes(options.minutes);
    let top = std::env::current_dir().map_err(|error| error.to_string())?;
    let mut package = Package::read(&top)?;
    if options.few_levels {
        package.leave_levels_out();
    }
    if let Some(jobs) = options.jobs {
        rayon::ThreadPoolBuilder::new().num_threads(jobs).build_global().map_err(|error| error.to_string())?;
    }
    let run = Run { options, package, own: top.join("mutation"), workplace: top.join("target/mutation"), start: Instant::now() };
    let verdicts = run.journal(&run.named("results", "jsonl"), run.package.hash());
    let candidates = run.package.candidates()?;
    run.say(&format!("{} places for mutants", candidates.len()));
    let given = run.given()?;
    let explained = survivors::read(&read(&run.own.join("SURVIVORS.md"))?)?;
    for row in explained.iter().filter(|row| !candidates.iter().chain(&given).any(|mutant| row.is(mutant))) {
        eprintln!("SURVIVORS.md explains a mutant that cannot be made any more: {}", row.name());
    }
    let mutants = run.choose(candidates, given, &verdicts)?;
    if options.list {
        for (id, mutant) in (1..).zip(&mutants) {
            println!("{id:4} {}:{} {} [{}] {}", mutant.file, mutant.line, mutant.function, mutant.operator, mutant.change());
        }
        return Ok(());
    }
    let is_explained = |mutant: &Mutant| !options.explained && explained.iter().any(|row| row.is(mutant));
    let tests = run.try_all(&mutants, &verdicts, is_explained, &pace)?;
    let (text, summary) = report::report(&mutants, &verdicts.read(), &explained, &tests);
    let path = run.workplace.join(run.named("report", "md"));
    fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
    println!("{summary}\n{}", path.display());
    Ok(())
}

struct Run<'a> {
    options: &'a Options,
    package: Package,
    /// Where this tool keeps its tables.
    own: PathBuf,
    /// Where copies and results are.
    workplace: PathBuf,
    start: Instant,
}

impl Run<'_> {
    fn say(&self, what: &str) {
        eprintln!("{:5.0} s  {what}", self.start.elapsed().as_secs_f64());
    }

    /// A file for what the tests that run have found: runs with other tests have another one.
    fn named(&self, stem: &str, extension: &str) -> String {
        match &self.options.tests {
            Some(tests) => format!("{stem}-{}.{extension}", in_file_name(tests)),
            None => format!("{stem}.{extension}"),
        }
    }

    /// The table of mutants that somebody wrote by hand.
    fn table(&self) -> PathBuf {
        self.options.mutants.clone().unwrap_or_else(|| self.own.join("mutants.toml"))
    }

    /// The mutants of that table.
    fn given(&self) -> Outcome<Vec<Mutant>> {
        let table = self.table();
        given::read(&read(&table)?, &table.display().to_string(), &self.package)
    }

    fn journal<T: Serialize + DeserializeOwned>(&self, name: &str, sources: u64) -> Journal<T> {
        Journal::new(self.workplace.join(name), sources)
    }

    /// The mutants that were asked for, without those that do not compile.
    fn choose(&self, mut candidates: Vec<Mutant>, given: Vec<Mutant>, verdicts: &Journal<Verdict>) -> Outcome<Vec<Mutant>> {
        let options = self.options;
        if options.given {
            candidates = given.clone();
        }
        if let Some(path) = &options.all_in {
            let path = path.trim_end_matches('/');
            candidates.retain(|mutant| mutant.file == path || mutant.file.starts_with(&format!("{path}/")));
        }
        if options.survivors {
            let last = verdicts.read_all().into_iter().map(|verdict| (verdict.key, verdict.caught_by.is_none()));
            let last: HashMap<String, bool> = last.collect();
            candidates.retain(|mutant| last.get(&mutant.key()) == Some(&true));
        }
        if candidates.is_empty() {
            return Err("there are no such mutants".to_owned());
        }
        let takes_all = options.given || options.survivors || options.all_in.is_some();
        let mut draw = if takes_all { Draw::all(candidates) } else { Draw::new(candidates, options.count, options.seed) };
        draw.given = if takes_all { Vec::new() } else { given.clone() };
        let rejections: Journal<Rejected> = self.journal("rejected.jsonl", self.package.hash());
        draw.rejected.extend(rejections.read().into_iter().map(|rejected| rejected.key));
        // A copy of its own, so that the one that was built stays as it is.
        let copy = self.workplace.join("check");
        loop {
            let mutants = draw.mutants(true);
            let inserted = self.package.write(&copy, &mutants)?;
            let rejected =
                cargo::build(&copy, &self.workplace.join("build"), &["check", "--lib", "--bins", "--tests"], &inserted)?.rejected;
            self.say(&format!("{} of {} mutants do not compile", rejected.len(), mutants.len()));
            if rejected.is_empty() {
                return Ok(draw.mutants(false));
            }
            let rejected: Vec<&Mutant> = rejected.into_iter().map(|id| &mutants[id as usize - 1]).collect();
            // Others are drawn in place of mutants that were drawn.
            let wrong: Vec<String> = rejected.iter().filter(|mutant| given.contains(mutant)).map(|mutant| mutant.key()).collect();
            if !wrong.is_empty() {
                return Err(format!("mutants of {} do not compile:\n{}", self.table().display(), wrong.join("\n")));
            }
            for mutant in rejected {
                let rejected = Rejected { key: mutant.key() };
                rejections.append(&rejected)?;
                draw.rejected.insert(rejected.key);
            }
        }
    }

    /// Builds the tests, learns what each reaches, and tries the mutants that are not explained and were not tried before.
    fn try_all(
        &self,
        mutants: &[Mutant],
        verdicts: &Journal<Verdict>,
        is_explained: impl Fn(&Mutant) -> bool,
        pace: &Pace,
    ) -> Outcome<Vec<Test>> {
        let copy = self.workplace.join("tree");
        let inserted = self.package.write(&copy, mutants)?;
        let build = cargo::build(&copy, &self.workplace.join("build"), &["build", "--tests"], &inserted)?;
        if !build.rejected.is_empty() {
            return Err(format!("mutants that passed the check do not compile: {:?}", build.rejected));
        }
        self.say("the tests are built");
        let baselines = self.journal("baseline.jsonl", Package::read(&copy)?.hash());
        let wanted = self.options.tests.as_deref().unwrap_or_default();
        let Some(mut tests) = suite::learn(&build.tests, wanted, &copy, &baselines, pace)? else {
            return Err("the time is over before every test has run once; the same command goes on".to_owned());
        };
        self.say("every test has run once");
        tests.retain(|test| test.baseline.seconds <= self.options.longest);
        let known: HashSet<String> = verdicts.read().into_iter().map(|verdict| verdict.key).collect();
        let is_left = |id: u32, mutant: &Mutant| match self.options.only.as_slice() {
            [] => !known.contains(&mutant.key()) && !is_explained(mutant),
            only => only.contains(&id),
        };
        let left: Vec<(u32, &Mutant)> = (1..).zip(mutants).filter(|(id, mutant)| is_left(*id, mutant)).collect();
        hunt::hunt(&left, &tests, &copy, verdicts, pace)?;
        self.say("done");
        Ok(tests)
    }
}

/// The key of a mutant that does not compile.
#[derive(Serialize, Deserialize)]
struct Rejected {
    key: String,
}

/// A text as a part of the name of a file, other ones for other texts: bytes that are neither letters nor digits are escaped.
fn in_file_name(text: &str) -> String {
    let escaped = |byte: u8| match byte {
        b'0'..=b'9' | b'a'..=b'z' | b'A'..=b'Z' | b'_' => char::from(byte).to_string(),
        _ => format!("%{byte:02x}"),
    };
    text.bytes().map(escaped).collect()
}

fn read(path: &Path) -> Outcome<String> {
    fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_texts_have_other_file_names() {
        assert_eq!(in_file_name("validate::a_quick"), "validate%3a%3aa_quick");
        assert_eq!(["a::b", "a__b", "a%3a%3ab"].map(in_file_name), ["a%3a%3ab", "a__b", "a%253a%253ab"]);
    }

    #[test]
    fn another_table_stands_for_the_given_mutants_only() {
        let parse = |arguments: &[&str]| Options::try_parse_from([&["mutation"], arguments].concat());
        assert!(parse(&["--mutants", "a.toml"]).is_err());
        let options = parse(&["--given", "--mutants", "a.toml", "--tests", "b"]).expect("it is allowed");
        assert_eq!((options.mutants, options.tests), (Some("a.toml".into()), Some("b".to_owned())));
    }
}
