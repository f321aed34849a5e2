//! The reference that a render must converge to: from the scene, or by another program.
use std::{borrow::Cow, path::Path, sync::Arc};

use super::{
    film::Film,
    frame::Frame,
    image_file::{ImageError, Picture, Provenance, provenance, read},
    threads::{PassJob, Threads},
};
use noisefall_kernel::measure::{Bias, BlockErrors, Comparison, Floor, SampleNoise, compare};
use noisefall_scene::{
    sampling::Sampler,
    scene::{Camera, RenderSettings, Reuse, Roulette, Scene, SceneReference},
};

/// Why a `[reference]` is not one.
const DENOISED: &str = "the reference image is denoised, and so biased";

/// The reference of a scene. It is valid for the camera of the scene file.
pub enum Reference {
    /// A constant radiance for every pixel, at any resolution.
    Constant([f32; 3]),
    /// An image of one resolution, with the metadata of its file about its own noise; none if it is exact.
    Picture(Arc<Picture>, Arc<Provenance>),
}

impl Reference {
    /// The scene's reference, if it has one.
    pub fn of(scene: &Scene) -> Option<Reference> {
        match scene.reference.as_ref()? {
            SceneReference::Radiance(radiance) => Some(Reference::Constant(*radiance)),
            SceneReference::Image(path, picture) => Some(Reference::Picture(picture.clone(), Arc::new(provenance(path)))),
        }
    }

    /// Reads an image file as a reference. Fails for a denoised image.
    pub fn read(path: &Path) -> Result<Reference, ImageError> {
        let (picture, provenance) = (read(path)?, provenance(path));
        if provenance.is_denoised {
            return Err(ImageError::Denoised(path.to_owned()));
        }
        Ok(Reference::Picture(Arc::new(picture), Arc::new(provenance)))
    }

    /// The relative noise of the reference itself: the root of its relMSE; `None` if it is exact or does not tell.
    pub fn relative_noise(&self) -> Option<f64> {
        let Reference::Picture(_, provenance) = self else { return None };
        provenance.rel_mse_estimate.map(f64::sqrt)
    }

    /// Whether it is a denoised image. Nothing is compared with that, because it is biased.
    pub fn is_denoised(&self) -> bool {
        matches!(self, Reference::Picture(_, provenance) if provenance.is_denoised)
    }

    /// The reason why images of this resolution cannot be compared with the reference, if they cannot.
    pub fn mismatch(&self, [width, height]: [u32; 2]) -> Option<String> {
        match self {
            _ if self.is_denoised() => Some(format!("{DENOISED}, so the error is not known")),
            Reference::Picture(p, _) if [p.width, p.height] != [width, height] => {
                let size = format!("{} × {}", p.width, p.height);
                Some(format!("the reference image is {size} and this one {width} × {height}, so the error is not known"))
            }
            _ => None,
        }
    }

    /// The exact radiance of every pixel of a frame, if the frame can be compared with the reference.
    pub fn radiance_of(&self, frame: &Frame) -> Option<Cow<'_, [[f32; 3]]>> {
        match self {
            Reference::Constant(radiance) => Some(vec![*radiance; frame.radiance.len()].into()),
            Reference::Picture(picture, _) => {
                let can_compare = self.mismatch([frame.width, frame.height]).is_none();
                can_compare.then(|| picture.radiance.as_slice().into())
            }
        }
    }

    /// The error of a frame, if it has the reference's resolution.
    pub fn compare(&self, frame: &Frame) -> Option<Comparison> {
        Some(compare(&frame.radiance, &self.radiance_of(frame)?, Floor::DEFAULT))
    }

    /// The relMSE of a frame, and the same without each of its blocks, if it has the reference's resolution.
    pub fn block_errors(&self, frame: &Frame) -> Option<BlockErrors> {
        let reference = self.radiance_of(frame)?;
        let floor = Floor::DEFAULT.of_picture(&reference);
        Some(BlockErrors::rel_mse(&frame.radiance, &reference, frame.width as usize, floor))
    }

    /// The bias of a frame against the reference; `None` if the frame has another resolution.
    pub fn bias(&self, frame: &Frame) -> Option<Bias> {
        let reference = self.radiance_of(frame)?;
        let of_reference = if let Reference::Picture(_, provenance) = self { provenance.noise.as_ref() } else { None };
        Some(Bias::by_samples(&frame.radiance, &reference, [frame.noise.as_ref(), of_reference], frame.width as usize))
    }

    /// A message if a frame contradicts the reference: its mean, or that of a block, is off by more than chance explains.
    pub fn contradiction(&self, frame: &Frame) -> Option<String> {
        /// Limit in standard errors. By chance, one in two million images exceeds it.
        const MOST: f64 = 5.0;
        let bias = self.bias(frame).filter(|bias| !bias.has_heavy_tails && !frame.is_black())?;
        let off = match bias.z {
            Some(z) if z.abs() > MOST => format!("by {:.1} standard errors", z.abs()),
            None if bias.is_exact && bias.mean.abs() > bias.rounding => "although its samples have no noise".to_owned(),
            _ => return self.contradiction_of_block(frame, &bias),
        };
        let more = if bias.mean > 0.0 { "more" } else { "less" };
        Some(format!("the image has {:.3e} {more} radiance on average than [reference] says, {off}", bias.mean.abs()))
    }

    /// A message if the mean of the image is right, but that of a block is not: the image may be turned, mirrored or another view.
    fn contradiction_of_block(&self, frame: &Frame, bias: &Bias) -> Option<String> {
        /// Standard errors: those of a block are less sure than those of the image.
        const MOST: f64 = 10.0;
        /// Fraction of the mean of the image; a smaller deviation may be light that a block has not found yet.
        const LEAST_PART: f64 = 0.1;
        /// For each block.
        const EFFECTIVE_SAMPLES: f64 = 100.0;
        let (reference, width) = (self.radiance_of(frame)?, frame.width as usize);
        let are_known = frame.noise.as_ref()?.effective_samples >= EFFECTIVE_SAMPLES * bias.block_z.len() as f64;
        let mean = |rgb: &[f32; 3]| rgb.iter().map(|c| f64::from(*c)).sum::<f64>() / 3.0;
        let level = reference.iter().map(mean).sum::<f64>() / reference.len().max(1) as f64;
        let differences: Vec<f64> = frame.radiance.iter().zip(reference.iter()).map(|(x, r)| mean(x) - mean(r)).collect();
        let blocks = bias.block_z.iter().zip(SampleNoise::block_means(&differences, width)).enumerate();
        let large = blocks.filter(|(_, (z, difference))| z.abs() > MOST && difference.abs() > LEAST_PART * level);
        let (block, (z, difference)) =
            large.max_by(|(_, (a, _)), (_, (b, _))| a.abs().total_cmp(&b.abs())).filter(|_| are_known)?;
        let columns = width.div_ceil(SampleNoise::BLOCK);
        let [x, y] = [block % columns, block / columns].map(|place| place * SampleNoise::BLOCK);
        let more = if difference > 0.0 { "more" } else { "less" };
        Some(format!(
            "the block of {0} × {0} pixels from {x},{y} on has {more} radiance than [reference] says, by {1:.1} standard errors, though the mean of \
             the image agrees",
            SampleNoise::BLOCK,
            z.abs()
        ))
    }
}

/// A message if a small image with independent samples contradicts the `[reference]` of a scene, or if that is a denoised image.
pub fn contradiction(scene: &Scene, threads: &Threads) -> Option<String> {
    /// Longer side of the image if the reference is constant, so that any resolution is valid.
    const LONGER_SIDE: u32 = 48;
    /// Samples of the whole image.
    const SAMPLES: u64 = 1 << 23;
    let reference = Reference::of(scene)?;
    if reference.is_denoised() {
        return Some(DENOISED.to_owned());
    }
    let [width, height] = scene.camera.resolution;
    let resolution = match &reference {
        Reference::Picture(picture, _) => [picture.width, picture.height],
        Reference::Constant(_) => [width, height].map(|side| (side * LONGER_SIDE / width.max(height)).max(1)),
    };
    let spp = (SAMPLES / resolution.map(u64::from).iter().product::<u64>()).clamp(2, 64) as u32;
    let camera = Camera { resolution, ..scene.camera };
    let settings = RenderSettings {
        sampler: Sampler::Independent,
        roulette: Roulette::BY_THROUGHPUT,
        max_bounces: None,
        reuse: Reuse::Off,
        adaptive: false,
        ..scene.settings
    };
    let (rays, mut film) = (scene.rays(&camera), Film::new(resolution));
    let count = threads.pass(PassJob { scene, rays: &rays, settings: &settings }, &mut film, spp, &|| false);
    let frame = threads.install(|| Frame::of_film(&film, 0, resolution, resolution));
    if count.cut_paths == 0 && count.failure.is_none() { reference.contradiction(&frame) } else { None }
}
