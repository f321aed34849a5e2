//! The renderer compared with exact solutions.
use std::{
    ops::ControlFlow,
    sync::atomic::{AtomicBool, Ordering},
};

use noisefall::validate::{Effort, Section, Suite, Validation, json};
use pyo3::{prelude::*, types::PyBool};

use crate::interrupt::interruptible;

/// Runs the validation, and returns its report as JSON. `callback` is called with the number, title and verdict of each section when
/// it is finished, and stops the run if it returns `False`.
#[pyfunction]
pub fn validate(py: Python, quick: bool, seed: u32, callback: Option<Py<PyAny>>) -> PyResult<String> {
    let effort = if quick { Effort::Quick } else { Effort::Full };
    let stop = AtomicBool::new(false);
    let run = || {
        let mut failure = Ok(());
        let sections = Validation::new(effort, None, seed).run_while(|number, section| {
            let goes_on = show(callback.as_ref(), number, section).unwrap_or_else(|error| {
                failure = Err(error);
                false
            });
            if goes_on && !stop.load(Ordering::Relaxed) { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        failure.map(|()| json(&sections, Suite::Exact, effort, seed).to_string())
    };
    interruptible(py, run, &|| stop.store(true, Ordering::Relaxed))?
}

fn show(callback: Option<&Py<PyAny>>, number: usize, section: &Section) -> PyResult<bool> {
    let Some(callback) = callback else { return Ok(true) };
    Python::attach(|py| {
        let answer = callback.call1(py, (number, section.title.replace('_', ""), section.holds()))?;
        Ok(!answer.bind(py).is(PyBool::new(py, false)))
    })
}
