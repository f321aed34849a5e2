//! Ctrl+C: the first one asks the program to stop, the second one ends it.
use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use super::messages::{Failure, tell};

/// Exit status of an interrupted program.
pub const INTERRUPTED: u8 = 130;

/// A flag that becomes true when the user interrupts the program. `message` is then printed.
pub fn stop_signal(message: &'static str) -> Result<Arc<AtomicBool>, Failure> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = stop.clone();
    let interrupted = move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(INTERRUPTED.into());
        }
        tell(message);
    };
    ctrlc::set_handler(interrupted).map_err(|error| error.to_string())?;
    Ok(stop)
}
