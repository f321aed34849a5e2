//! Samples of rough dielectrics against their pdfs.
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::super::{
    beckmann::Beckmann,
    bsdf::Bsdf,
    rough_dielectric::RoughDielectricBsdf,
    tests::dielectric_fixtures::{COSINES, Direction, ROUGHNESSES, combine, dot, interfaces, rough, rows_of, view, wide},
};
use crate::chi_squared::chi_squared;
use noisefall_base::math::{F, One, V};

/// All test statistics of one test together must have at least this probability; seeds are fixed.
const SIGNIFICANCE: f64 = 1e-4;

fn narrow(d: Direction) -> V<One> {
    V::splat(One, d.map(|x| x as f32))
}

/// Fails if counts are too unlikely under expectations; sparse bins are merged.
fn check_counts(observed: &[f64], expected: &[f64], tests: usize, name: &str) {
    let rare = || observed.iter().zip(expected).filter(|(_, e)| **e < 8.0);
    let [o, e] = [rare().map(|(o, _)| o).sum::<f64>(), rare().map(|(_, e)| e).sum()];
    assert!(e > 8.0 || o < 40.0, "{name}: {o} samples for {e} expected");
    let p = chi_squared(observed, expected);
    assert!(p > SIGNIFICANCE / tests as f64, "{name}: p = {p}");
}

/// A grid over the half vectors, finer where facets are denser, as narrow as the lobes of the smoothest facets.
struct HalfVectors {
    eta: f64,
    alpha: f64,
    wo: Direction,
}

impl HalfVectors {
    const DOWN: usize = 10;
    const AROUND: usize = 12;
    /// Points of a bin down and around; total reflection begins along a line that often runs around.
    const STEPS: [usize; 2] = [24, 6];

    /// The bin of a direction: reflections first.
    fn bin(&self, wi: Direction) -> usize {
        let index = if wi[2] < 0.0 { self.eta } else { 1.0 };
        let h = combine(self.wo, 1.0, wi, index);
        let tan = (h[0] * h[0] + h[1] * h[1]).sqrt() / h[2].abs();
        let turn = (h[1] * h[2].signum()).atan2(h[0] * h[2].signum()) / std::f64::consts::TAU + 0.5;
        let down = (tan / (tan + self.alpha) * Self::DOWN as f64) as usize;
        let around = ((turn * Self::AROUND as f64) as usize).min(Self::AROUND - 1);
        (usize::from(wi[2] < 0.0) * Self::DOWN + down.min(Self::DOWN - 1)) * Self::AROUND + around
    }

    /// The direction of light from the facet at (x, y) of the unit square, by reflection or refraction.
    fn direction(&self, x: f64, y: f64, through: bool) -> Option<Direction> {
        let tan = self.alpha * x / (1.0 - x);
        let (sin_phi, cos_phi) = ((y - 0.5) * std::f64::consts::TAU).sin_cos();
        let cos = 1.0 / (1.0 + tan * tan).sqrt();
        let m = [tan * cos * cos_phi, tan * cos * sin_phi, cos];
        let c = dot(self.wo, m);
        let square = self.eta * self.eta - 1.0 + c * c;
        if c <= 0.0 || (through && square <= 0.0) {
            return None;
        }
        let (along, index) = if through { ((c - square.sqrt()) / self.eta, self.eta) } else { (2.0 * c, 1.0) };
        let wi = combine(m, along, self.wo, -1.0 / index);
        (if through { wi[2] < 0.0 } else { wi[2] > 0.0 }).then_some(wi)
    }

    /// The pdf at (x, y) times the solid angle that the square maps to, by differences.
    fn density(&self, bsdf: &impl Bsdf<One>, x: f64, y: f64, through: bool) -> f64 {
        const STEP: f64 = 1e-6;
        let [middle, right, up] = [(x, y), (x + STEP, y), (x, y + STEP)].map(|(x, y)| self.direction(x, y, through));
        let (Some(middle), Some(right), Some(up)) = (middle, right, up) else { return 0.0 };
        let (a, b) = (combine(right, 1.0, middle, -1.0), combine(up, 1.0, middle, -1.0));
        let area = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        f64::from(bsdf.eval(narrow(self.wo), narrow(middle)).1.0) * dot(area, area).sqrt() / (STEP * STEP)
    }

    /// The pdf integrated over all bins.
    fn probabilities(&self, bsdf: &impl Bsdf<One>) -> Vec<f64> {
        let [steps_down, steps_around] = Self::STEPS;
        let (across, around) = ((Self::DOWN * steps_down) as f64, (Self::AROUND * steps_around) as f64);
        let mut all = vec![0.0; 2 * Self::DOWN * Self::AROUND];
        for (i, bin) in all.iter_mut().enumerate() {
            let (down, turn) = (i / Self::AROUND, i % Self::AROUND);
            for step in 0..steps_down * steps_around {
                let x = ((down % Self::DOWN * steps_down + step / steps_around) as f64 + 0.5) / across;
                let y = ((turn * steps_around + step % steps_around) as f64 + 0.5) / around;
                *bin += self.density(bsdf, x, y, down >= Self::DOWN) / (across * around);
            }
        }
        all
    }
}

/// Fails if samples of single scattering are not distributed as their pdf.
fn check_facets(bsdf: &impl Bsdf<One>, (eta, alpha): (f32, f32), cos: f32, tests: usize, rng: &mut SmallRng) {
    const SAMPLES: usize = 10_000;
    let wo = view(cos);
    let grid = HalfVectors { eta: eta.into(), alpha: alpha.into(), wo: wide(wo) };
    let mut expected = grid.probabilities(bsdf);
    expected.push(1.0 - expected.iter().sum::<f64>());
    let mut counts = vec![0.0; expected.len()];
    for _ in 0..SAMPLES {
        let sample = bsdf.sample(wo, (F(rng.random()), F(rng.random())), F(rng.random()));
        counts[if sample.weight.x.0 > 0.0 { grid.bin(wide(sample.wi)) } else { expected.len() - 1 }] += 1.0;
    }
    let expected: Vec<_> = expected.iter().map(|p| p * SAMPLES as f64).collect();
    check_counts(&counts, &expected, tests, &format!("{eta} {alpha} {cos}"));
}

#[test]
fn facets_are_distributed_as_their_pdf_and_all_samples_that_exist_are_in_it() {
    let mut rng = SmallRng::seed_from_u64(3);
    let cases = interfaces(&ROUGHNESSES);
    for (&case, cos) in cases.iter().flat_map(|case| COSINES.map(|cos| (case, cos))) {
        check_facets(&rough(case.0, case.1, None), case, cos, cases.len() * COSINES.len(), &mut rng);
    }
}

#[test]
fn beckmann_facets_are_distributed_as_their_pdf() {
    let mut rng = SmallRng::seed_from_u64(5);
    let cases = interfaces(&[0.01, 0.1, 0.3, 1.0]);
    for (&(eta, alpha), cos) in cases.iter().flat_map(|case| COSINES.map(|cos| (case, cos))) {
        let bsdf = RoughDielectricBsdf::of(F::<One>(eta), Beckmann(F::<One>(alpha)), None);
        check_facets(&bsdf, (eta, alpha), cos, cases.len() * COSINES.len(), &mut rng);
    }
}

/// The whole sphere in bins of z and azimuth, finer towards the poles.
mod sphere {
    use super::{Bsdf, Direction, One, RoughDielectricBsdf, V, narrow};

    pub const DOWN: usize = 16;
    pub const AROUND: usize = 8;
    const STEPS: usize = 40;

    /// z = 1 − s² above, s² − 1 below.
    pub fn bin([x, y, z]: Direction) -> usize {
        let half = DOWN / 2;
        let down = (((1.0 - z.abs()).max(0.0).sqrt() * half as f64) as usize).min(half - 1);
        let turn = y.atan2(x) / std::f64::consts::TAU + 0.5;
        (usize::from(z < 0.0) * half + down) * AROUND + ((turn * AROUND as f64) as usize).min(AROUND - 1)
    }

    pub fn probability(bsdf: &RoughDielectricBsdf<'_, One>, wo: V<One>, bin: usize) -> f64 {
        let half = DOWN / 2;
        let (down, turn) = (bin / AROUND, bin % AROUND);
        let mut sum = 0.0;
        for step in 0..STEPS * STEPS {
            let s = ((down % half * STEPS + step / STEPS) as f64 + 0.5) / (half * STEPS) as f64;
            let phi = (((turn * STEPS + step % STEPS) as f64 + 0.5) / (AROUND * STEPS) as f64 - 0.5) * std::f64::consts::TAU;
            let z = if down < half { 1.0 - s * s } else { s * s - 1.0 };
            let r = (1.0 - z * z).sqrt();
            sum += 2.0 * s * f64::from(bsdf.eval(wo, narrow([r * phi.cos(), r * phi.sin(), z])).1.0);
        }
        sum * std::f64::consts::TAU / (half * STEPS * AROUND * STEPS) as f64
    }
}

#[test]
fn compensated_directions_are_distributed_as_their_pdf() {
    const SAMPLES: usize = 10_000;
    let mut rng = SmallRng::seed_from_u64(4);
    let cases = [0.3, 0.6, 1.0].into_iter().flat_map(|alpha| [1.0 / 2.4, 1.0 / 1.5, 1.5, 2.4].map(|eta| (eta, alpha)));
    let cases: Vec<_> = cases.flat_map(|case| [0.8, 0.3, 0.1].map(|cos| (case, cos))).collect();
    for &((eta, alpha), cos) in &cases {
        let rows = rows_of(eta, alpha);
        let (wo, bsdf) = (view(cos), rough(eta, alpha, Some(rows)));
        let bins = sphere::DOWN * sphere::AROUND;
        let mut expected: Vec<_> = (0..bins).map(|bin| sphere::probability(&bsdf, wo, bin)).collect();
        expected.push(1.0 - expected.iter().sum::<f64>());
        let mut counts = vec![0.0; bins + 1];
        for _ in 0..SAMPLES {
            let sample = bsdf.sample(wo, (F(rng.random()), F(rng.random())), F(rng.random()));
            counts[if sample.weight.x.0 > 0.0 { sphere::bin(wide(sample.wi)) } else { bins }] += 1.0;
        }
        let expected: Vec<_> = expected.iter().map(|p| p * SAMPLES as f64).collect();
        check_counts(&counts, &expected, cases.len(), &format!("{eta} {alpha} {cos}"));
    }
}
