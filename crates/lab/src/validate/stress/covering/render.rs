//! Small films of scenes.
use std::ops::Range;

use super::frame::SIZE;
use noisefall_base::math::{SimdLevel, colour::luminance};
use noisefall_render::render::{
    film::Film,
    frame::Frame,
    threads::{PassJob, Threads},
};
use noisefall_scene::scene::{RenderSettings, Scene};

/// Samples per pixel of films whose bits are compared: enough for adaptive sampling to distribute them.
pub const SPP: u32 = 8;

/// The bits of an image.
pub type Bits = Vec<[u32; 3]>;

/// A render thread for each SIMD level, the best one last.
pub struct Renderers(Vec<(SimdLevel, Threads)>);

impl Renderers {
    pub fn new() -> Result<Renderers, String> {
        let of_level = |level| Threads::new(1, level).map(|threads| (level, threads)).map_err(|error| error.to_string());
        SimdLevel::available().into_iter().map(of_level).collect::<Result<_, _>>().map(Renderers)
    }

    /// The bits of an image at the best level.
    pub fn bits(&self, scene: &Scene) -> Result<Bits, String> {
        let (_, threads) = self.0.last().ok_or("there is no level")?;
        bits(scene, threads)
    }

    /// The bits of an image, or an error if another level has others.
    pub fn bits_at_all_levels(&self, scene: &Scene) -> Result<Bits, String> {
        let image = self.bits(scene)?;
        for (level, threads) in &self.0 {
            if bits(scene, threads)? != image {
                return Err(format!("the image differs at {level:?}"));
            }
        }
        Ok(image)
    }

    /// The mean luminance of images with seeds of their own.
    pub fn means(&self, scene: &Scene, settings: RenderSettings, spp: u32, seeds: Range<u32>) -> Result<Vec<f64>, String> {
        let (_, threads) = self.0.last().ok_or("there is no level")?;
        let mean = |seed: u32| {
            let radiance = film(scene, &RenderSettings { seed, ..settings }, threads, spp)?;
            Ok(radiance.iter().map(|rgb| f64::from(luminance(*rgb))).sum::<f64>() / radiance.len() as f64)
        };
        seeds.map(mean).collect()
    }
}

/// The radiance of a film.
fn film(scene: &Scene, settings: &RenderSettings, threads: &Threads, spp: u32) -> Result<Vec<[f32; 3]>, String> {
    let mut film = Film::new([SIZE; 2]);
    let rays = scene.rays(&scene.camera);
    let count = threads.pass(PassJob { scene, rays: &rays, settings }, &mut film, spp, &|| false);
    if let Some(failure) = count.failure {
        return Err(format!("a sample fails: {}", failure.message));
    }
    if let Some(sample) = count.invalid {
        return Err(format!("an invalid sample: pixel {:?}, sample {}", sample.pixel, sample.sample));
    }
    Ok(Frame::of_film(&film, 0, [SIZE; 2], [SIZE; 2]).radiance)
}

fn bits(scene: &Scene, threads: &Threads) -> Result<Bits, String> {
    let radiance = film(scene, &scene.settings, threads, SPP)?;
    Ok(radiance.into_iter().map(|rgb| rgb.map(f32::to_bits)).collect())
}
