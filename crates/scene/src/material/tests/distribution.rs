//! Samples against pdfs.
use std::f64::consts::TAU;

use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{
    super::Bsdf,
    cases::{Any, COSINES, Case, cases},
    viewer,
};
use crate::chi_squared::chi_squared;
use noisefall_base::math::{F, One, V};

/// Probability of the worst statistic of all cases together.
const SIGNIFICANCE: f64 = 1e-4;

/// Bins of half vectors by slope and azimuth: sharp lobes fill as many as wide ones.
struct Grid {
    alpha: f64,
    wo: [f64; 3],
}

const RINGS: usize = 16;
const SECTORS: usize = 8;
const BINS: usize = RINGS * SECTORS;

impl Grid {
    fn new(case: &Case, wo: V<One>) -> Grid {
        Grid { alpha: if case.alpha > 0.0 { f64::from(case.alpha) } else { 1.0 }, wo: wo.lane(0).map(f64::from) }
    }

    /// Bins are even in w, slope = α sinh w, up to the slope that reflects the viewer's direction to the horizon behind it.
    fn last(&self) -> f64 {
        self.horizon(self.wo[0].hypot(self.wo[1]))
    }

    /// w of the steepest microfacet that reflects above the horizon, where the viewer's direction is `along` its slope.
    fn horizon(&self, along: f64) -> f64 {
        ((along + along.hypot(self.wo[2])) / self.wo[2] / self.alpha).asinh()
    }

    fn bin(&self, wi: V<One>) -> usize {
        let wi = wi.lane(0).map(f64::from);
        let [x, y, z] = [0, 1, 2].map(|i| wi[i] + self.wo[i]);
        let w = (x.hypot(y) / z / self.alpha).asinh() / self.last();
        let turn = y.atan2(x) / TAU + 0.5;
        (w * RINGS as f64).min(RINGS as f64 - 1.0) as usize * SECTORS + ((turn * SECTORS as f64) as usize).min(SECTORS - 1)
    }

    /// The pdf integrated over a bin.
    fn probability(&self, bsdf: &Any<'_>, bin: usize) -> f64 {
        const STEPS: usize = 20;
        let (ring, sector) = ((bin / SECTORS) as f64, (bin % SECTORS) as f64);
        let width = self.last() / RINGS as f64;
        let mut sum = 0.0;
        for around in 0..STEPS {
            let phi = ((sector + (around as f64 + 0.5) / STEPS as f64) / SECTORS as f64 - 0.5) * TAU;
            let end = self.horizon(self.wo[0] * phi.cos() + self.wo[1] * phi.sin()).min((ring + 1.0) * width);
            let step = (end - ring * width).max(0.0) / STEPS as f64;
            for across in 0..STEPS {
                sum += self.density(bsdf, ring * width + (across as f64 + 0.5) * step, phi) * step;
            }
        }
        sum * TAU / (SECTORS * STEPS) as f64
    }

    /// The pdf per w and azimuth: dω_i = 4 ω_o·h dω_h, and dω_h = tan θ cos³ θ d tan θ dφ.
    fn density(&self, bsdf: &Any<'_>, w: f64, phi: f64) -> f64 {
        let slope = self.alpha * w.sinh();
        let z = 1.0 / slope.hypot(1.0);
        let h = [slope * z * phi.cos(), slope * z * phi.sin(), z];
        let cos: f64 = h.iter().zip(self.wo).map(|(a, b)| a * b).sum();
        let lanes = |v: [f64; 3]| V { x: F(v[0] as f32), y: F(v[1] as f32), z: F(v[2] as f32) };
        let pdf = bsdf.eval(lanes(self.wo), lanes([0, 1, 2].map(|i| 2.0 * cos * h[i] - self.wo[i]))).1;
        f64::from(pdf.0) * 4.0 * cos * slope * z.powi(3) * self.alpha * w.cosh()
    }
}

#[test]
fn directions_are_distributed_as_their_pdf() {
    const SAMPLES: u32 = 20_000;
    let cases = cases();
    let mut rng = SmallRng::seed_from_u64(11);
    for case in &cases {
        let bsdf = case.bsdf();
        for cos in COSINES {
            let wo = viewer(cos);
            let grid = Grid::new(case, wo);
            // The last one counts samples that do not exist or are of a delta lobe.
            let mut counts = vec![0.0; BINS + 1];
            for _ in 0..SAMPLES {
                let sample = bsdf.sample(wo, (F(rng.random()), F(rng.random())), F(rng.random()));
                let counted = !sample.delta.0 && sample.pdf.0 > 0.0;
                counts[if counted { grid.bin(sample.wi) } else { BINS }] += 1.0;
            }
            let mut expected: Vec<f64> = (0..BINS).map(|bin| grid.probability(&bsdf, bin) * f64::from(SAMPLES)).collect();
            expected.push(f64::from(SAMPLES) - expected.iter().sum::<f64>());
            assert!(expected[BINS] > -2e-3 * f64::from(SAMPLES), "{} at {cos}: the pdf exceeds 1: {}", case.name, expected[BINS]);
            let p = chi_squared(&counts, &expected);
            assert!(p > SIGNIFICANCE / (cases.len() * COSINES.len()) as f64, "{} at {cos}: p = {p}", case.name);
        }
    }
}

/// Upper bound of sample weights: rare samples of large weight would mean that sampling misses light. The largest weights, 4.13,
/// occur for thin coats at grazing angles.
const MOST_WEIGHT: f32 = 4.5;

#[test]
fn the_weight_of_a_sample_is_its_eval_over_its_pdf() {
    let mut rng = SmallRng::seed_from_u64(12);
    for case in &cases() {
        let bsdf = case.bsdf();
        for cos in COSINES {
            let wo = viewer(cos);
            for _ in 0..500 {
                let sample = bsdf.sample(wo, (F(rng.random()), F(rng.random())), F(rng.random()));
                let wi = sample.wi.lane(0);
                let (f, pdf) = bsdf.eval(wo, sample.wi);
                let length = wi.iter().map(|x| x * x).sum::<f32>().sqrt();
                assert!((length - 1.0).abs() < 2e-6, "{} at {cos}: {wi:?}", case.name);
                if sample.delta.0 {
                    assert_eq!([wi[0], wi[1], wi[2]], [-wo.x.0, -wo.y.0, wo.z.0]);
                    continue;
                }
                assert!((sample.pdf.0 - pdf.0).abs() <= 1e-4 * pdf.0, "{} at {cos}: {} {}", case.name, sample.pdf.0, pdf.0);
                for (weight, f) in sample.weight.lane(0).into_iter().zip(f.lane(0)) {
                    let quotient = if pdf.0 > 0.0 { f / pdf.0 } else { 0.0 };
                    assert!((weight - quotient).abs() <= 1e-4 * quotient, "{} at {cos}: {weight} {quotient}", case.name);
                    assert!(weight.is_finite() && weight >= 0.0);
                    assert!(weight <= MOST_WEIGHT, "{} at {cos}: {weight}", case.name);
                }
            }
        }
    }
}

#[test]
fn light_and_viewer_can_be_exchanged() {
    let mut rng = SmallRng::seed_from_u64(13);
    for case in cases().iter().filter(|case| case.reciprocal) {
        let bsdf = case.bsdf();
        for cos in COSINES {
            let wo = viewer(cos);
            for _ in 0..200 {
                let wi = bsdf.sample(wo, (F(rng.random()), F(rng.random())), F(rng.random())).wi;
                if wi.z.0 < 1e-4 {
                    continue;
                }
                let (there, back) = (bsdf.eval(wo, wi).0.lane(0), bsdf.eval(wi, wo).0.lane(0));
                for (there, back) in there.into_iter().zip(back) {
                    let (there, back) = (there / wi.z.0, back / wo.z.0);
                    assert!((there - back).abs() <= 1e-4 * there.max(back), "{} at {cos}: {there} {back}", case.name);
                }
            }
        }
    }
}

#[test]
fn nothing_is_reflected_through_the_surface() {
    for case in &cases() {
        let (f, pdf) = case.bsdf().eval(viewer(0.5), -viewer(0.3));
        assert_eq!((f.lane(0), pdf.0), ([0.0; 3], 0.0), "{}", case.name);
    }
}
