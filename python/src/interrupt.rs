//! Ctrl+C during tasks of the renderer.
use std::{thread, time::Duration};

use crossbeam_channel::{RecvTimeoutError, bounded};
use pyo3::prelude::*;

use crate::errors::RenderError;

/// Time between two looks for signals.
pub const INTERVAL: Duration = Duration::from_millis(50);

/// Raises the exception of a signal that has arrived, such as `KeyboardInterrupt`.
pub fn raise_signal(py: Python) -> PyResult<()> {
    py.check_signals()
}

/// Runs a task on another thread, without the GIL. When a signal arrives, such as Ctrl+C, `stop` asks the task to end, and the
/// exception of the signal is the result.
pub fn interruptible<T: Send>(py: Python, task: impl FnOnce() -> T + Send, stop: &(dyn Fn() + Sync)) -> PyResult<T> {
    let wait = || {
        thread::scope(|scope| {
            let (done, is_done) = bounded(1);
            scope.spawn(move || done.send(task()));
            let mut signal = Ok(());
            loop {
                match is_done.recv_timeout(INTERVAL) {
                    Ok(result) => return signal.map(|()| result),
                    Err(RecvTimeoutError::Disconnected) => return Err(RenderError::new_err("the renderer ended unexpectedly")),
                    Err(RecvTimeoutError::Timeout) if signal.is_ok() => {
                        signal = Python::attach(raise_signal);
                        if signal.is_err() {
                            stop();
                        }
                    }
                    Err(RecvTimeoutError::Timeout) => {}
                }
            }
        })
    };
    py.detach(wait)
}
