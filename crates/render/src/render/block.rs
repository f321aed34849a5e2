//! A block of a tile: its sample count, the goal of its samples, and the records of their noise.
use super::{estimate::Doubling, scatter::VarianceParts};

/// Minimum number of samples of every pixel.
pub(super) const UNIFORM: u32 = 4;

/// Pixels that have the same number of samples.
#[derive(Clone, Copy, Default)]
pub(super) struct Block {
    /// Samples taken of every pixel; at most twice `doubled`.
    pub spp: u32,
    /// The power of two of samples at which the last move of the block was recorded; 0 before the first sample.
    pub doubled: u32,
    /// Samples relative to the average, as an exponent to base 2.
    pub rate: i8,
    /// Records of the last three doublings of the number of samples, latest first. Doublings are at 2, 4, 8, … samples.
    pub doublings: [Doubling; 3],
    /// Parts of the variance of its pixels.
    pub parts: VarianceParts,
}

impl Block {
    /// The number of samples in the first of two halves, a power of two; `None` before the second sample.
    pub fn first_half(&self) -> Option<u32> {
        let is_far = 2 * u64::from(self.spp) >= 3 * u64::from(self.doubled);
        let first = if is_far { self.doubled } else { self.doubled / 2 };
        Some(first).filter(|first| (1..self.spp).contains(first))
    }

    /// Whether the number of samples is a power of two whose move is not recorded yet.
    pub fn has_doubled(&self) -> bool {
        self.spp.is_power_of_two() && self.spp > self.doubled
    }

    /// The target number of samples for an average of `spp`, limited to the next doubling.
    pub fn next_goal(&self, spp: u32) -> u32 {
        self.goal(spp).min(self.doubled.saturating_mul(2).max(1))
    }

    /// The target number of samples for an average of `spp`.
    pub fn goal(&self, spp: u32) -> u32 {
        goal(self.rate, spp)
    }
}

/// The number of samples of a block with this rate, for an average of `spp`.
pub(super) fn goal(rate: i8, spp: u32) -> u32 {
    if spp <= UNIFORM {
        return spp;
    }
    let scaled = if rate < 0 { spp >> -rate } else { spp.saturating_mul(1 << rate) };
    scaled.max(UNIFORM)
}
