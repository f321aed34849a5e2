//! Turns mutants on, one after the other, until a test fails.
use std::{
    path::Path,
    sync::atomic::{AtomicUsize, Ordering::Relaxed},
    time::Instant,
};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::{Outcome, journal::Journal, mutant::Mutant, pace::Pace, process::Ended, suite::Test};

/// The result of the tests of a mutant.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Verdict {
    pub key: String,
    /// The test that failed, and how if not by an assertion.
    pub caught_by: Option<String>,
    pub seconds: f64,
    /// How many tests ran.
    pub tests: usize,
}

/// Tries mutants, each with its number, and keeps what becomes of them. Stops early when the time is over.
pub fn hunt(mutants: &[(u32, &Mutant)], tests: &[Test], folder: &Path, journal: &Journal<Verdict>, pace: &Pace) -> Outcome<()> {
    let done = AtomicUsize::new(0);
    mutants.par_iter().with_max_len(1).try_for_each(|(id, mutant)| {
        let Some(verdict) = judge(*id, mutant, tests, folder, pace)? else { return Ok(()) };
        journal.append(&verdict)?;
        let by = verdict.caught_by.as_deref().map_or("SURVIVED".to_owned(), |test| format!("caught by {test}"));
        let done = 1 + done.fetch_add(1, Relaxed);
        eprintln!(
            "{done}/{} [{id}] {}:{} {} | {by} ({:.1} s)",
            mutants.len(),
            mutant.file,
            mutant.line,
            mutant.change(),
            verdict.seconds
        );
        Ok(())
    })
}

/// Runs the tests that reach a mutant: those of its folder first, then those that are quick and have caught much.
fn judge(id: u32, mutant: &Mutant, tests: &[Test], folder: &Path, pace: &Pace) -> Outcome<Option<Verdict>> {
    let start = Instant::now();
    let mut left: Vec<&Test> = tests.iter().filter(|test| test.baseline.passed && test.baseline.reached.contains(&id)).collect();
    left.sort_by(|a, b| {
        let rank = |test: &Test| (!test.is_of(mutant.folder()), test.baseline.seconds / (1 + test.caught.load(Relaxed)) as f64);
        let ((far_a, cost_a), (far_b, cost_b)) = (rank(a), rank(b));
        far_a.cmp(&far_b).then(cost_a.total_cmp(&cost_b))
    });
    let mut verdict = Verdict { key: mutant.key(), caught_by: None, seconds: 0.0, tests: 0 };
    for test in left {
        if pace.is_over() {
            return Ok(None);
        }
        let run = test.run(folder, id)?;
        verdict.tests += 1;
        let how = match run.ended {
            Ended::Passed => continue,
            Ended::Failed => "",
            Ended::Died => " (died)",
            Ended::TimedOut => " (hung)",
        };
        test.caught.fetch_add(1, Relaxed);
        verdict.caught_by = Some(format!("{}{how}", test.baseline.test));
        break;
    }
    verdict.seconds = start.elapsed().as_secs_f64();
    Ok(Some(verdict))
}
