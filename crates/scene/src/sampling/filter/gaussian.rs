//! A normal distribution, truncated.
use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use super::{Filter, Placing, WIDTHS};
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters},
    math::{F, Lanes, round::floor},
};

/// A normal distribution, truncated at three standard deviations.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gaussian {
    /// Standard deviation, pixels.
    pub sigma: f32,
}

/// Extent in standard deviations; it excludes 0.27 % of the distribution.
const REACH: f64 = 3.0;

impl Filter {
    /// A Gaussian of half a pixel.
    pub const GAUSSIAN: Filter = Filter::gaussian(0.5);

    /// A Gaussian of a standard deviation in pixels.
    pub const fn gaussian(sigma: f32) -> Filter {
        Filter::Gaussian(Gaussian { sigma })
    }
}

impl Default for Gaussian {
    fn default() -> Self {
        Gaussian { sigma: 0.5 }
    }
}

impl Kind for Gaussian {
    const KIND: Parameter = Parameter::new("gaussian", "A normal distribution, cut off at three standard deviations.");

    fn chosen(&mut self, p: &mut dyn Parameters) {
        p.table(&Self::KIND, self);
    }
}

impl Declare for Gaussian {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const SIGMA: Parameter = Parameter::new("sigma", "Standard deviation.").symbol("σ").unit("pixels").required();
        p.single(&SIGMA, &mut self.sigma, WIDTHS);
    }
}

impl Placing for Gaussian {
    #[inline(always)]
    fn place<L: Lanes>(self, l: L, u: F<L>) -> F<L> {
        gaussian(l, u) * self.sigma + 0.5
    }

    fn density(self, x: f32) -> f32 {
        let y = x / self.sigma;
        // The step that contains it: each has the same probability.
        let step = QUANTILES.partition_point(|row| row[0] <= y).saturating_sub(1);
        let [start, width, ..] = QUANTILES[step];
        if (start..start + width).contains(&y) { 1.0 / (STEPS as f32 * width * self.sigma) } else { 0.0 }
    }

    fn reach(self) -> f32 {
        REACH as f32 * self.sigma
    }

    #[cfg(test)]
    fn distribution(self, x: f64) -> f64 {
        use statrs::distribution::{ContinuousCDF, Normal};
        let normal = Normal::new(0.0, 1.0).unwrap();
        let y = (x / f64::from(self.sigma)).clamp(-REACH, REACH);
        (normal.cdf(y) - normal.cdf(-REACH)) / (normal.cdf(REACH) - normal.cdf(-REACH))
    }
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
        let width = 2.0 * REACH / CELLS as f64;
        let density = |i: usize| (-0.5 * ((i as f64 + 0.5) * width - REACH).powi(2)).exp();
        let sums = std::iter::once(0.0).chain((0..CELLS).scan(0.0, |sum, i| {
            *sum += density(i);
            Some(*sum)
        }));
        sums.collect()
    });
    let target = p * SUMS[CELLS];
    let cell = SUMS.partition_point(|sum| *sum <= target).clamp(1, CELLS) - 1;
    let within = ((target - SUMS[cell]) / (SUMS[cell + 1] - SUMS[cell])).clamp(0.0, 1.0);
    ((cell as f64 + within) / CELLS as f64 * 2.0 - 1.0) * REACH
}
