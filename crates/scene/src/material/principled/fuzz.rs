//! Fuzz: a layer of fibres that scatters light backwards and at grazing angles.
//!
//! T. Zeltner, B. Burley and M. J.-Y. Chiang, "Practical Multiple-Scattering Sheen Using Linearly Transformed Cosines", SIGGRAPH
//! Talks 2022: f cos θ_i = E(ω_o) D(ω_i), where D is a cosine lobe under a linear map, and integrates to 1. E and the map are the
//! rational fits to the paper's tables that MaterialX uses (S. Hill). The lobe is sampled without error, and is not reciprocal.
use std::f32::consts::{FRAC_1_PI, LOG2_E, TAU};

use crate::sampling::Directions;
use noisefall_base::math::{F, Lanes, Pick, V, exp::exp2_of_negative};

/// Minimum roughness of the fits.
const LEAST: f32 = 0.01;

/// Fuzz seen from ω_o.
#[derive(Clone, Copy)]
pub struct Fuzz<L: Lanes> {
    /// E(ω_o) of white fuzz.
    pub albedo: F<L>,
    /// Unit vector towards the viewer's azimuth.
    x: F<L>,
    y: F<L>,
    /// The inverse of the map takes (x, y, z) in the viewer's frame to (a x + b z, a y, z).
    a: F<L>,
    b: F<L>,
}

impl<L: Lanes> Fuzz<L> {
    #[inline(always)]
    pub fn new(roughness: F<L>, wo: V<L>) -> Self {
        let (mu, r) = (wo.z.min(wo.z.splat(1.0)), roughness.max(wo.z.splat(LEAST)));
        let a = (mu * 2.58126 + r * 0.813703) * r / (1.0 + mu * mu * 0.310327 + mu * r * 2.60994);
        let divisor = mu * 1.71228 - mu * r * 1.71506 + r * r * 1.34174 + 0.0000254053;
        let b = (1.0 - mu).sqrt() * (r - 1.0) * r * r * r / divisor;
        let across = (wo.x * wo.x + wo.y * wo.y).sqrt();
        let tilted = across.above(1e-6);
        let x = tilted.pick(wo.x / across, mu.splat(1.0));
        let y = tilted.pick(wo.y / across, mu.splat(0.0));
        Fuzz { albedo: albedo(mu, r), x, y, a, b }
    }

    /// D(ω_i), which is the pdf of [`Fuzz::sample`]; ω_i is above the surface.
    #[inline(always)]
    pub fn density(&self, wi: V<L>) -> F<L> {
        let along = wi.x * self.x + wi.y * self.y;
        let across = wi.y * self.x - wi.x * self.y;
        let (x, y) = (self.a * along + self.b * wi.z, self.a * across);
        let square = x * x + y * y + wi.z * wi.z;
        let stretch = self.a / square;
        wi.z * stretch * stretch * FRAC_1_PI
    }

    /// Samples a direction.
    #[inline(always)]
    pub fn sample(&self, u: (F<L>, F<L>)) -> V<L> {
        let v = Directions::Cosine.sample(u);
        let (along, across) = ((v.x - v.z * self.b) / self.a, v.y / self.a);
        V { x: along * self.x - across * self.y, y: along * self.y + across * self.x, z: v.z }.normalized()
    }
}

/// E(μ) of fuzz of roughness r.
#[inline(always)]
fn albedo<L: Lanes>(mu: F<L>, r: F<L>) -> F<L> {
    let width = r * (r * 1.58491 + 0.0206607) / (r * (r + 1.32227) + 0.0379424);
    let middle = r * (r * (r * (1.7932 - r * r * 0.95943) - 1.14885) - 0.193854) / (r + 0.046391);
    let rest = r * ((r * 0.119681 - 0.0207818) * r + 0.000654023) / (r * (r - 1.92021) + 1.26264);
    let x = (mu - middle) / width;
    let bell = exp2_of_negative(x * x * (-0.5 * LOG2_E));
    (bell / (width * TAU.sqrt()) + rest).min(mu.splat(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_base::math::One;

    /// The midpoint rule over the hemisphere.
    #[test]
    fn the_density_integrates_to_one_and_fuzz_reflects_less_than_all_light() {
        const STEPS: u32 = 400;
        for roughness in [0.2f32, 0.5, 1.0] {
            for cos in [1.0f32, 0.6, 0.2, 0.05] {
                let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
                let fuzz = Fuzz::new(F::<One>(roughness), V::splat(One, [0.6 * sin, 0.8 * sin, cos]));
                let mut sum = 0.0;
                for i in 0..STEPS * STEPS {
                    let z = ((i / STEPS) as f32 + 0.5) / STEPS as f32;
                    let (y, x) = (((i % STEPS) as f32 + 0.5) / STEPS as f32 * TAU).sin_cos();
                    let across = ((1.0 - z) * (1.0 + z)).sqrt();
                    sum += f64::from(fuzz.density(V::splat(One, [across * x, across * y, z])).0);
                }
                let sum = sum * std::f64::consts::TAU / f64::from(STEPS * STEPS);
                assert!((sum - 1.0).abs() < 5e-3, "{roughness} {cos}: {sum}");
                assert!((0.0..0.95).contains(&fuzz.albedo.0), "{roughness} {cos}: {}", fuzz.albedo.0);
            }
        }
    }
}
