//! Tables of the light that single scattering loses at a rough dielectric with anisotropic facets, as those of `dielectric_albedo.rs` for
//! round ones.
//!
//! The loss depends on the azimuth, too. For each roughness there are rows for [`AZIMUTHS`] cosines of the azimuth to the tangent. The cells
//! over the cosine of the view are those of the larger width.
use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::{
    anisotropy::Widths,
    dielectric_albedo::{CELLS, LEVELS, Lattice, alpha_of, cosine, fresnel, mean_of, rows_of},
};
use noisefall_base::{
    declare::Precision,
    math::{F, One},
};

/// Number of azimuths, evenly spaced in their cosine to the tangent from 0 to 1.
pub const AZIMUTHS: usize = 9;

/// Rows of a material of one roughness, or of all [`LEVELS`]: those of each azimuth.
pub fn rows(eta: f32, alpha: Option<f32>, anisotropy: f32, precision: Precision) -> Vec<[f32; 4]> {
    let [thin, dense] = match (precision, alpha) {
        (Precision::Exact, Some(_)) => [(987, 610), (4181, 2584)],
        (Precision::Exact, None) => [(144, 89), (610, 377)],
        (Precision::Interactive, Some(_)) => [(144, 89), (377, 233)],
        (Precision::Interactive, None) => [(34, 21), (89, 55)],
    };
    let rules = [thin, dense].map(|(count, step)| Lattice::new(count, step));
    let level = |alpha: f64| {
        let widths = Widths::new(F::<One>(alpha as f32), F(anisotropy));
        Level { eta: eta.into(), widths: widths.both().map(|width| width.0.into()), rules: &rules }.rows()
    };
    match alpha {
        Some(alpha) => level(alpha.into()),
        None => (0..LEVELS).flat_map(|index| level(alpha_of(index))).collect(),
    }
}

/// Both sides of the interface at one roughness.
struct Level<'a> {
    eta: f64,
    /// Along the tangent, where it is larger, and across.
    widths: [f64; 2],
    /// For looking into the denser medium, and out of it.
    rules: &'a [Lattice; 2],
}

impl Level<'_> {
    fn rows(&self) -> Vec<[f32; 4]> {
        let losses: Vec<[Vec<f64>; 2]> =
            (0..AZIMUTHS).map(|azimuth| [self.losses(azimuth, self.eta), self.losses(azimuth, 1.0 / self.eta)]).collect();
        let weights = weights();
        let mean =
            |side: usize| losses.iter().zip(weights).map(|(loss, weight)| weight * mean_of(&loss[side], self.widths[0])).sum();
        let means = [mean(0), mean(1)];
        losses.iter().flat_map(|loss| rows_of(self.eta, self.widths[0], loss, means)).collect()
    }

    /// The loss at the ends of the cells of one side; `eta` is the index beyond it over the index on this side.
    fn losses(&self, azimuth: usize, eta: f64) -> Vec<f64> {
        let cos = azimuth as f64 / (AZIMUTHS - 1) as f64;
        let azimuth = DVec2::new(cos, (1.0 - cos * cos).sqrt());
        let at = |end: usize| {
            let mu = cosine(end as f64 / CELLS as f64, self.widths[0]).max(1e-9);
            self.loss((azimuth * (1.0 - mu * mu).max(0.0).sqrt()).extend(mu), eta)
        };
        (0..=CELLS).into_par_iter().map(at).collect()
    }

    /// 1 − E: the mean of the masked fraction on the way out, over the visible normals, which are sampled as for round facets.
    fn loss(&self, w: DVec3, eta: f64) -> f64 {
        let [along, across] = self.widths;
        let stretched = DVec3::new(along * w.x, across * w.y, w.z).normalize();
        let lost = |&[t, cos, sin, weight]: &[f64; 4]| {
            let z = t * (1.0 + stretched.z) - stretched.z;
            let radius = (1.0 - z * z).max(0.0).sqrt();
            let h = DVec3::new(radius * cos, radius * sin, z) + stretched;
            let m = DVec3::new(along * h.x, across * h.y, h.z).normalize();
            weight * self.masked(w, m, eta)
        };
        self.rules[usize::from(eta < 1.0)].points.iter().map(lost).sum()
    }

    /// The fraction lost at the facet `m`.
    fn masked(&self, w: DVec3, m: DVec3, eta: f64) -> f64 {
        let cos = w.dot(m).max(0.0);
        let (reflectance, cos_t) = fresnel(cos, eta);
        let reflected = m * (2.0 * cos) - w;
        let refracted = m * (cos_t - cos / eta) + w / eta;
        reflectance * self.shadow(reflected) + (1.0 - reflectance) * self.shadow(refracted)
    }

    /// 1 − G₁; 1 below the horizon.
    fn shadow(&self, w: DVec3) -> f64 {
        if w.z <= 0.0 {
            return 1.0;
        }
        let [along, across] = self.widths;
        let slope = DVec2::new(along * w.x, across * w.y).length_squared() / (w.z * w.z);
        let root = 1.0 + (1.0 + slope).sqrt();
        slope / (root * root)
    }
}

/// Weights of the azimuths in the mean over all directions, of which the table is linear in the cosine.
fn weights() -> [f64; AZIMUTHS] {
    const STEPS: usize = 4096;
    let mut weights = [0.0; AZIMUTHS];
    for step in 0..STEPS {
        let place = ((step as f64 + 0.5) / STEPS as f64 * FRAC_PI_2).cos() * (AZIMUTHS - 1) as f64;
        let first = (place as usize).min(AZIMUTHS - 2);
        let second = place - first as f64;
        weights[first] += (1.0 - second) / STEPS as f64;
        weights[first + 1] += second / STEPS as f64;
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::dielectric_albedo::{LEVEL_ROWS, uniform_rows};

    #[test]
    fn without_anisotropy_every_azimuth_has_the_loss_of_round_facets() {
        let round = uniform_rows(1.5, 0.4, Precision::Exact);
        for rows in rows(1.5, Some(0.4), 0.0, Precision::Exact).chunks_exact(LEVEL_ROWS) {
            for (row, round) in rows.iter().zip(&round) {
                assert!(row.iter().zip(round).all(|(a, b)| (a - b).abs() < 2e-3), "{row:?} {round:?}");
            }
        }
    }

    #[test]
    fn the_weights_are_those_of_all_azimuths() {
        let weights = weights();
        let mean: f64 = weights.iter().enumerate().map(|(i, weight)| weight * i as f64 / (AZIMUTHS - 1) as f64).sum();
        assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-9 && (mean - 1.0 / FRAC_PI_2).abs() < 1e-6, "{mean}");
    }
}
