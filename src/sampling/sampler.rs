//! Samplers. A path is a point of the infinite-dimensional unit cube; a sampler determines the points of a pixel's samples.
//!
//! Every coordinate is a pure function of (seed, pixel, sample index, dimension): a sample can be repeated at any time, in any
//! order and on any thread, and has the same coordinates. The dimension follows the depth of the path, so that all paths use the
//! same coordinate for the same decision.
use serde::{Deserialize, Serialize};

use super::{
    blue_noise,
    dimension::Dimension,
    independent,
    points::{Points, SampleKeys},
    sobol, stratified,
};
use crate::{
    declare::{Word, Words},
    math::{F, Lanes, U},
};

macro_rules! samplers {
    ($($module:ident::$Kind:ident),+ $(,)?) => {
        /// The point set of a pixel's samples. All samplers are unbiased; they differ in how fast the error falls.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
        #[serde(rename_all = "lowercase")]
        pub enum Sampler {
            $(
                #[doc = concat!("The sampler in `", stringify!($module), ".rs`.")]
                $Kind
            ),+
        }

        impl Sampler {
            /// All samplers, in the order of the catalogue.
            pub const ALL: [Sampler; [$(<$module::$Kind as Points>::WORD.name),+].len()] = [$(Sampler::$Kind),+];

            /// How scene files and people call it.
            pub const fn word(self) -> Word {
                match self {
                    $(Sampler::$Kind => <$module::$Kind as Points>::WORD),+
                }
            }
        }

        impl Words for Sampler {
            fn words() -> &'static [(Word, Self)] {
                const { &[$((<$module::$Kind as Points>::WORD, Sampler::$Kind)),+] }
            }
        }

        impl<L: Lanes> Stream<L> {
            /// One coordinate, in (0, 1).
            #[inline(always)]
            pub fn one(&self, dimension: Dimension) -> F<L> {
                #[cfg(test)]
                super::readings::note(self.keys.pixel, dimension.0, 1);
                match self.sampler {
                    $(Sampler::$Kind => $module::$Kind::one(&self.keys, dimension)),+
                }
            }

            /// Two coordinates, each in (0, 1).
            #[inline(always)]
            pub fn two(&self, dimension: Dimension) -> (F<L>, F<L>) {
                #[cfg(test)]
                super::readings::note(self.keys.pixel, dimension.0, 2);
                match self.sampler {
                    $(Sampler::$Kind => $module::$Kind::two(&self.keys, dimension)),+
                }
            }
        }
    };
}

// The catalogue: a sampler is one file and one line here.
samplers! {
    independent::Independent,
    stratified::Stratified,
    sobol::Sobol,
    blue_noise::BlueNoise,
}

impl Sampler {
    /// What scene file and command line call it.
    pub const fn name(self) -> &'static str {
        self.word().name
    }
}

#[expect(clippy::derivable_impls, reason = "the catalogue marks no variant")]
impl Default for Sampler {
    fn default() -> Self {
        Sampler::Sobol
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
}
