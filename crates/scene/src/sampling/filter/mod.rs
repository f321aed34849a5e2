//! Pixel filters by importance sampling. The filter is the pdf of a sample's position in the image, so every sample has weight 1
//! and belongs to one pixel only, and pixels stay independent.
//!
//! M. Ernst, M. Stamminger and G. Greiner, "Filter Importance Sampling", IEEE Symposium on Interactive Ray Tracing, 2006.
//!
//! A filter is one file and one line of the catalogue below.
pub mod gaussian;
pub mod pixel_box;
pub mod tent;

use noisefall_base::{
    declare::{Kind, Range},
    math::{F, Lanes},
};

noisefall_base::declare::choices! {
    /// The weight of the light around the centre of a pixel: separable, with integral 1. Lengths are in pixels.
    pub enum Filter, "filter", default pixel_box::Box {
        pixel_box::Box,
        tent::Tent(Tent),
        gaussian::Gaussian(Gaussian),
    }
    in_filter
}

impl Filter {
    /// The position of a sample, measured from the left (upper) edge of its pixel.
    #[inline(always)]
    pub fn place<L: Lanes>(self, l: L, u: F<L>) -> F<L> {
        in_filter!(self, filter => filter.place(l, u))
    }

    /// The filter at `x` in one dimension, measured from the middle of the pixel: the pdf of [`Filter::place`].
    pub fn density(self, x: f32) -> f32 {
        in_filter!(self, filter => filter.density(x))
    }

    /// The distance from the middle of the pixel beyond which the filter is 0.
    pub fn reach(self) -> f32 {
        in_filter!(self, filter => filter.reach())
    }
}

/// Widths of filters, pixels.
const WIDTHS: Range = Range::log(0.01, 16.0);

/// A kind of filter.
trait Placing: Kind {
    /// The position of a sample, measured from the left (upper) edge of its pixel: the inverse of the filter's distribution function.
    fn place<L: Lanes>(self, l: L, u: F<L>) -> F<L>;

    /// See [`Filter::density`].
    fn density(self, x: f32) -> f32;

    /// See [`Filter::reach`].
    fn reach(self) -> f32;

    /// The integral of the filter left of `x`, which is measured from the middle of the pixel.
    #[cfg(test)]
    fn distribution(self, x: f64) -> f64;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chi_squared::chi_squared;
    use noisefall_base::{declare::OneOf, math::One};

    /// The integral of a filter left of `x`, which is measured from the pixel's left edge.
    fn distribution(filter: Filter, x: f64) -> f64 {
        in_filter!(filter, filter => filter.distribution(x - 0.5))
    }

    #[test]
    fn the_density_is_the_slope_of_the_distribution() {
        for filter in Filter::alternatives().into_iter().chain([Filter::tent(0.7)]) {
            // Over steps as wide as those in which a density is constant.
            for i in -40..40 {
                let [a, b] = [i, i + 1].map(|i| f64::from(filter.reach()) * f64::from(i) / 40.0);
                let steps = 1000;
                let at = |k: i32| a + (b - a) * (f64::from(k) + 0.5) / f64::from(steps);
                let mean = (0..steps).map(|k| f64::from(filter.density(at(k) as f32))).sum::<f64>() / f64::from(steps);
                let slope = (distribution(filter, b + 0.5) - distribution(filter, a + 0.5)) / (b - a);
                assert!((mean - slope).abs() < 2e-3, "{filter:?} from {a} to {b}: {mean} {slope}");
            }
            assert_eq!(filter.density(1.01 * filter.reach()), 0.0);
        }
    }

    #[test]
    fn places_are_distributed_as_the_filter() {
        const SAMPLES: u32 = 1 << 20;
        const BINS: usize = 200;
        for filter in Filter::alternatives().into_iter().chain([Filter::tent(0.7)]) {
            let bin_edge = |i: usize| -1.5 + 4.0 * i as f64 / BINS as f64;
            let mut counts = [0.0; BINS];
            for i in 0..SAMPLES {
                let u = (crate::sampling::hash::hash_one(i) >> 9) as f32 / (1 << 23) as f32;
                let x = f64::from(filter.place(One, F(u.max(1e-7))).0);
                counts[((x + 1.5) / 4.0 * BINS as f64) as usize] += 1.0;
            }
            let part = |i| distribution(filter, bin_edge(i + 1)) - distribution(filter, bin_edge(i));
            let expected: Vec<f64> = (0..BINS).map(|i| part(i) * f64::from(SAMPLES)).collect();
            let p = chi_squared(&counts, &expected);
            assert!(p > 1e-4, "{filter:?}: p = {p}");
        }
    }
}
