//! A record of the coordinates that are read, for tests: every decision of a path must have its own coordinates.
use std::cell::RefCell;

use noisefall_base::math::{F, Lanes, U};
use noisefall_scene::sampling::{self, Dimension, Sampler};

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

/// [`sampling::Stream`] that records what is read from it.
#[derive(Clone, Copy)]
pub struct Stream<L: Lanes> {
    stream: sampling::Stream<L>,
    pixel: U<L>,
}

impl<L: Lanes> Stream<L> {
    #[inline(always)]
    pub fn new(sampler: Sampler, seed: u32, pixel: U<L>, index: U<L>) -> Self {
        Stream { stream: sampling::Stream::new(sampler, seed, pixel, index), pixel }
    }

    #[inline(always)]
    pub fn one(&self, dimension: Dimension) -> F<L> {
        self.note(dimension.0, 1);
        self.stream.one(dimension)
    }

    #[inline(always)]
    pub fn two(&self, dimension: Dimension) -> (F<L>, F<L>) {
        self.note(dimension.0, 2);
        self.stream.two(dimension)
    }

    /// Records `count` coordinates, starting at `dimension`.
    fn note(&self, dimension: u32, count: u32) {
        READINGS.with_borrow_mut(|readings| {
            if let Some(readings) = readings {
                let pixel = self.pixel.to_array()[0];
                readings.extend((dimension..dimension + count).map(|coordinate| (pixel, coordinate)));
            }
        });
    }
}
