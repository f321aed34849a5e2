//! Averages of the clear coat of plastics.
//!
//! Mitsuba's plastics are linear in their color unless they are `nonlinear`: f = ρ T T/(π η² (1 − R)). Ours are not:
//! f = ρ' T T/(π (η² (1 − ρ') + ρ' T̄)). For every ρ there is a ρ' with the same f.
use std::f64::consts::TAU;

use crate::material::{fresnel::dielectric_average, ggx::SMOOTH};

/// Averages over diffuse light.
pub struct Coat {
    /// η².
    square: f64,
    /// T̄, what enters from outside.
    enters: f64,
    /// R, what comes back from inside.
    returns: f64,
}

/// Points of the integrals.
const ANGLES: usize = 128;
const FACETS: usize = 16;

impl Coat {
    /// The coat of a relative index and a GGX width, 0 for a smooth one.
    pub fn new(eta: f64, alpha: f64) -> Coat {
        let square = eta * eta;
        if alpha < f64::from(SMOOTH) {
            let enters = 1.0 - f64::from(dielectric_average(eta as f32));
            // By reciprocity of the interface, η² (1 − R) = T̄.
            return Coat { square, enters, returns: 1.0 - enters / square };
        }
        Coat { square, enters: 1.0 - average(eta, alpha), returns: average(1.0 / eta, alpha) }
    }

    /// The albedo of our plastic that reflects as much as Mitsuba's linear one.
    pub fn of_linear(&self, albedo: f64) -> f64 {
        let base = albedo / (1.0 - self.returns);
        self.of_base(base)
    }

    /// The same of its nonlinear one.
    pub fn of_nonlinear(&self, albedo: f64) -> f64 {
        let base = albedo / (1.0 - albedo * self.returns);
        self.of_base(base)
    }

    /// The color of Mitsuba's nonlinear plastic that reflects as much as ours of an albedo: the inverse of
    /// [`of_nonlinear`](Coat::of_nonlinear).
    pub fn nonlinear_of(&self, albedo: f64) -> f64 {
        let base = albedo / (1.0 - albedo * (1.0 - self.enters / self.square));
        (base / (1.0 + base * self.returns)).clamp(0.0, 1.0)
    }

    /// With f = b T T/(π η²) for the base b.
    fn of_base(&self, base: f64) -> f64 {
        (base / (1.0 + base * (1.0 - self.enters / self.square))).clamp(0.0, 1.0)
    }
}

/// 2 ∫ E(μ) μ dμ of the reflected light E.
fn average(eta: f64, alpha: f64) -> f64 {
    let mean = |i: usize| {
        // Uniform in μ², which takes the weight 2 μ dμ.
        let mu = ((i as f64 + 0.5) / ANGLES as f64).sqrt();
        reflected(mu, eta, alpha)
    };
    (0..ANGLES).map(mean).sum::<f64>() / ANGLES as f64
}

/// E(μ): Fresnel's reflectance times Smith's G1 of the reflected direction, over the visible facets. Dupuy and Benyoub, "Sampling
/// Visible GGX Normals with Spherical Caps", 2023.
fn reflected(mu: f64, eta: f64, alpha: f64) -> f64 {
    let wo = [(1.0 - mu * mu).sqrt(), 0.0, mu];
    let stretched = normalized([wo[0] * alpha, 0.0, wo[2]]);
    let facet = |i: usize| {
        let (u, v) = ((i / FACETS) as f64 + 0.5, (i % FACETS) as f64 + 0.5);
        let (sin_phi, cos_phi) = (TAU * v / FACETS as f64).sin_cos();
        let z = 1.0 - u / FACETS as f64 * (1.0 + stretched[2]);
        let sin = (1.0 - z * z).max(0.0).sqrt();
        let h = normalized([alpha * (sin * cos_phi + stretched[0]), alpha * sin * sin_phi, z + stretched[2]]);
        let cos = wo[0] * h[0] + wo[2] * h[2];
        let wi_z = 2.0 * cos * h[2] - wo[2];
        if wi_z <= 0.0 { 0.0 } else { fresnel(cos, eta) * g1(wi_z, alpha) }
    };
    (0..FACETS * FACETS).map(facet).sum::<f64>() / (FACETS * FACETS) as f64
}

/// Smith's masking of GGX (Walter et al. 2007, equation 34).
fn g1(cos: f64, alpha: f64) -> f64 {
    let tan2 = (1.0 - cos * cos).max(0.0) / (cos * cos);
    2.0 / (1.0 + (1.0 + alpha * alpha * tan2).sqrt())
}

/// Fresnel's reflectance of unpolarised light.
fn fresnel(cos: f64, eta: f64) -> f64 {
    let sin2 = (1.0 - cos * cos) / (eta * eta);
    if sin2 >= 1.0 {
        return 1.0;
    }
    let inside = (1.0 - sin2).sqrt();
    let parallel = (eta * cos - inside) / (eta * cos + inside);
    let perpendicular = (cos - eta * inside) / (cos + eta * inside);
    0.5 * (parallel * parallel + perpendicular * perpendicular)
}

fn normalized(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nonlinear_smooth_plastics_are_ours() {
        for eta in [1.3, 1.49, 1.9] {
            let coat = Coat::new(eta, 0.0);
            for albedo in [0.0, 0.3, 0.9, 1.0] {
                assert!((coat.of_nonlinear(albedo) - albedo).abs() < 1e-9, "{eta} {albedo}");
            }
        }
    }

    #[test]
    fn coats_that_are_almost_smooth_are_like_smooth_ones() {
        let [smooth, rough] = [0.0, 0.002].map(|alpha| Coat::new(1.49, alpha));
        assert!((smooth.enters - rough.enters).abs() < 2e-3, "{} {}", smooth.enters, rough.enters);
        assert!((smooth.returns - rough.returns).abs() < 1e-2, "{} {}", smooth.returns, rough.returns);
    }

    #[test]
    fn colours_of_nonlinear_plastics_come_back() {
        for alpha in [0.0, 0.1, 0.5] {
            let coat = Coat::new(1.5, alpha);
            for albedo in [0.0, 0.2, 0.7] {
                assert!((coat.of_nonlinear(coat.nonlinear_of(albedo)) - albedo).abs() < 1e-9, "{alpha} {albedo}");
            }
        }
    }

    #[test]
    fn linear_plastics_are_paler() {
        let coat = Coat::new(1.49, 0.1);
        let found = [0.0, 0.1, 0.5, 1.0].map(|albedo| coat.of_linear(albedo));
        assert!(found[0] == 0.0 && found[1] > 0.15 && found[2] > 0.65 && found[3] > 0.95, "{found:?}");
        // f is linear in the colour again.
        let f = |albedo: f64| {
            let ours = coat.of_linear(albedo);
            ours / (coat.square * (1.0 - ours) + ours * coat.enters)
        };
        assert!((f(0.6) / f(0.2) - 3.0).abs() < 1e-9);
    }

    #[test]
    fn rough_coats_reflect_less_once() {
        let [smooth, rough] = [0.0, 1.0].map(|alpha| 1.0 - Coat::new(1.5, alpha).enters);
        assert!(rough < smooth && rough > 0.01, "{rough} {smooth}");
    }
}
