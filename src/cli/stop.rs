//! Ctrl+C: the first time a request to stop, the second time the end.
use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use super::messages::{Failure, tell};

/// The status of a program that ended because it was interrupted.
pub const INTERRUPTED: u8 = 130;

/// Becomes true when the user interrupts the program, which then says `message`.
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
