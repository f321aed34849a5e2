//! Tables of the light that single scattering loses at a rough dielectric, computed when the scene is compiled.
//!
//! The model of [`super::rough_dielectric`] follows light only to its first facet, and loses the light that the Smith term masks
//! afterwards. The compensation of [`super::missing_energy`] needs only the lost fraction, 1 − E(μ) at cosine μ, for both sides:
//! from outside and from inside.
use std::ops::Range;

use rayon::prelude::*;

use super::ggx::SMOOTH;
use noisefall_base::{
    declare::Precision,
    math::{F, One, trig::sin_cos_turns},
};

/// Cells over the cosine of one side at one roughness.
pub const CELLS: usize = 128;
/// About half of the cells lie below this multiple of α. The others suffice for grazing angles, where the loss is smooth, and to
/// resolve its bump of width α at the critical angle.
pub const HALF: f32 = 16.0;
/// Number of rows of one roughness: outside, then inside.
pub const LEVEL_ROWS: usize = 2 * CELLS;
/// Number of roughnesses in the table of a textured material, evenly spaced in ⁴√α over [`ALPHAS`].
pub const LEVELS: usize = 48;
/// Range of textured roughnesses.
pub const ALPHAS: Range<f32> = SMOOTH..1.0;

/// Rows of a material of one roughness: [loss at the near end of the cell, at its far end, mean loss of the side over α², mean
/// loss exchanged with the other side over α²].
///
/// `eta` is the index inside over the index outside.
pub fn uniform_rows(eta: f32, alpha: f32, precision: Precision) -> Vec<[f32; 4]> {
    let rules = match precision {
        Precision::Exact => Rules { thin: Lattice::new(1597, 987), dense: Lattice::new(10946, 6765) },
        Precision::Interactive => Rules { thin: Lattice::new(377, 233), dense: Lattice::new(1597, 987) },
    };
    Level::new(eta.into(), alpha.into(), &rules).rows()
}

/// Rows of a material whose roughness is textured: those of [`uniform_rows`] for all [`LEVELS`], the smoothest first.
///
/// The quadrature is coarser than for one roughness, because the error between two levels is larger.
pub fn textured_rows(eta: f32, precision: Precision) -> Vec<[f32; 4]> {
    let rules = match precision {
        Precision::Exact => Rules { thin: Lattice::new(610, 377), dense: Lattice::new(2584, 1597) },
        Precision::Interactive => Rules { thin: Lattice::new(55, 34), dense: Lattice::new(144, 89) },
    };
    (0..LEVELS).flat_map(|level| Level::new(eta.into(), alpha_of(level), &rules).rows()).collect()
}

/// α of a level.
pub(super) fn alpha_of(level: usize) -> f64 {
    let [first, last] = [ALPHAS.start, ALPHAS.end].map(|alpha| f64::from(alpha).sqrt().sqrt());
    (first + (last - first) * level as f64 / (LEVELS - 1) as f64).powi(4)
}

/// Both sides of the interface at one roughness.
struct Level {
    eta: f64,
    alpha: f64,
    /// Loss at the ends of the cells.
    loss: [Vec<f64>; 2],
}

impl Level {
    fn new(eta: f64, alpha: f64, rules: &Rules) -> Level {
        let side = |eta: f64| {
            let view = Side { eta, alpha, rule: if eta < 1.0 { &rules.dense } else { &rules.thin } };
            // A view along the surface is the limit of grazing ones.
            (0..=CELLS).into_par_iter().map(|end| view.loss(cosine(end as f64 / CELLS as f64, alpha).max(1e-9))).collect()
        };
        Level { eta, alpha, loss: [side(eta), side(1.0 / eta)] }
    }

    /// The fraction of the mean loss that crosses the interface is the transmittance of a smooth interface for diffuse light,
    /// limited by the side that loses less. Times n² it is equal for both sides, so the compensation is reciprocal.
    fn rows(&self) -> Vec<[f32; 4]> {
        rows_of(self.eta, self.alpha, &self.loss, [self.mean(0), self.mean(1)])
    }

    /// ∫ (1 − E(μ)) 2μ dμ of the interpolated loss.
    fn mean(&self, side: usize) -> f64 {
        mean_of(&self.loss[side], self.alpha)
    }
}

/// The rows of both sides for the losses at the ends of the cells, and their means.
pub(super) fn rows_of(eta: f64, alpha: f64, loss: &[Vec<f64>; 2], mean: [f64; 2]) -> Vec<[f32; 4]> {
    let crossing = mean[0].min(mean[1]) * mean_transmittance(eta);
    let exchanged = [crossing, crossing / (eta * eta)];
    let scale = 1.0 / (alpha * alpha);
    let side = |side: usize| {
        let row = move |ends: &[f64]| [ends[0], ends[1], mean[side] * scale, exchanged[side] * scale].map(|x| x as f32);
        loss[side].windows(2).map(row)
    };
    side(0).chain(side(1)).collect()
}

/// ∫ (1 − E(μ)) 2μ dμ of the loss at the ends of the cells.
pub(super) fn mean_of(loss: &[f64], alpha: f64) -> f64 {
    let cell = |(k, ends): (usize, &[f64])| {
        let at = |t: f64| {
            let x = (k as f64 + t) / CELLS as f64;
            (ends[0] + (ends[1] - ends[0]) * t) * 2.0 * cosine(x, alpha) * stretch(x, alpha)
        };
        mean_over_unit(16, at) / CELLS as f64
    };
    loss.windows(2).enumerate().map(cell).sum()
}

/// The cosine at position `x` in [0, 1] of a table for roughness `alpha`. The loss depends on μ/α if both are small, so half of
/// the cells lie below a multiple of α; [`super::missing_energy`] has the inverse.
pub(super) fn cosine(x: f64, alpha: f64) -> f64 {
    let half = f64::from(HALF) * alpha;
    half * x / (1.0 + half - x)
}

/// Derivative of [`cosine`] with respect to the position.
fn stretch(x: f64, alpha: f64) -> f64 {
    let half = f64::from(HALF) * alpha;
    let rest = 1.0 + half - x;
    half * (1.0 + half) / (rest * rest)
}

/// Transmittance of a smooth interface for diffuse light: ∫ (1 − F(μ)) 2μ dμ.
///
/// From the denser side it is n² times smaller, because the same power passes in both directions in equilibrium.
fn mean_transmittance(eta: f64) -> f64 {
    let up = eta.max(1.0 / eta);
    let from_thin = mean_over_unit(1024, |mu| 2.0 * mu * (1.0 - fresnel(mu, up).0));
    if eta < 1.0 { from_thin / (up * up) } else { from_thin }
}

/// The midpoint rule.
fn mean_over_unit(count: usize, at: impl Fn(f64) -> f64) -> f64 {
    (0..count).map(|i| at((i as f64 + 0.5) / count as f64)).sum::<f64>() / count as f64
}

/// Quadrature rules for looking into the denser medium and out of it, where total internal reflection causes a kink that needs
/// more points.
struct Rules {
    thin: Lattice,
    dense: Lattice,
}

/// A Fibonacci lattice on the square of height in the cap and azimuth, with a change of variable in the height that makes the
/// integrand periodic (Sloan and Joe, "Lattice Methods for Multiple Integration", 1994).
pub(super) struct Lattice {
    /// Height in [0, 1], cosine and sine of the azimuth, weight.
    pub points: Vec<[f64; 4]>,
}

impl Lattice {
    /// Builds a lattice; `count` and `step` are consecutive Fibonacci numbers.
    pub fn new(count: usize, step: usize) -> Lattice {
        let point = |i: usize| {
            let t = (i as f64 + 0.5) / count as f64;
            let turn = (i * step % count) as f32 / count as f32;
            let (sin, cos) = sin_cos_turns(F::<One>(turn));
            [t * t * (3.0 - 2.0 * t), cos.0.into(), sin.0.into(), 6.0 * t * (1.0 - t) / count as f64]
        };
        Lattice { points: (0..count).map(point).collect() }
    }
}

/// One side of the interface; `eta` is the index beyond it over the index on this side.
struct Side<'a> {
    eta: f64,
    alpha: f64,
    rule: &'a Lattice,
}

impl Side<'_> {
    /// 1 − E(μ): the mean of the masked fraction on the way out, over the visible normals.
    ///
    /// The visible normals are those that mirror the view, both with the roughness stretched away, to a direction uniform on
    /// the cap of the sphere above −μ (Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", 2023, section
    /// 3).
    fn loss(&self, mu: f64) -> f64 {
        let (sin, alpha) = ((1.0 - mu * mu).max(0.0).sqrt(), self.alpha);
        let length = (alpha * alpha * sin * sin + mu * mu).sqrt();
        let (x, z) = (alpha * sin / length, mu / length);
        let lost = |&[t, cos, _, weight]: &[f64; 4]| {
            let height = t * (1.0 + z) - z;
            let radius2 = (1.0 - height * height).max(0.0);
            let (hx, hz) = (alpha * (x + radius2.sqrt() * cos), height + z);
            let hy2 = alpha * alpha * radius2 * (1.0 - cos * cos);
            let scale = 1.0 / (hx * hx + hy2 + hz * hz).sqrt();
            weight * self.masked((sin * hx + mu * hz) * scale, hz * scale, mu)
        };
        self.rule.points.iter().map(lost).sum()
    }

    /// The fraction lost at one facet, whose cosine is `cos` to the viewer and `m` to the normal.
    fn masked(&self, cos: f64, m: f64, mu: f64) -> f64 {
        let (reflectance, cos_t) = fresnel(cos, self.eta);
        let reflected = 2.0 * cos * m - mu;
        let refracted = (cos_t - cos / self.eta) * m + mu / self.eta;
        reflectance * self.shadow(reflected) + (1.0 - reflectance) * self.shadow(refracted)
    }

    /// 1 − G₁ at cosine `mu` (Walter et al. 2007, equation 34); 1 below the horizon.
    fn shadow(&self, mu: f64) -> f64 {
        if mu <= 0.0 {
            return 1.0;
        }
        let slope = self.alpha * self.alpha * (1.0 - mu * mu).max(0.0) / (mu * mu);
        let root = 1.0 + (1.0 + slope).sqrt();
        slope / (root * root)
    }
}

/// Reflectance and cosine of refraction of unpolarised light (Walter et al. 2007, equation 22); the latter 0 in total reflection.
pub(super) fn fresnel(cos: f64, eta: f64) -> (f64, f64) {
    let square = (eta - 1.0) * (eta + 1.0) + cos * cos;
    if square <= 0.0 {
        return (1.0, 0.0);
    }
    let beyond = square.sqrt();
    let across = (cos - beyond) / (cos + beyond);
    let along = (eta * eta * cos - beyond) / (eta * eta * cos + beyond);
    (0.5 * (across * across + along * along), beyond / eta)
}
