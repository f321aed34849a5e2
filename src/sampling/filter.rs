//! Pixel filters by importance sampling. The filter is the pdf of a sample's position in the image, so every sample has weight 1
//! and belongs to one pixel only, and pixels stay independent.
//!
//! M. Ernst, M. Stamminger and G. Greiner, "Filter Importance Sampling", IEEE Symposium on Interactive Ray Tracing, 2006.
use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use crate::{
    declare::{Declare, OneOf, Parameter, Parameters, Range},
    math::{F, Lanes, Pick, round::floor},
};

/// The weight of the light around the centre of a pixel; separable, with integral 1. Lengths are in pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Filter {
    /// The mean over the square of the pixel.
    #[default]
    Box,
    /// Falls linearly to 0 at `radius`.
    Tent {
        /// Half of the width, pixels.
        radius: f32,
    },
    /// A normal distribution, truncated at [`Filter::GAUSSIAN_REACH`] standard deviations.
    Gaussian {
        /// Standard deviation, pixels.
        sigma: f32,
    },
}

impl Filter {
    /// A tent two pixels wide.
    pub const TENT: Filter = Filter::Tent { radius: 1.0 };
    /// A Gaussian of half a pixel.
    pub const GAUSSIAN: Filter = Filter::Gaussian { sigma: 0.5 };
    /// Extent of the Gaussian in standard deviations; it excludes 0.27 % of the distribution.
    pub const GAUSSIAN_REACH: f64 = 3.0;

    /// The position of a sample, measured from the left (upper) edge of its pixel.
    #[inline(always)]
    pub fn place<L: Lanes>(self, l: L, u: F<L>) -> F<L> {
        match self {
            Filter::Box => u,
            Filter::Tent { radius } => tent(u) * radius + 0.5,
            Filter::Gaussian { sigma } => gaussian(l, u) * sigma + 0.5,
        }
    }
}

const TENT: Parameter = Parameter::new("tent", "Falls linearly to 0.");
const GAUSSIAN: Parameter = Parameter::new("gaussian", "A normal distribution, cut off at three standard deviations.");

impl OneOf for Filter {
    const WHAT: &'static str = "filter";

    fn alternatives() -> Vec<Self> {
        vec![Filter::Box, Filter::TENT, Filter::GAUSSIAN]
    }

    fn place(&self) -> usize {
        match self {
            Filter::Box => 0,
            Filter::Tent { .. } => 1,
            Filter::Gaussian { .. } => 2,
        }
    }

    fn name(&self) -> &'static str {
        match self {
            Filter::Box => "box",
            Filter::Tent { .. } => TENT.key,
            Filter::Gaussian { .. } => GAUSSIAN.key,
        }
    }

    fn chosen(&mut self, p: &mut dyn Parameters) {
        match self {
            Filter::Box => {}
            Filter::Tent { .. } => p.table(&TENT, self),
            Filter::Gaussian { .. } => p.table(&GAUSSIAN, self),
        }
    }
}

impl Declare for Filter {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const RADIUS: Parameter = Parameter::new("radius", "Where the tent ends.").unit("pixels").required();
        const SIGMA: Parameter = Parameter::new("sigma", "Standard deviation.").symbol("σ").unit("pixels").required();
        const WIDTHS: Range = Range::log(0.01, 16.0);
        match self {
            Filter::Box => {}
            Filter::Tent { radius } => p.single(&RADIUS, radius, WIDTHS),
            Filter::Gaussian { sigma } => p.single(&SIGMA, sigma, WIDTHS),
        }
    }
}

/// The inverse of the distribution function of 1 − |x| on [−1, 1].
#[inline(always)]
fn tent<L: Lanes>(u: F<L>) -> F<L> {
    let left = (u * 2.0).sqrt() - 1.0;
    let right = 1.0 - (2.0 - u * 2.0).sqrt();
    u.below(0.5).pick(left, right)
}

/// The inverse of the truncated normal distribution with standard deviation 1. The density is taken as constant in each of
/// [`STEPS`] steps of equal probability.
#[inline(always)]
fn gaussian<L: Lanes>(l: L, u: F<L>) -> F<L> {
    let at = u * STEPS as f32;
    let (step, row) = floor(at);
    let [start, width, ..] = l.rows(&QUANTILES, row);
    start + width * (at - step)
}

const STEPS: usize = 1024;

/// Start and width of every step.
static QUANTILES: LazyLock<Vec<[f32; 4]>> = LazyLock::new(|| {
    let edges: Vec<f64> = (0..=STEPS).map(|i| inverse_gaussian(i as f64 / STEPS as f64)).collect();
    edges.windows(2).map(|edge| [edge[0] as f32, (edge[1] - edge[0]) as f32, 0.0, 0.0]).collect()
});

/// Bisects the sum of the density over a fine grid.
fn inverse_gaussian(p: f64) -> f64 {
    const CELLS: usize = 1 << 14;
    static SUMS: LazyLock<Vec<f64>> = LazyLock::new(|| {
        let width = 2.0 * Filter::GAUSSIAN_REACH / CELLS as f64;
        let density = |i: usize| (-0.5 * ((i as f64 + 0.5) * width - Filter::GAUSSIAN_REACH).powi(2)).exp();
        let sums = std::iter::once(0.0).chain((0..CELLS).scan(0.0, |sum, i| {
            *sum += density(i);
            Some(*sum)
        }));
        sums.collect()
    });
    let target = p * SUMS[CELLS];
    let cell = SUMS.partition_point(|sum| *sum <= target).clamp(1, CELLS) - 1;
    let within = ((target - SUMS[cell]) / (SUMS[cell + 1] - SUMS[cell])).clamp(0.0, 1.0);
    ((cell as f64 + within) / CELLS as f64 * 2.0 - 1.0) * Filter::GAUSSIAN_REACH
}

#[cfg(test)]
mod tests {
    use statrs::distribution::{ChiSquared, ContinuousCDF, Normal};

    use super::*;
    use crate::math::One;

    /// The integral of a filter left of `x`, which is measured from the pixel's left edge.
    fn distribution(filter: Filter, x: f64) -> f64 {
        let from_center = x - 0.5;
        match filter {
            Filter::Box => x.clamp(0.0, 1.0),
            Filter::Tent { radius } => {
                let y = (from_center / f64::from(radius)).clamp(-1.0, 1.0);
                if y < 0.0 { 0.5 * (1.0 + y).powi(2) } else { 1.0 - 0.5 * (1.0 - y).powi(2) }
            }
            Filter::Gaussian { sigma } => {
                let normal = Normal::new(0.0, 1.0).unwrap();
                let reach = Filter::GAUSSIAN_REACH;
                let y = (from_center / f64::from(sigma)).clamp(-reach, reach);
                (normal.cdf(y) - normal.cdf(-reach)) / (normal.cdf(reach) - normal.cdf(-reach))
            }
        }
    }

    #[test]
    fn places_are_distributed_as_the_filter() {
        const SAMPLES: u32 = 1 << 20;
        const BINS: usize = 200;
        for filter in [Filter::Box, Filter::TENT, Filter::Tent { radius: 0.7 }, Filter::GAUSSIAN] {
            let bin_edge = |i: usize| -1.5 + 4.0 * i as f64 / BINS as f64;
            let mut counts = [0.0; BINS];
            for i in 0..SAMPLES {
                let u = (crate::sampling::hash::hash_one(i) >> 9) as f32 / (1 << 23) as f32;
                let x = f64::from(filter.place(One, F(u.max(1e-7))).0);
                counts[((x + 1.5) / 4.0 * BINS as f64) as usize] += 1.0;
            }
            let mut statistic = 0.0;
            let mut bins = 0.0;
            for (i, count) in counts.iter().enumerate() {
                let expected = (distribution(filter, bin_edge(i + 1)) - distribution(filter, bin_edge(i))) * f64::from(SAMPLES);
                if expected < 5.0 {
                    continue;
                }
                statistic += (count - expected).powi(2) / expected;
                bins += 1.0;
            }
            let p = 1.0 - ChiSquared::new(bins - 1.0).unwrap().cdf(statistic);
            assert!(p > 1e-4, "{filter:?}: p = {p}");
        }
    }
}
