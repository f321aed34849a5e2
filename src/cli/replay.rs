//! `noisefall render --pixel X,Y --sample N`: prints one path vertex by vertex, or a table of the samples of a pixel.
use std::path::Path;

use noisefall_base::file::replace;
use noisefall_kernel::integrator::{pixel_samples, replay};
use noisefall_render::render::{
    path_reuse::resolved,
    path_samples::{self, SampleTable},
    path_text::{self, PathId},
};
use noisefall_scene::scene::{Camera, CameraRays, RenderSettings, Scene};

use super::messages::{Failure, print, tell};

/// Samples that are traced together.
const BATCH: u32 = 1 << 12;
/// Largest number of samples that are searched for one that finds light.
const MOST_LOOKED_AT: u32 = 1 << 20;
/// Largest number of samples in a table.
pub const MOST_LISTED: u32 = 1_000_000;

/// A selection of samples of the pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Which {
    One(u32),
    /// The first and the last number of a range.
    Range(u32, u32),
    /// The first sample that finds light.
    Lit,
}

/// Output format of a replay.
#[derive(Clone, Copy)]
pub enum Form<'a> {
    Text,
    Latex,
    Json,
    /// A table of samples in this file; `-` is standard output.
    Csv(&'a Path),
}

/// A pixel and everything that its samples depend on.
struct Pixel<'a> {
    scene: &'a Scene,
    camera: &'a Camera,
    settings: RenderSettings,
    rays: CameraRays,
    pixel: [u32; 2],
}

pub fn run(
    scene: &Scene,
    camera: &Camera,
    settings: &RenderSettings,
    pixel: [u32; 2],
    which: Which,
    form: Form,
) -> Result<(), Failure> {
    let [width, height] = camera.resolution;
    if pixel[0] >= width || pixel[1] >= height {
        return Err(format!("pixel {},{} lies outside the image of {width} × {height}", pixel[0], pixel[1]));
    }
    let rays = scene.rays(camera);
    let pixel = Pixel { scene, camera, settings: resolved(scene, &rays, settings), rays, pixel };
    let (first, last) = match which {
        Which::One(sample) => (sample, sample),
        Which::Range(first, last) => (first, last),
        Which::Lit => pixel.first_lit().map(|sample| (sample, sample))?,
    };
    match form {
        Form::Csv(path) => pixel.list(first, last, path),
        _ if first != last => Err("a range of samples is printed as a table: add --csv FILE, or --csv -".to_owned()),
        _ => pixel.show(first, form),
    }
}

impl Pixel<'_> {
    fn samples(&self, first: u32, last: u32) -> Vec<[f32; 3]> {
        let end = last.saturating_add(1);
        pixel_samples(self.scene, &self.rays, &self.settings, self.pixel, first..end, &|| false).unwrap_or_default()
    }

    /// The first sample whose own path finds light; light of reused paths does not count.
    fn first_lit(&self) -> Result<u32, Failure> {
        let is_lit = |sample: u32| {
            let replay = replay(self.scene, &self.rays, &self.settings, self.pixel, sample);
            replay.alone.unwrap_or(replay.radiance) != [0.0; 3]
        };
        for first in (0..MOST_LOOKED_AT).step_by(BATCH as usize) {
            let samples = self.samples(first, first + BATCH - 1);
            let mut found = (first..).zip(&samples).filter(|(_, rgb)| **rgb != [0.0; 3]).map(|(sample, _)| sample);
            if let Some(sample) = found.find(|sample| is_lit(*sample)) {
                return Ok(sample);
            }
        }
        Err(format!("none of the first {MOST_LOOKED_AT} samples of this pixel finds light"))
    }

    fn show(&self, sample: u32, form: Form) -> Result<(), Failure> {
        let Pixel { scene, camera, settings, rays, pixel } = self;
        let replay = replay(scene, rays, settings, *pixel, sample);
        let id = PathId { scene, camera, settings, pixel: *pixel, sample };
        print(&match form {
            Form::Json => serde_json::json!(replay).to_string(),
            Form::Latex => path_text::latex(&id, &replay),
            Form::Text | Form::Csv(_) => path_text::text(&id, &replay),
        })
    }

    fn list(&self, first: u32, last: u32, path: &Path) -> Result<(), Failure> {
        if last - first >= MOST_LISTED {
            return Err(format!("a table has at most {MOST_LISTED} samples"));
        }
        path_samples::remark(self.settings.sampler).iter().for_each(|remark| tell(&format!("warning: {remark}")));
        let mut table = SampleTable::default();
        for begin in (first..=last).step_by(BATCH as usize) {
            table.extend(begin, &self.samples(begin, last.min(begin.saturating_add(BATCH - 1))));
        }
        let csv = table.csv();
        if path == Path::new("-") {
            return print(csv.trim_end());
        }
        replace(path, csv.as_bytes()).map_err(|error| error.to_string())?;
        print(&format!("samples: {}", path.display()))
    }
}
