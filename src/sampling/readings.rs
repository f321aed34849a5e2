//! A record of the coordinates that are read, for tests: every decision of a path must have its own coordinates.
use std::cell::RefCell;

use crate::math::{Lanes, U};

/// A pixel, and a coordinate of its samples.
pub type Reading = (u32, u32);

thread_local! {
    static READINGS: RefCell<Option<Vec<Reading>>> = const { RefCell::new(None) };
}

/// Runs `work`, and returns the coordinates that the first lane reads on this thread.
pub fn readings_of(work: impl FnOnce()) -> Vec<Reading> {
    READINGS.set(Some(Vec::new()));
    work();
    READINGS.take().unwrap_or_default()
}

/// Records `count` coordinates, starting at `dimension`.
pub(super) fn note<L: Lanes>(pixel: U<L>, dimension: u32, count: u32) {
    READINGS.with_borrow_mut(|readings| {
        if let Some(readings) = readings {
            let pixel = pixel.to_array()[0];
            readings.extend((dimension..dimension + count).map(|coordinate| (pixel, coordinate)));
        }
    });
}
