//! Runs a test in a process of its own that cannot hang or take all memory.
use std::{
    os::unix::process::{CommandExt, ExitStatusExt},
    path::Path,
    process::{Command, Stdio},
    thread,
    time::{Duration, Instant},
};

use crate::Outcome;

/// A mutant may ask for any amount of memory, in KiB.
const MEMORY: u64 = 10 << 20;
const STEP: Duration = Duration::from_millis(2);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    Passed,
    Failed,
    /// By a signal: an abort, or what the system did.
    Died,
    TimedOut,
}

pub struct Run {
    pub ended: Ended,
    pub seconds: f64,
}

/// Runs an executable in a folder. Whatever it started ends with it.
pub fn run(executable: &Path, arguments: &[&str], folder: &Path, variable: (&str, &str), limit: Duration) -> Outcome<Run> {
    let mut command = Command::new("sh");
    command.arg("-c").arg(format!("ulimit -v {MEMORY}; exec \"$@\"")).arg("sh").arg(executable).args(arguments);
    command.current_dir(folder).env("CARGO_MANIFEST_DIR", folder).env(variable.0, variable.1).process_group(0);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let start = Instant::now();
    let mut child = command.spawn().map_err(|error| format!("{} cannot be started: {error}", executable.display()))?;
    let ended = loop {
        if let Some(status) = child.try_wait().map_err(|error| error.to_string())? {
            let died = status.signal().is_some();
            break if status.success() {
                Ended::Passed
            } else if died {
                Ended::Died
            } else {
                Ended::Failed
            };
        }
        if start.elapsed() > limit {
            break Ended::TimedOut;
        }
        thread::sleep(STEP);
    };
    let seconds = start.elapsed().as_secs_f64();
    if ended != Ended::Passed {
        // A test that fails may leave a process behind that it started.
        let group = format!("-{}", child.id());
        let _ = Command::new("kill").args(["-KILL", "--", &group]).stderr(Stdio::null()).status();
        let _ = child.wait();
    }
    Ok(Run { ended, seconds })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shell(script: &str) -> Ended {
        let limit = Duration::from_millis(500);
        run(Path::new("/bin/sh"), &["-c", script], Path::new("/"), ("A_VARIABLE", "7"), limit).expect("it starts").ended
    }

    #[test]
    fn every_end_is_told() {
        assert_eq!(shell("test $A_VARIABLE = 7"), Ended::Passed);
        assert_eq!(shell("exit 101"), Ended::Failed);
        assert_eq!(shell("kill -ABRT $$"), Ended::Died);
        assert_eq!(shell("sleep 60 & sleep 60"), Ended::TimedOut);
    }
}
