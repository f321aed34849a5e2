//! Samples of a scene one by one, and their moments.
use rayon::prelude::*;

use crate::{
    integrator::{Batch, TILE, Work, trace},
    math::SimdLevel,
    scene::{Camera, RenderSettings, Scene},
};

/// Red of `spp` samples of each of 32 × 32 pixels, pixel after pixel.
pub fn samples(scene: &Scene, settings: RenderSettings, spp: u32) -> Vec<Vec<f64>> {
    let camera = Camera { resolution: [TILE, TILE], ..scene.camera };
    let rays = scene.rays(&camera);
    let by_sample: Vec<Vec<f64>> = (0..spp)
        .into_par_iter()
        .map_init(Batch::default, |batch, sample| {
            let work = Work::tile(scene, &rays, &settings, [0, 0], [TILE, TILE], sample);
            trace(SimdLevel::best(), &work, batch, &|| false).expect("nobody interrupts");
            batch.radiance().iter().map(|radiance| f64::from(radiance[0])).collect()
        })
        .collect();
    (0..(TILE * TILE) as usize).map(|pixel| by_sample.iter().map(|sample| sample[pixel]).collect()).collect()
}

/// Mean, variance and fourth central moment of numbers.
pub struct Moments {
    pub count: f64,
    pub mean: f64,
    pub variance: f64,
    pub fourth: f64,
}

impl Moments {
    pub fn of(values: impl IntoIterator<Item = f64>) -> Moments {
        let values: Vec<f64> = values.into_iter().collect();
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let central = |power: i32| values.iter().map(|x| (x - mean).powi(power)).sum::<f64>();
        Moments { count, mean, variance: central(2) / (count - 1.0), fourth: central(4) / count }
    }

    /// Deviation of the mean from an exact value, in standard errors by the samples' own variance.
    pub fn z(&self, exact: f64) -> f64 {
        self.z_with(exact, self.variance)
    }

    /// Deviation of the mean from an exact value, in standard errors by a known variance.
    pub fn z_with(&self, exact: f64, variance: f64) -> f64 {
        (self.mean - exact) / (variance / self.count).sqrt()
    }

    /// Deviation of the variance from an exact one, in its standard errors: Var s² = (μ₄ − σ⁴)/n for large n.
    pub fn z_of_variance(&self, exact: f64) -> f64 {
        (self.variance - exact) / ((self.fourth - self.variance * self.variance) / self.count).sqrt()
    }
}
