//! Samplers. A path is a point of the infinite-dimensional unit cube; a sampler determines the points of a pixel's samples.
//!
//! Every coordinate is a pure function of (seed, pixel, sample index, dimension): a sample can be repeated at any time, in any
//! order and on any thread, and has the same coordinates. The dimension follows the depth of the path, so that all paths use the
//! same coordinate for the same decision.
use serde::{Deserialize, Serialize};

use super::{
    bits::reverse,
    blue_noise,
    hash::{GOLDEN, hash, hash_one},
    independent, sobol, stratified,
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
            $($Kind),+
        }

        impl Sampler {
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
                super::readings::note(self.pixel, dimension.0, 1);
                match self.sampler {
                    $(Sampler::$Kind => $module::$Kind::one(self, dimension)),+
                }
            }

            /// Two coordinates, each in (0, 1).
            #[inline(always)]
            pub fn two(&self, dimension: Dimension) -> (F<L>, F<L>) {
                #[cfg(test)]
                super::readings::note(self.pixel, dimension.0, 2);
                match self.sampler {
                    $(Sampler::$Kind => $module::$Kind::two(self, dimension)),+
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

/// The points of a sampler.
pub(super) trait Points {
    const WORD: Word;

    /// One coordinate, in (0, 1).
    fn one<L: Lanes>(stream: &Stream<L>, dimension: Dimension) -> F<L>;

    /// Two coordinates, each in (0, 1).
    fn two<L: Lanes>(stream: &Stream<L>, dimension: Dimension) -> (F<L>, F<L>);
}

/// The coordinate of the unit cube that a decision reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dimension(pub u32);

impl Dimension {
    /// The point within the pixel (two coordinates).
    pub const PIXEL: Dimension = Dimension(0);
    /// The point on the lens (two).
    pub const LENS: Dimension = Dimension(2);
    /// The time between the opening and the closing of the shutter (one).
    pub const TIME: Dimension = Dimension(4);
    const PER_BOUNCE: u32 = 16;

    /// Whether the coordinate belongs to the camera or one of the first three surfaces.
    pub(super) fn is_near(self) -> bool {
        self.0 < 4 * Self::PER_BOUNCE
    }

    /// The direction of the path after its `bounce`-th surface, counted from 1 (two).
    pub fn direction(bounce: u32) -> Dimension {
        Dimension(Self::PER_BOUNCE * bounce)
    }

    /// Whether the path survives after its `bounce`-th surface (one).
    pub fn roulette(bounce: u32) -> Dimension {
        Dimension(Self::PER_BOUNCE * bounce + 2)
    }

    /// The lobe of the BSDF that the direction is sampled from (one).
    pub fn lobe(bounce: u32) -> Dimension {
        Dimension(Self::PER_BOUNCE * bounce + 3)
    }

    /// The choice of the light at the `bounce`-th surface (one).
    pub fn light_choice(bounce: u32) -> Dimension {
        Dimension(Self::PER_BOUNCE * bounce + 4)
    }

    /// The direction to the light (two).
    pub fn light(bounce: u32) -> Dimension {
        Dimension(Self::PER_BOUNCE * bounce + 6)
    }

    /// The cell of an image background (two).
    pub fn cell(bounce: u32) -> Dimension {
        Dimension(Self::PER_BOUNCE * bounce + 8)
    }
}

/// The coordinates of a sample for several pixels, one pixel per lane.
#[derive(Clone, Copy)]
pub struct Stream<L: Lanes> {
    sampler: Sampler,
    pub(super) pixel: U<L>,
    pixel_key: U<L>,
    /// A hash of the seed.
    pub(super) salt: u32,
    index: U<L>,
    /// The index with its bits in reverse order.
    reversed: U<L>,
}

impl<L: Lanes> Stream<L> {
    /// Creates the stream. `pixel` is y·2¹⁶ + x, so a pixel keeps its random numbers when the resolution changes.
    #[inline(always)]
    pub fn new(sampler: Sampler, seed: u32, pixel: U<L>, index: U<L>) -> Self {
        // A factor of its own for every seed: by addition alone one seed's noise would be another's, moved aside.
        let salt = hash_one(seed ^ GOLDEN);
        let pixel_key = hash(pixel * (hash_one(salt) | 1) + salt);
        Stream { sampler, pixel, pixel_key, salt, index, reversed: reverse(index) }
    }

    /// The first sample of the same pixels.
    #[inline(always)]
    pub(super) fn first(&self) -> Self {
        Stream { index: self.splat(0), reversed: self.splat(0), ..*self }
    }

    /// A hash of pixel and sample, distinct for every sample of a pixel.
    #[inline(always)]
    pub(super) fn sample_key(&self) -> U<L> {
        hash(self.pixel_key + self.index * GOLDEN)
    }

    /// A hash of pixel and dimension.
    #[inline(always)]
    pub(super) fn dimension_key(&self, dimension: u32) -> U<L> {
        // Another constant than the sample's key has: else index n and dimension n would share their hash.
        hash((self.pixel_key ^ 0x6a09_e667) + dimension.wrapping_mul(GOLDEN))
    }

    #[inline(always)]
    pub(super) fn reversed_index(&self) -> U<L> {
        self.reversed
    }

    #[inline(always)]
    pub(super) fn splat(&self, x: u32) -> U<L> {
        U(L::splat_int(self.pixel_key.0, x))
    }
}
