//! Samples of a scene one by one, and their moments.
use rayon::prelude::*;

use crate::integrator::{Batch, TILE, Work, trace};
use noisefall_base::math::SimdLevel;
use noisefall_scene::scene::{Camera, RenderSettings, Scene};

/// The red channel of `spp` samples of each of 32 × 32 pixels, pixel by pixel.
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
    /// Number of values.
    pub count: f64,
    /// Mean.
    pub mean: f64,
    /// Variance.
    pub variance: f64,
    /// Fourth central moment.
    pub fourth: f64,
}

impl Moments {
    /// The moments of these values.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Moments {
        let values: Vec<f64> = values.into_iter().collect();
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let central = |power: i32| values.iter().map(|x| (x - mean).powi(power)).sum::<f64>();
        Moments { count, mean, variance: central(2) / (count - 1.0), fourth: central(4) / count }
    }

    /// Deviation of the mean from an exact value, in standard errors from the variance of the samples.
    pub fn z(&self, exact: f64) -> f64 {
        self.z_with(exact, self.variance)
    }

    /// Deviation of the mean from an exact value, in standard errors from a known variance.
    pub fn z_with(&self, exact: f64, variance: f64) -> f64 {
        (self.mean - exact) / (variance / self.count).sqrt()
    }

    /// Deviation of the variance from an exact value, in standard errors: Var s² = (μ₄ − σ⁴)/n for large n.
    pub fn z_of_variance(&self, exact: f64) -> f64 {
        (self.variance - exact) / ((self.fourth - self.variance * self.variance) / self.count).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_the_textbook_ones() {
        // Deviations −2, −1, 0 and 3.
        let moments = Moments::of([1.0, 2.0, 3.0, 6.0]);
        let Moments { count, mean, variance, fourth } = moments;
        assert_eq!((count, mean), (4.0, 3.0));
        assert!((variance - 14.0 / 3.0).abs() < 1e-12 && (fourth - 98.0 / 4.0).abs() < 1e-12);
        assert!((moments.z(2.0) - 1.0 / (14.0f64 / 12.0).sqrt()).abs() < 1e-12);
        assert!((moments.z_with(4.0, 16.0) + 0.5).abs() < 1e-12);
        let standard_error = ((24.5 - (14.0f64 / 3.0).powi(2)) / 4.0).sqrt();
        assert!((moments.z_of_variance(4.0) - (14.0 / 3.0 - 4.0) / standard_error).abs() < 1e-12);
    }

    #[test]
    fn samples_are_pixel_after_pixel() {
        let scene = noisefall_scene::scene::built_in();
        let settings = RenderSettings { reuse: noisefall_scene::scene::Reuse::Off, ..scene.settings };
        let found = samples(&scene, settings, 3);
        let rays = scene.rays(&Camera { resolution: [TILE, TILE], ..scene.camera });
        assert_eq!((found.len(), found[5].len()), ((TILE * TILE) as usize, 3));
        let mut coloured = 0;
        for x in 0..TILE {
            let (y, n) = (TILE - 1 - x, x % 3);
            let exact = crate::integrator::replay(&scene, &rays, &settings, [x, y], n).radiance;
            assert_eq!(found[(y * TILE + x) as usize][n as usize], f64::from(exact[0]));
            coloured += u32::from(exact[0] != exact[1] && exact[0] != exact[2]);
        }
        assert!(coloured > 0, "red is no other channel");
    }
}
