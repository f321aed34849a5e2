//! Shadows of the relief that bump and normal maps imitate.
//!
//! A tilted shading normal can face grazing light where the relief would lie in its own shadow. The light then ends abruptly at the
//! horizon of the surface. If the relief is taken for a field of GGX microfacets, light from a direction at the angle θᵢ to the surface
//! normal is shadowed by Smith's function of one side, 2/(1 + √(1 + α² tan² θᵢ)), with α² = tan² θ/8 ≤ 1 for a shading normal that is
//! tilted by θ (A. Conty Estevez, P. Lecocq and C. Stein, "A Microfacet-Based Shadowing Function to Solve the Bump Terminator Problem",
//! Ray Tracing Gems 2019, chapter 12).
use super::records::NormalShadowing;
use noisefall_base::math::{F, Lanes, Pick, U, V};
use noisefall_scene::scene::surface::{SHADOWED, is_set};

/// The record of surfaces with these flags of [`noisefall_scene::scene::surface::Surfaces::relief`] and the normal `n`, tilted to `tilted`.
#[inline(always)]
pub(super) fn shadowing_of_normals<L: Lanes>(l: L, flags: U<L>, n: V<L>, tilted: V<L>) -> NormalShadowing<L> {
    let alpha_squared = (tan_squared(l, n.dot(tilted)) * 0.125).min(l.f(1.0));
    NormalShadowing { n, alpha_squared: is_set(flags, SHADOWED).pick(alpha_squared, l.f(0.0)) }
}

impl<L: Lanes> NormalShadowing<L> {
    /// The fraction of the light from the unit direction `wi` that is not shadowed.
    #[inline(always)]
    pub fn towards(&self, l: L, wi: V<L>) -> F<L> {
        let masked = (self.alpha_squared * tan_squared(l, self.n.dot(wi)) + 1.0).sqrt();
        l.f(2.0) / (masked + 1.0)
    }
}

/// tan² θ of a cosine, at most 10⁶.
#[inline(always)]
fn tan_squared<L: Lanes>(l: L, cos: F<L>) -> F<L> {
    let cos_squared = (cos * cos).min(l.f(1.0));
    (l.f(1.0) - cos_squared) / cos_squared.max(l.f(1e-6))
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_base::math::One;

    fn direction(degrees: f32) -> V<One> {
        let (sin, cos) = degrees.to_radians().sin_cos();
        V::splat(One, [sin, 0.0, cos])
    }

    #[test]
    fn a_tilted_normal_shadows_grazing_light() {
        let shadowing = |tilt: f32| {
            let alpha_squared = (tan_squared(One, direction(tilt).z) * 0.125).min(One.f(1.0));
            NormalShadowing { n: direction(0.0), alpha_squared }
        };
        let towards = |tilt: f32, angle: f32| shadowing(tilt).towards(One, direction(angle)).to_array()[0];
        for angle in [0.0, 45.0, 89.0] {
            assert!((towards(0.0, angle) - 1.0).abs() < 1e-6, "nothing is tilted");
        }
        // tan² 45° = 1: α² = 1/8, and at 60° G = 2/(1 + √(1 + 3/8)).
        assert!((towards(45.0, 60.0) - 2.0 / (1.0 + 1.375f32.sqrt())).abs() < 1e-5);
        assert!((towards(45.0, 0.0) - 1.0).abs() < 1e-6, "light from above");
        // Steeper than 70.5°, α is 1.
        assert!((towards(80.0, 45.0) - 2.0 / (1.0 + 2f32.sqrt())).abs() < 1e-5);
        assert!(towards(45.0, 89.999) < 0.01 && towards(45.0, 90.0) > 0.0);
    }
}
