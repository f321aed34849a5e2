//! The rough diffuse base.
//!
//! J. Portsmouth, P. Kutz and S. Hill, "EON: A Practical Energy-Preserving Rough Diffuse BRDF", 2024: Fujii's form of Oren and
//! Nayar's model, and a lobe that restores the light that it loses. It is reciprocal, and Lambert's for roughness 0. The directional
//! albedo is the paper's polynomial, so that a white surface is lossless within 2e-4.
use std::f32::consts::{FRAC_1_PI, PI};

use crate::sampling::Directions;
use noisefall_base::math::{F, Lanes, Pick, V};

/// 1/A − 1 per roughness.
const FALL: f32 = 0.5 - 2.0 / (3.0 * PI);
/// The average albedo of the single scattering is A(1 + this · roughness).
const MEAN: f32 = 2.0 / 3.0 - 28.0 / (15.0 * PI);

/// f cos θ_i of albedo ρ and roughness from 0 to 1, for directions above the surface.
#[inline(always)]
pub fn rough_diffuse<L: Lanes>(rho: V<L>, roughness: F<L>, wo: V<L>, wi: V<L>) -> V<L> {
    let cosine = wi.z * FRAC_1_PI;
    if !roughness.above(0.0).any() {
        return rho * cosine;
    }
    let one = wo.z.splat(1.0);
    let a = 1.0 / (roughness * FALL + 1.0);
    let s = wo.x * wi.x + wo.y * wi.y;
    let tilt = s.above(0.0).pick(s / wo.z.max(wi.z), s);
    let single = a * (roughness * tilt + 1.0);
    let average = a * (roughness * MEAN + 1.0);
    let lost = (one - albedo(roughness, a, wo.z)).max(one.splat(0.0)) * (one - albedo(roughness, a, wi.z)).max(one.splat(0.0));
    // At roughness 0 nothing is lost, and both are 0.
    let further = lost * average / (one - average).max(one.splat(1e-7));
    let again = 1.0 - average;
    let series = V { x: 1.0 - rho.x * again, y: 1.0 - rho.y * again, z: 1.0 - rho.z * again };
    let white = V {
        x: single + rho.x * further / series.x,
        y: single + rho.y * further / series.y,
        z: single + rho.z * further / series.z,
    };
    rho * white * cosine
}

/// Fraction of the directions that are uniform, per roughness: a rough surface seen at a grazing angle sends light back along it,
/// where cosine sampling would have weights of 1/cos θ_i.
const UNIFORM: f32 = 0.6;

/// Samples a direction: some are uniform, the others have the density of the cosine.
#[inline(always)]
pub fn sample<L: Lanes>(roughness: F<L>, u: (F<L>, F<L>)) -> V<L> {
    let share = roughness * UNIFORM;
    let uniform = u.0.lt(share);
    if !uniform.any() {
        return Directions::Cosine.sample(((u.0 - share) / (1.0 - share), u.1));
    }
    let rest = uniform.pick(u.0 / share, (u.0 - share) / (1.0 - share));
    uniform.pick(Directions::Uniform.sample((rest, u.1)), Directions::Cosine.sample((rest, u.1)))
}

/// Pdf of [`sample`] per solid angle, at a cosine above 0.
#[inline(always)]
pub fn pdf<L: Lanes>(roughness: F<L>, cos: F<L>) -> F<L> {
    let share = roughness * UNIFORM;
    Directions::Uniform.pdf(cos) * share + Directions::Cosine.pdf(cos) * (1.0 - share)
}

/// Albedo of the single scattering of a white surface at cosine μ; `a` is its A.
#[inline(always)]
fn albedo<L: Lanes>(roughness: F<L>, a: F<L>, mu: F<L>) -> F<L> {
    let x = 1.0 - mu;
    let g = x * (x * (x * (x * 0.071_443 - 0.332_181_44) + 0.491_881_87) + 0.057_108_53);
    a * (roughness * g + 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_base::math::One;

    fn direction(cos: f32, turn: f32) -> V<One> {
        let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
        V::splat(One, [sin * turn.cos(), sin * turn.sin(), cos])
    }

    #[test]
    fn a_white_surface_loses_nothing() {
        const STEPS: u32 = 300;
        for roughness in [0.0f32, 0.3, 1.0] {
            for cos in [1.0, 0.7, 0.3, 0.1, 0.02] {
                let wo = direction(cos, 0.0);
                let mut sum = 0.0;
                for i in 0..STEPS * STEPS {
                    let z = ((i / STEPS) as f32 + 0.5) / STEPS as f32;
                    let wi = direction(z, ((i % STEPS) as f32 + 0.5) / STEPS as f32 * PI);
                    sum += f64::from(rough_diffuse(V::splat(One, [1.0; 3]), F(roughness), wo, wi).x.0);
                }
                let albedo = sum * std::f64::consts::TAU / f64::from(STEPS * STEPS);
                assert!((albedo - 1.0).abs() < 1e-3, "{roughness} {cos}: {albedo}");
            }
        }
    }

    #[test]
    fn light_and_viewer_can_be_exchanged() {
        let rho = V::splat(One, [0.8, 0.5, 0.1]);
        for (a, b, turn) in [(0.9, 0.2, 0.3), (0.1, 0.5, 2.0), (0.7, 0.7, 3.0)] {
            let (wo, wi) = (direction(a, 0.0), direction(b, turn));
            let (there, back) = (rough_diffuse(rho, F(0.7), wo, wi), rough_diffuse(rho, F(0.7), wi, wo));
            for (there, back) in there.lane(0).into_iter().zip(back.lane(0)) {
                assert!((there / b - back / a).abs() < 1e-6, "{there} {back}");
            }
        }
    }
}
