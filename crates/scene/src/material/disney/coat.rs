//! The clear coat of Disney's BSDF.
//!
//! Burley 2012, sections 5.4 and 5.6: facets of the distribution GTR1, D = (α² − 1)/(π ln α² (1 + (α² − 1) cos²θ)), with Schlick's
//! reflectance of an index of 1.5, and the masking of GGX facets of width 0.25. The lobe is C/4 D F G, without the 4 cos θ_o cos θ_i
//! of microfacets.
use std::f32::consts::{FRAC_1_PI, LOG2_E};

use super::{super::microfacets, diffuse::rise};
use noisefall_base::math::{
    F, Lanes, V,
    exp::{exp2_of_negative, log2},
    trig::sin_cos_turns,
};

/// Reflectance at normal incidence.
const HEAD_ON: f32 = 0.04;
/// Width of the facets that mask.
const MASKING: f32 = 0.25;

/// The coat at a point.
#[derive(Clone, Copy)]
pub struct ClearCoat<L: Lanes> {
    /// Its amount C.
    pub weight: F<L>,
    alpha2: F<L>,
}

impl<L: Lanes> ClearCoat<L> {
    #[inline(always)]
    pub fn new(weight: F<L>, gloss: F<L>) -> Self {
        let alpha = 0.1 - gloss * 0.099;
        ClearCoat { weight, alpha2: alpha * alpha }
    }

    /// About the light that it reflects.
    #[inline(always)]
    pub fn share(&self) -> F<L> {
        self.weight * HEAD_ON
    }

    /// D of a normal with z > 0.
    #[inline(always)]
    fn d(&self, h: V<L>) -> F<L> {
        let spread = h.x * h.x + h.y * h.y + self.alpha2 * (h.z * h.z);
        (1.0 - self.alpha2) * (FRAC_1_PI * LOG2_E) / (-log2(self.alpha2) * spread)
    }

    /// f |cos θ_i|, and the pdf of reflections at [`ClearCoat::sample`]. `h` is the half vector, `cos` its cosine to both directions,
    /// and `seen` the one to which Schlick's reflectance belongs.
    #[inline(always)]
    pub fn eval(&self, wo: V<L>, wi: V<L>, h: V<L>, cos: F<L>, seen: F<L>) -> (F<L>, F<L>) {
        let masking = cos.splat(MASKING);
        let unmasked = microfacets::g1(masking, wo) * microfacets::g1(masking, wi);
        let reflected = HEAD_ON + (1.0 - HEAD_ON) * rise(seen);
        let d = self.d(h);
        (0.25 * self.weight * reflected * d * unmasked * wi.z, 0.25 * d * h.z / cos)
    }

    /// Samples a normal with the pdf D cos θ (Burley 2012, section B.2).
    #[inline(always)]
    pub fn sample(&self, u: (F<L>, F<L>)) -> V<L> {
        // α^(2 (1 − u)); the squared sine is computed without a difference from 1.
        let power = exp2_of_negative(log2(self.alpha2) * (1.0 - u.0));
        let sin = (power - self.alpha2).max(power.splat(0.0)).sqrt();
        let cos = (1.0 - power).max(power.splat(0.0)).sqrt();
        let (sin_phi, cos_phi) = sin_cos_turns(u.1);
        V { x: sin * cos_phi, y: sin * sin_phi, z: cos }.normalized()
    }
}
