//! Samplers. A path is a point of the infinite-dimensional unit cube; a sampler determines the points of a pixel's samples.
//!
//! Every coordinate is a pure function of (seed, pixel, sample index, dimension): a sample can be repeated at any time, in any
//! order and on any thread, and has the same coordinates. The dimension follows the depth of the path, so that all paths use the
//! same coordinate for the same decision.
//!
//! A sampler is one file and one line of the catalogue below.
mod bits;
mod blue_noise;
mod independent;
mod points;
mod sobol;
mod stratified;

use self::points::{Points, SampleKeys};
use super::dimension::Dimension;
use noisefall_base::math::{F, Lanes, U};

noisefall_base::declare::word_kinds! {
    /// The point set of a pixel's samples. All samplers are unbiased; they differ in how fast the error falls.
    #[derive(serde::Serialize, serde::Deserialize)]
    #[serde(rename_all = "lowercase")]
    pub enum Sampler: Points, default Sobol {
        independent::Independent,
        stratified::Stratified,
        sobol::Sobol,
        blue_noise::BlueNoise,
    }
    in_sampler
}

impl Sampler {
    /// Whether the samples of a pixel are independent of each other, so that their variance says how well their mean is known.
    pub fn is_independent(self) -> bool {
        in_sampler!(self, S => S::INDEPENDENT)
    }
}

/// The coordinates of a sample for several pixels, one pixel per lane.
#[derive(Clone, Copy)]
pub struct Stream<L: Lanes> {
    sampler: Sampler,
    keys: SampleKeys<L>,
}

impl<L: Lanes> Stream<L> {
    /// Creates the stream. `pixel` is y·2¹⁶ + x, so a pixel keeps its random numbers when the resolution changes.
    #[inline(always)]
    pub fn new(sampler: Sampler, seed: u32, pixel: U<L>, index: U<L>) -> Self {
        Stream { sampler, keys: SampleKeys::new(seed, pixel, index) }
    }

    /// One coordinate, in (0, 1).
    #[inline(always)]
    pub fn one(&self, dimension: Dimension) -> F<L> {
        in_sampler!(self.sampler, S => S::one(&self.keys, dimension))
    }

    /// Two coordinates, each in (0, 1).
    #[inline(always)]
    pub fn two(&self, dimension: Dimension) -> (F<L>, F<L>) {
        in_sampler!(self.sampler, S => S::two(&self.keys, dimension))
    }
}
