//! The tests of the package: what each one reaches, and how long it takes.
use std::{
    collections::{BTreeSet, HashMap},
    fs,
    path::{Path, PathBuf},
    process::Command,
    sync::atomic::{AtomicUsize, Ordering::Relaxed},
    time::Duration,
};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::{
    Outcome,
    journal::Journal,
    pace::Pace,
    process::{self, Ended},
};

/// No test takes longer by itself.
const LONGEST: Duration = Duration::from_secs(600);

/// The result of a test when no mutant is on.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Baseline {
    pub test: String,
    pub seconds: f64,
    pub passed: bool,
    /// Numbers of the mutants that it reaches.
    pub reached: BTreeSet<u32>,
}

pub struct Test {
    pub baseline: Baseline,
    executable: PathBuf,
    name: String,
    /// How many mutants it has caught: such tests are tried early.
    pub caught: AtomicUsize,
}

impl Test {
    /// Runs it with a mutant on. It fails if it takes much longer than without.
    pub fn run(&self, folder: &Path, mutant: u32) -> Outcome<process::Run> {
        let limit = Duration::from_secs_f64(3.0 * self.baseline.seconds + 20.0);
        process::run(&self.executable, &[&self.name, "--exact"], folder, ("NOISEFALL_MUTANT", &mutant.to_string()), limit)
    }

    /// Whether it is a test of this folder of the library or the program.
    pub fn is_of(&self, folder: &str) -> bool {
        let top = folder.rsplit_once("src/").map_or("", |(_, below)| below).split('/').next().unwrap_or_default();
        let target = self.baseline.test.split("::").next().unwrap_or_default();
        ["lib", "noisefall"].contains(&target) && !top.is_empty() && self.name.starts_with(&format!("{top}::"))
    }
}

/// The tests in executables whose name contains a text, by the name of their target.
fn list(executables: &[(String, PathBuf)], wanted: &str) -> Outcome<Vec<(String, PathBuf, String)>> {
    let mut tests = Vec::new();
    for (target, executable) in executables {
        let wrong = |error| format!("{} cannot be started: {error}", executable.display());
        let output = Command::new(executable).args(["--list", "--format", "terse"]).output().map_err(wrong)?;
        let names = String::from_utf8_lossy(&output.stdout).into_owned();
        let names = names.lines().filter_map(|line| line.strip_suffix(": test")).filter(|name| name.contains(wanted));
        tests.extend(names.map(|name| (target.clone(), executable.clone(), name.to_owned())));
    }
    if tests.is_empty() { Err(format!("there is no test whose name contains \"{wanted}\"")) } else { Ok(tests) }
}

/// Runs every test alone whose name contains `wanted` and that the journal does not know yet. Returns none if there is no time left
/// for all of them.
pub fn learn(
    executables: &[(String, PathBuf)],
    wanted: &str,
    folder: &Path,
    journal: &Journal<Baseline>,
    pace: &Pace,
) -> Outcome<Option<Vec<Test>>> {
    let tests = list(executables, wanted)?;
    let known: HashMap<String, Baseline> = journal.read().into_iter().map(|known| (known.test.clone(), known)).collect();
    let missing = tests.iter().filter(|(target, _, name)| !known.contains_key(&format!("{target}::{name}"))).count();
    eprintln!("{} tests, {missing} of them to run once without a mutant", tests.len());
    let traces = folder.with_file_name("traces");
    fs::create_dir_all(&traces).map_err(|error| format!("{}: {error}", traces.display()))?;
    let done = AtomicUsize::new(0);
    let learn_one = |(number, (target, executable, name)): (usize, &(String, PathBuf, String))| {
        let test = format!("{target}::{name}");
        let baseline = match known.get(&test) {
            Some(known) => known.clone(),
            None if pace.is_over() => return Ok(None),
            None => {
                let trace = traces.join(number.to_string());
                let baseline = measure(test, executable, name, folder, &trace)?;
                journal.append(&baseline)?;
                let done = 1 + done.fetch_add(1, Relaxed);
                eprint!("\r{done} of {missing}  ");
                baseline
            }
        };
        Ok(Some(Test { baseline, executable: executable.clone(), name: name.clone(), caught: AtomicUsize::new(0) }))
    };
    let tests = tests.par_iter().enumerate().with_max_len(1).map(learn_one).collect::<Outcome<Vec<_>>>()?;
    eprintln!();
    Ok(tests.into_iter().collect())
}

fn measure(test: String, executable: &Path, name: &str, folder: &Path, trace: &Path) -> Outcome<Baseline> {
    let _ = fs::remove_file(trace);
    let variable = ("NOISEFALL_MUTANT_TRACE", &*trace.to_string_lossy());
    let run = process::run(executable, &[name, "--exact"], folder, variable, LONGEST)?;
    let reached = fs::read_to_string(trace).unwrap_or_default().lines().filter_map(|line| line.parse().ok()).collect();
    Ok(Baseline { test, seconds: run.seconds, passed: run.ended == Ended::Passed, reached })
}
