//! Pixel filters by importance sampling. The filter is the pdf of a sample's position in the image, so every sample has weight 1
//! and belongs to one pixel only, and pixels stay independent.
//!
//! M. Ernst, M. Stamminger and G. Greiner, "Filter Importance Sampling", IEEE Symposium on Interactive Ray Tracing, 2006.
//!
//! A filter is one file and one line of the catalogue below.
pub mod gaussian;
pub mod pixel_box;
pub mod tent;

use crate::{
    declare::{Kind, Range},
    math::{F, Lanes},
};

crate::declare::choices! {
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
}

/// Widths of filters, pixels.
const WIDTHS: Range = Range::log(0.01, 16.0);

/// A kind of filter.
trait Placing: Kind {
    /// The position of a sample, measured from the left (upper) edge of its pixel: the inverse of the filter's distribution function.
    fn place<L: Lanes>(self, l: L, u: F<L>) -> F<L>;

    /// The integral of the filter left of `x`, which is measured from the middle of the pixel.
    #[cfg(test)]
    fn distribution(self, x: f64) -> f64;
}

#[cfg(test)]
mod tests {
    use statrs::distribution::{ChiSquared, ContinuousCDF};

    use super::*;
    use crate::{declare::OneOf, math::One};

    /// The integral of a filter left of `x`, which is measured from the pixel's left edge.
    fn distribution(filter: Filter, x: f64) -> f64 {
        in_filter!(filter, filter => filter.distribution(x - 0.5))
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
