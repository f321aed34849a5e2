//! Whole images: the mean of every pixel's samples, with its variance.
use std::cell::RefCell;

use rayon::prelude::*;

use crate::integrator::{Batch, Interrupted, TILE, Work, trace};
use noisefall_base::math::SimdLevel;
use noisefall_scene::scene::{CameraRays, RenderSettings, Scene};

/// Reduces the colour of a sample to one number.
pub type Measure = fn([f32; 4]) -> f64;

/// Statistics of the samples of one pixel, or of means of pixels, for z-tests.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mean {
    /// The mean.
    pub mean: f64,
    /// The variance of the mean.
    pub variance_of_mean: f64,
}

impl Mean {
    /// The mean of independent means.
    pub fn of(means: impl IntoIterator<Item = Mean>) -> Mean {
        let (mut sum, mut count) = (Mean::default(), 0.0);
        for mean in means {
            sum.mean += mean.mean;
            sum.variance_of_mean += mean.variance_of_mean;
            count += 1.0;
        }
        Mean { mean: sum.mean / count, variance_of_mean: sum.variance_of_mean / (count * count) }
    }

    /// Deviation from an exact value, in standard errors; 0 if there is none. The error of single precision is added, because it
    /// matters if there is hardly any noise.
    pub fn z(self, exact: f64) -> f64 {
        const ROUNDING: f64 = 1e-6;
        let difference = self.mean - exact;
        if difference == 0.0 { 0.0 } else { difference / (self.variance_of_mean + (ROUNDING * exact).powi(2)).sqrt() }
    }

    /// Deviation from an independent mean of the same quantity.
    pub fn z_from(self, other: Mean) -> f64 {
        Mean { variance_of_mean: self.variance_of_mean + other.variance_of_mean, ..self }.z(other.mean)
    }
}

/// An image at the resolution of the scene's camera, row by row.
pub struct Picture {
    /// Width in pixels.
    pub width: usize,
    /// The means, row by row from the top left.
    pub pixels: Vec<Mean>,
    /// The samples of all pixels, image by image, if those of one image depend on each other: a light path may arrive in several
    /// pixels.
    images: Vec<Vec<f64>>,
}

thread_local! {
    /// Reused, because allocating a batch takes longer than a small image.
    static BATCH: RefCell<Batch> = RefCell::default();
}

/// Means of `spp` samples per pixel, each reduced to a number by `measure`.
///
/// # Panics
/// If a sample is negative or not finite.
pub fn picture(scene: &Scene, settings: RenderSettings, measure: Measure, spp: u32) -> Picture {
    let [width, height] = scene.camera.resolution;
    let rays = scene.rays(&scene.camera);
    if scene.traces_light_paths(&settings) {
        let image = |sample| {
            let image = sample_image(scene, &rays, &settings, sample, &|| false).expect("nobody interrupts");
            image.into_iter().map(measure).collect()
        };
        return Picture::of_images(width as usize, (0..spp).into_par_iter().map(image).collect());
    }
    let mut pixels = vec![Mean::default(); (width * height) as usize];
    for y in (0..height).step_by(TILE as usize) {
        for x in (0..width).step_by(TILE as usize) {
            let size = [TILE.min(width - x), TILE.min(height - y)];
            let work = |sample| Work::tile(scene, &rays, &settings, [x, y], size, sample);
            for (i, mean) in tile(&work, size, measure, spp).into_iter().enumerate() {
                let (row, column) = (i as u32 / size[0], i as u32 % size[0]);
                pixels[((y + row) * width + x + column) as usize] = mean;
            }
        }
    }
    Picture::new(width as usize, pixels)
}

/// One sample of every pixel, row by row, with what the light paths of all of them bring.
pub fn sample_image(
    scene: &Scene,
    rays: &CameraRays,
    settings: &RenderSettings,
    sample: u32,
    interrupted: &dyn Fn() -> bool,
) -> Result<Vec<[f32; 4]>, Interrupted> {
    let [width, height] = scene.camera.resolution;
    let mut image = vec![[0.0; 4]; (width * height) as usize];
    let at = |[x, y]: [u32; 2]| (y * width + x) as usize;
    let mut splats = Vec::new();
    BATCH.with_borrow_mut(|batch| {
        for [x, y] in (0..height).step_by(TILE as usize).flat_map(|y| (0..width).step_by(TILE as usize).map(move |x| [x, y])) {
            let size = [TILE.min(width - x), TILE.min(height - y)];
            let work = Work::tile(scene, rays, settings, [x, y], size, sample);
            trace(SimdLevel::best(), &work, batch, interrupted)?;
            for (row, column) in (0..size[1]).flat_map(|row| (0..size[0]).map(move |column| (row, column))) {
                image[at([x + column, y + row])] = batch.radiance()[(row * TILE + column) as usize];
            }
            splats.extend_from_slice(&batch.splats);
        }
        Ok(())
    })?;
    for (pixel, light) in splats.iter().filter_map(|splat| splat.land(rays.filter, [width, height])) {
        (0..3).for_each(|channel| image[at(pixel)][channel] += (light[channel] / f64::from(width * height)) as f32);
    }
    Ok(image)
}

/// The means of one tile, row by row.
fn tile<'a>(work: &(impl Fn(u32) -> Work<'a> + Sync), size: [u32; 2], measure: Measure, spp: u32) -> Vec<Mean> {
    // Fixed parts, added in order, so that the sums do not depend on threads.
    const PARTS: u32 = 16;
    let slots: Vec<usize> = (0..size[1]).flat_map(|row| (0..size[0]).map(move |column| (row * TILE + column) as usize)).collect();
    let sample = |number: u32| -> Vec<f64> {
        BATCH.with_borrow_mut(|batch| {
            trace(SimdLevel::best(), &work(number), batch, &|| false).expect("nobody interrupts");
            let values: Vec<f64> = slots.iter().map(|slot| measure(batch.radiance()[*slot])).collect();
            assert!(values.iter().all(|value| value.is_finite() && *value >= 0.0), "an invalid sample");
            values
        })
    };
    // Sums of deviations from the first sample: without noise their variance is exactly 0.
    let first = sample(0);
    let part = |part: u32| {
        let mut sums = vec![[0.0; 2]; slots.len()];
        for number in (part..spp).step_by(PARTS as usize) {
            for ((sum, value), first) in sums.iter_mut().zip(sample(number)).zip(&first) {
                sum[0] += value - first;
                sum[1] += (value - first).powi(2);
            }
        }
        sums
    };
    let parts: Vec<Vec<[f64; 2]>> = (0..PARTS).into_par_iter().map(part).collect();
    let n = f64::from(spp);
    let mean = |(i, first): (usize, &f64)| {
        let [sum, square] = parts.iter().fold([0.0; 2], |[a, b], part| [a + part[i][0], b + part[i][1]]);
        let variance_of_mean = ((square - sum * sum / n) / (n * (n - 1.0))).max(0.0);
        Mean { mean: first + sum / n, variance_of_mean }
    };
    first.iter().enumerate().map(mean).collect()
}

impl Picture {
    /// An image of independent pixels.
    pub fn new(width: usize, pixels: Vec<Mean>) -> Picture {
        Picture { width, pixels, images: Vec::new() }
    }

    /// The means of these samples of all pixels.
    fn of_images(width: usize, images: Vec<Vec<f64>>) -> Picture {
        assert!(images.iter().flatten().all(|value| value.is_finite() && *value >= 0.0), "an invalid sample");
        let pixels = (0..images[0].len()).map(|i| mean_of_values(images.iter().map(|image| image[i]))).collect();
        Picture { width, pixels, images }
    }

    /// The weighted mean of pixels, given by their indices and weights.
    pub fn weighted(&self, pixels: &[(usize, f64)]) -> Mean {
        let whole: f64 = pixels.iter().map(|(_, weight)| weight).sum();
        let of = |value: &dyn Fn(usize) -> f64, power: i32| {
            pixels.iter().map(|(i, weight)| (weight / whole).powi(power) * value(*i)).sum::<f64>()
        };
        if self.images.is_empty() {
            let variance_of_mean = of(&|i| self.pixels[i].variance_of_mean, 2);
            return Mean { mean: of(&|i| self.pixels[i].mean, 1), variance_of_mean };
        }
        mean_of_values(self.images.iter().map(|image| of(&|i| image[i], 1)))
    }

    /// The mean over all pixels.
    pub fn whole(&self) -> Mean {
        self.weighted(&(0..self.pixels.len()).map(|i| (i, 1.0)).collect::<Vec<_>>())
    }

    /// The means over squares of `side` × `side` pixels, row by row.
    pub fn blocks(&self, side: usize) -> Vec<Mean> {
        let height = self.pixels.len() / self.width;
        let block = |x: usize, y: usize| {
            let rows = y..(y + side).min(height);
            let pixels: Vec<_> =
                rows.flat_map(|y| (x..(x + side).min(self.width)).map(move |x| (y * self.width + x, 1.0))).collect();
            self.weighted(&pixels)
        };
        (0..height).step_by(side).flat_map(|y| (0..self.width).step_by(side).map(move |x| block(x, y))).collect()
    }
}

/// The mean of independent values.
fn mean_of_values(values: impl Iterator<Item = f64> + Clone) -> Mean {
    let n = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / n;
    Mean { mean, variance_of_mean: values.map(|value| (value - mean).powi(2)).sum::<f64>() / (n * (n - 1.0)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: Mean = Mean { mean: 2.0, variance_of_mean: 0.01 };
    const B: Mean = Mean { mean: 4.0, variance_of_mean: 0.03 };

    #[test]
    fn means_of_means_have_the_textbook_variance() {
        let both = Mean::of([A, B]);
        assert!((both.mean - 3.0).abs() < 1e-12 && (both.variance_of_mean - 0.01).abs() < 1e-12);
        assert!((A.z(1.5) - 5.0).abs() < 1e-6 && (A.z_from(B) + 10.0).abs() < 1e-6 && (B.z_from(A) - 10.0).abs() < 1e-6);
        assert_eq!(Mean { variance_of_mean: 0.0, ..A }.z(2.0), 0.0);
        // Single precision is wrong by 10⁻⁶ of the exact value.
        assert!((Mean { mean: 2.0 + 4e-6, variance_of_mean: 0.0 }.z(2.0) - 2.0).abs() < 1e-3);
    }

    #[test]
    fn blocks_are_those_of_the_picture_row_by_row() {
        // 5 × 3 pixels in blocks of 2 × 2, some of them narrower and lower.
        let pixels = (0..15).map(|i| Mean { mean: f64::from(i), variance_of_mean: 1.0 }).collect();
        let picture = Picture::new(5, pixels);
        let blocks = picture.blocks(2);
        assert_eq!(blocks.iter().map(|block| block.mean).collect::<Vec<_>>(), [3.0, 5.0, 6.5, 10.5, 12.5, 14.0]);
        assert_eq!(blocks.iter().map(|block| block.variance_of_mean).collect::<Vec<_>>(), [0.25, 0.25, 0.5, 0.5, 0.5, 1.0]);
        assert!((picture.whole().mean - 7.0).abs() < 1e-12 && (picture.whole().variance_of_mean - 1.0 / 15.0).abs() < 1e-12);
    }

    /// The samples of a pixel are those that replaying gives, wherever it lies.
    #[test]
    fn pixels_have_the_mean_and_variance_of_their_samples() {
        let scene = noisefall_scene::scene::built_in();
        let scene = Scene { camera: noisefall_scene::scene::Camera { resolution: [40, 35], ..scene.camera }, ..scene };
        let settings = RenderSettings { reuse: noisefall_scene::scene::Reuse::Off, ..scene.settings };
        let picture = picture(&scene, settings, |radiance| f64::from(radiance[1]), 19);
        let rays = scene.rays(&scene.camera);
        for [x, y] in [[0, 0], [39, 3], [5, 34], [33, 33]] {
            let values = (0..19).map(|n| f64::from(crate::integrator::replay(&scene, &rays, &settings, [x, y], n).radiance[1]));
            let exact = super::super::Moments::of(values);
            let found = picture.pixels[(y * 40 + x) as usize];
            assert!((found.mean / exact.mean - 1.0).abs() < 1e-9, "{x} {y}");
            assert!((found.variance_of_mean * 19.0 / exact.variance - 1.0).abs() < 1e-9, "{x} {y}");
        }
    }
}
