//! The GGX distribution of microfacet normals with Smith's shadowing.
//!
//! Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007. Directions are in the local frame, α is the
//! width of the distribution of slopes: one number, or one along x and one along y (`anisotropy.rs`; Heitz, "Understanding the
//! Masking-Shadowing Function in Microfacet-Based BRDFs", 2014, sections 5.3 and 5.4). Squared sines are computed from x and y, never as 1 − cos², so f32 suffices from α = 1e-3
//! to 1.
//!
//! Single scattering uses the separable G = G1(ω_o) G1(ω_i), like Mitsuba's rough conductor, so that references agree; the
//! height-correlated form would be slightly brighter at grazing angles.
use std::f32::consts::FRAC_1_PI;

use super::{ggx, microfacets::Microfacets};
use noisefall_base::math::{F, Lanes, V, trig::sin_cos_turns};

/// Minimum width of a rough surface. f32 directions are too coarse for a narrower peak, so smaller widths are treated as smooth.
pub const SMOOTH: f32 = 1e-3;

/// Width of the distribution: α, or α_x and α_y.
pub trait Width<L: Lanes>: Copy {
    /// α_x x and α_y y.
    fn stretch(self, x: F<L>, y: F<L>) -> (F<L>, F<L>);
    /// (α_x x)² + (α_y y)².
    fn stretched_square(self, w: V<L>) -> F<L>;
    /// (x/α_x)² + (y/α_y)².
    fn squeezed_square(self, w: V<L>) -> F<L>;
    /// α_x α_y.
    fn area(self) -> F<L>;
}

impl<L: Lanes> Width<L> for F<L> {
    #[inline(always)]
    fn stretch(self, x: F<L>, y: F<L>) -> (F<L>, F<L>) {
        (x * self, y * self)
    }

    #[inline(always)]
    fn stretched_square(self, w: V<L>) -> F<L> {
        self * self * (w.x * w.x + w.y * w.y)
    }

    #[inline(always)]
    fn squeezed_square(self, w: V<L>) -> F<L> {
        (w.x * w.x + w.y * w.y) / (self * self)
    }

    #[inline(always)]
    fn area(self) -> F<L> {
        self * self
    }
}

/// Makes a width stand for facets of this distribution.
macro_rules! facets {
    ($Width:ty) => {
        impl<L: Lanes> Microfacets<L> for $Width {
            #[inline(always)]
            fn d(self, h: V<L>) -> F<L> {
                ggx::d(self, h)
            }

            #[inline(always)]
            fn g1_over_cos(self, w: V<L>) -> F<L> {
                ggx::g1_over_cos(self, w)
            }

            #[inline(always)]
            fn sample_visible_normal(self, wo: V<L>, u: (F<L>, F<L>)) -> V<L> {
                ggx::sample_visible_normal(self, wo, u)
            }
        }
    };
}
pub(super) use facets;

facets!(F<L>);

/// Density of microfacet area over normals `h`, h.z ≥ 0: ∫ D(h) h.z dh = 1 (Walter et al. 2007, equation 33).
#[inline(always)]
pub fn d<L: Lanes>(alpha: impl Width<L>, h: V<L>) -> F<L> {
    let e = alpha.squeezed_square(h) + h.z * h.z;
    FRAC_1_PI / (alpha.area() * (e * e))
}

/// G1(w)/|cos θ|, which stays finite at grazing angles.
#[inline(always)]
pub fn g1_over_cos<L: Lanes>(alpha: impl Width<L>, w: V<L>) -> F<L> {
    2.0 / (w.z.abs() + (alpha.stretched_square(w) + w.z * w.z).sqrt())
}

/// Samples a microfacet normal visible from `wo` (wo.z > 0), with the pdf of [`microfacets::visible_normal_pdf`](super::microfacets::visible_normal_pdf); u.0 < 1.
///
/// Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", 2023, listing 3: stretching by α maps the microfacets
/// to a sphere, on which reflections of `wo` are uniform over a cap.
#[inline(always)]
pub fn sample_visible_normal<L: Lanes>(alpha: impl Width<L>, wo: V<L>, u: (F<L>, F<L>)) -> V<L> {
    let (x, y) = alpha.stretch(wo.x, wo.y);
    let stretched = V { x, y, z: wo.z }.normalized();
    let (sin_phi, cos_phi) = sin_cos_turns(u.1);
    // 1 − z of the point of the cap; its sine and the sum of the two heights follow without cancellation.
    let depth = u.0 * (1.0 + stretched.z);
    let sin = (depth * (2.0 - depth)).max(depth.splat(0.0)).sqrt();
    let (x, y) = alpha.stretch(sin * cos_phi + stretched.x, sin * sin_phi + stretched.y);
    let z = (1.0 - u.0) * (1.0 + stretched.z);
    V { x, y, z }.normalized()
}
