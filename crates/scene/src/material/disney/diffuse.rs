//! The diffuse lobe and the sheen of Disney's BSDF.
use std::f32::consts::FRAC_1_PI;

use noisefall_base::math::{F, Lanes};

/// Schlick's (1 − μ)⁵.
#[inline(always)]
pub fn rise<L: Lanes>(cos: F<L>) -> F<L> {
    let m = (1.0 - cos).max(cos.splat(0.0)).min(cos.splat(1.0));
    let square = m * m;
    square * square * m
}

/// The diffuse lobe of a white base over the cosine of the light, from the cosines of viewer, light, and light to half vector.
///
/// Burley 2015, section 3: Lambert's with a shadow of Fresnel's at grazing angles, and retro-reflection R_r = 2 r cos²θ_d. `flatness`
/// goes towards Burley 2012, section 5.3, Hanrahan and Krueger's diffuse scattering in a thin layer.
#[inline(always)]
pub fn diffuse<L: Lanes>(roughness: F<L>, flatness: F<L>, viewer: F<L>, light: F<L>, half: F<L>) -> F<L> {
    let (there, here) = (rise(light), rise(viewer));
    let retro = 2.0 * roughness * half * half;
    let mut found = (1.0 - 0.5 * here) * (1.0 - 0.5 * there) + retro * (there + here + there * here * (retro - 1.0));
    if flatness.above(0.0).any() {
        let edge = 0.5 * retro - 1.0;
        let scattered = (edge * there + 1.0) * (edge * here + 1.0);
        let flat = 1.25 * (scattered * (1.0 / (light + viewer) - 0.5) + 0.5);
        found = found + (flat - found) * flatness;
    }
    found * FRAC_1_PI
}

/// About the light that white sheen reflects towards a viewer at a cosine, and enough for the directions in which it is brightest.
#[inline(always)]
pub fn sheen_share<L: Lanes>(viewer: F<L>) -> F<L> {
    let m = 1.0 - viewer;
    0.25 * m * m + 0.002
}
