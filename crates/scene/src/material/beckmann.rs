//! The Beckmann distribution of microfacet normals with Smith's shadowing: slopes are distributed normally.
//!
//! Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007, equations 25 and 26. Visible normals are sampled by
//! W. Jakob, "An Improved Visible Normal Sampling Routine for the Beckmann Distribution", 2014: Newton's method inverts the
//! distribution function of the slope in the plane of incidence, expressed by its error function.
use std::f32::consts::{FRAC_1_PI, FRAC_2_SQRT_PI, LN_2};

use super::{ggx::Width, microfacets::Microfacets};
use noisefall_base::math::{
    F, Lanes, Pick, V,
    erf::{bell, erf, inverse_erf},
    exp::log2,
};

/// 1/√π.
const FRAC_1_SQRT_PI: f32 = 0.5 * FRAC_2_SQRT_PI;

/// Beckmann facets of a width.
#[derive(Clone, Copy)]
pub struct Beckmann<W>(pub W);

impl<L: Lanes, W: Width<L>> Microfacets<L> for Beckmann<W> {
    #[inline(always)]
    fn d(self, h: V<L>) -> F<L> {
        let z2 = (h.z * h.z).max(h.z.splat(1e-12));
        let slope = (self.0.squeezed_square(h) / z2).sqrt();
        bell(slope) * FRAC_1_PI / (self.0.area() * (z2 * z2))
    }

    /// Walter et al. 2007, equation 26, without the division by the tangent.
    #[inline(always)]
    fn g1_over_cos(self, w: V<L>) -> F<L> {
        let sin = self.0.stretched_square(w).sqrt().max(w.z.splat(1e-15));
        let cos = w.z.abs();
        let cot = cos / sin;
        2.0 / (cos * (1.0 + erf(cot)) + sin * bell(cot) * FRAC_1_SQRT_PI)
    }

    #[inline(always)]
    fn sample_visible_normal(self, wo: V<L>, u: (F<L>, F<L>)) -> V<L> {
        let (x, y) = self.0.stretch(wo.x, wo.y);
        let sin = (x * x + y * y).sqrt();
        let exists = sin.above(1e-15);
        let safe = sin.max(sin.splat(1e-15));
        let (cos_phi, sin_phi) = (exists.pick(x / safe, sin.splat(1.0)), exists.pick(y / safe, sin.splat(0.0)));
        let along = visible_slope(wo.z / safe, safe / wo.z, u.0);
        let across = inverse_erf(within(2.0 * u.1 - 1.0));
        let (x, y) = self.0.stretch(cos_phi * along - sin_phi * across, sin_phi * along + cos_phi * across);
        V { x: -x, y: -y, z: sin.splat(1.0) }.normalized()
    }
}

/// The slope of a visible facet of width 1 in the plane of incidence, towards the viewer: its density is proportional to
/// (1 − slope tan θ) exp(−slope²) for slopes below cot θ.
#[inline(always)]
fn visible_slope<L: Lanes>(cot: F<L>, tan: F<L>, u: F<L>) -> F<L> {
    let u = u.max(u.splat(1e-6)).min(u.splat(1.0 - 1e-6));
    let most = erf(cot);
    let factor = tan * FRAC_1_SQRT_PI;
    let target = u * (1.0 + most + factor * bell(cot));
    // The solution at grazing incidence, where the function is least linear.
    let mut x = most - (most + 1.0) * erf((log2(u) * -LN_2).sqrt());
    for _ in 0..3 {
        let slope = inverse_erf(x);
        let excess = 1.0 + x + factor * bell(slope) - target;
        x = within((x - excess / (1.0 - slope * tan)).min(most));
    }
    inverse_erf(x)
}

/// The nearest number whose inverse error function is finite.
#[inline(always)]
fn within<L: Lanes>(y: F<L>) -> F<L> {
    const MOST: f32 = 1.0 - 2.0 * f32::EPSILON;
    y.max(y.splat(-MOST)).min(y.splat(MOST))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::{anisotropy::Widths, ggx, microfacets};
    use noisefall_base::math::One;

    fn direction(theta_cos: f32, turn: f32) -> V<One> {
        let sin = ((1.0 - theta_cos) * (1.0 + theta_cos)).sqrt();
        V::splat(One, [sin * turn.cos(), sin * turn.sin(), theta_cos])
    }

    /// ∫ D(h) max(0, w·h) G1(w) dh = cos θ for every direction, and ∫ D(h) h.z dh = 1.
    #[test]
    fn visible_facets_project_to_the_surface() {
        const STEPS: u32 = 400;
        for (alpha, anisotropy) in [(0.05f32, 0.0f32), (0.3, 0.0), (1.0, 0.0), (0.3, 0.6)] {
            let facets = Beckmann(Widths::new(F::<One>(alpha), F(anisotropy)));
            for cos in [1.0f32, 0.6, 0.2, 0.05] {
                let w = direction(cos, 0.7);
                let mut sums = [0.0f64; 2];
                for i in 0..STEPS * STEPS {
                    // Slopes from 0 to 5 widths.
                    let [r, turn] = [i / STEPS, i % STEPS].map(|k| (k as f32 + 0.5) / STEPS as f32);
                    let (slope, phi) = (5.0 * r, turn * std::f32::consts::TAU);
                    let (x, y) = facets.0.stretch(F(slope * phi.cos()), F(slope * phi.sin()));
                    let h = V { x, y, z: F(1.0) }.normalized();
                    let area = f64::from(facets.0.area().0) * f64::from(slope) * f64::from(h.z.0).powi(3);
                    let part = area * f64::from(facets.d(h).0) * 5.0 * std::f64::consts::TAU / f64::from(STEPS * STEPS);
                    sums[0] += part * f64::from(h.z.0);
                    sums[1] += part * f64::from(w.dot(h).0.max(0.0) * facets.g1_over_cos(w).0);
                }
                assert!(sums.iter().all(|sum| (sum - 1.0).abs() < 2e-3), "{alpha} {anisotropy} {cos}: {sums:?}");
            }
        }
    }

    /// α, cos θ, D and G1 of Mitsuba 3.9, whose masking is a rational approximation within 0.35 %.
    const MITSUBA: [[f32; 4]; 3] =
        [[0.3, 0.98, 2.425_127, 1.0], [0.8, 0.7, 0.407_376, 0.993_221_9], [0.8, 0.3, 8.451_537e-6, 0.753_036_3]];

    #[test]
    fn values_are_those_of_mitsuba() {
        for [alpha, cos, d, g1] in MITSUBA {
            let facets = Beckmann(F::<One>(alpha));
            let found = facets.d(direction(cos, 0.4)).0;
            assert!((found - d).abs() < 1e-4 * d, "{alpha} {cos}: {found} {d}");
            let found = microfacets::g1(facets, direction(cos, 0.4)).0;
            assert!((found - g1).abs() < 4e-3 * g1, "{alpha} {cos}: {found} {g1}");
        }
    }

    #[test]
    fn sampled_facets_are_visible_and_finite() {
        for alpha in [ggx::SMOOTH, 0.02, 0.3, 1.0] {
            for cos in [1.0, 0.999_999, 0.5, 0.1, 1e-3] {
                let wo = direction(cos, 2.0);
                for u in super::super::tests::lattice(987, 610).chain([(F(0.0), F(0.0)), (F(0.999_999_9), F(1.0))]) {
                    let h = Beckmann(F::<One>(alpha)).sample_visible_normal(wo, u);
                    assert!((h.length_squared().0 - 1.0).abs() < 1e-5 && h.z.0 > 0.0, "{alpha} {cos}: {:?}", h.lane(0));
                    assert!(h.dot(wo).0 > -1e-5, "{alpha} {cos}: {}", h.dot(wo).0);
                }
            }
        }
    }
}
