//! Signals. Ctrl+C: the first one asks the program to stop, the second one ends it.
use std::sync::{
    Arc, Mutex, PoisonError,
    atomic::{AtomicBool, Ordering},
};

use super::messages::{Failure, tell};

/// Exit status of an interrupted program.
pub const INTERRUPTED: u8 = 130;

/// The message for the first interruption.
static MESSAGE: Mutex<&str> = Mutex::new("");

/// A flag that becomes true when the user interrupts the program. `message` is then printed.
pub fn stop_signal(message: &'static str) -> Result<Arc<AtomicBool>, Failure> {
    now_says(message);
    let stop = Arc::new(AtomicBool::new(false));
    let flag = stop.clone();
    let interrupted = move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(INTERRUPTED.into());
        }
        tell(*MESSAGE.lock().unwrap_or_else(PoisonError::into_inner));
    };
    ctrlc::set_handler(interrupted).map_err(|error| error.to_string())?;
    Ok(stop)
}

/// Changes the message of the first interruption: the program does something else now.
pub fn now_says(message: &'static str) {
    *MESSAGE.lock().unwrap_or_else(PoisonError::into_inner) = message;
}

/// Makes a write beyond the limit on the size of files (`ulimit -f`) an error. By default it ends the program, which leaves parts of files
/// behind.
pub fn survive_size_limits() {
    // Only the handler counts. A system that refuses it ends the program as before.
    #[cfg(unix)]
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
}
