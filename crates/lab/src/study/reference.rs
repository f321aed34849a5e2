//! References: the reference of the scene, a file, or a converged render that is made here and kept.
use std::path::{Path, PathBuf};

use super::{
    StudyError, StudyScene,
    key::{hash, hash_of_picture, text},
    measure::Bench,
};
use noisefall_kernel::measure::{Floor, SampleNoise, compare, relative};
use noisefall_render::render::{
    Display, Frame,
    image_file::{self, Provenance},
    reference::Reference as KnownReference,
    settings_text::settings_text,
};
use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::{Estimator, RenderSettings, Roulette},
};

/// Samples of a converged render relative to the longest render that is compared with it.
const TIMES_THE_SAMPLES: u32 = 16;
/// Bit of the seed that distinguishes references from measured renders.
const SEED_OF_REFERENCE: u32 = 1 << 31;
/// Number of parts in which a half is rendered, to show progress.
const PARTS: u32 = 32;

pub struct Reference {
    /// Description for readers.
    pub name: String,
    pub radiance: Vec<[f32; 3]>,
    /// Its own estimated relMSE; 0 if it is exact or assumed to be.
    pub rel_mse: f64,
    /// The variance of its mean over pixels and channels, from its samples; 0 if it is exact or assumed to be.
    pub variance_of_mean: f64,
    /// Its own error is unknown and assumed to be 0.
    pub is_taken_for_exact: bool,
    /// Of relMSE.
    pub floor: Floor,
}

impl Reference {
    /// Fails for a black reference, because relative errors are undefined then.
    fn if_lit(self, study_scene: &StudyScene) -> Result<Reference, StudyError> {
        if self.rel_mse_of_black() > 0.0 {
            return Ok(self);
        }
        let why = study_scene.scene.why_black(&study_scene.camera, &settings(study_scene));
        let reason = format!("{} is entirely black ({why}): there is no error to measure", self.name);
        Err(StudyError::Unmeasurable { path: study_scene.path.clone(), reason })
    }

    /// Mean radiance over pixels and channels.
    pub fn mean(&self) -> f64 {
        let all = self.radiance.as_flattened();
        all.iter().map(|c| f64::from(*c)).sum::<f64>() / all.len().max(1) as f64
    }

    /// The relMSE of a black image.
    pub fn rel_mse_of_black(&self) -> f64 {
        compare(&vec![[0.0; 3]; self.radiance.len()], &self.radiance, self.floor).rel_mse
    }
}

/// The settings of a converged render: unbiased, and the most efficient in most scenes.
pub fn settings(study_scene: &StudyScene) -> RenderSettings {
    let of_scene = study_scene.scene.settings;
    let seeded = RenderSettings { seed: of_scene.seed ^ SEED_OF_REFERENCE, ..of_scene };
    RenderSettings {
        estimator: Estimator::Mis,
        sampler: Sampler::Sobol,
        directions: Directions::Bsdf,
        roulette: Roulette::BY_THROUGHPUT,
        max_bounces: None,
        ..seeded
    }
}

/// The reference of a scene with a `[reference]` or a reference file.
pub fn known(study_scene: &StudyScene, floor: Floor) -> Result<Option<Reference>, StudyError> {
    let Some((known, name)) = &study_scene.known else { return Ok(None) };
    let radiance = radiance(study_scene, known);
    let provenance = if let KnownReference::Picture(_, provenance) = known { Some(provenance) } else { None };
    let own = provenance.and_then(|provenance| own_rel_mse(&radiance, provenance, floor));
    let noise = provenance.and_then(|provenance| provenance.noise.as_ref());
    let reference = Reference {
        name: name.clone(),
        radiance,
        rel_mse: own.unwrap_or(0.0),
        variance_of_mean: noise.map_or(0.0, SampleNoise::variance_of_mean),
        is_taken_for_exact: own.is_none() && !study_scene.is_declared,
        floor,
    };
    reference.if_lit(study_scene).map(Some)
}

/// The relMSE of a rendered image, from the variances in its file, reduced by the factor that the renderer found its samples to
/// be better than independent ones.
fn own_rel_mse(radiance: &[[f32; 3]], provenance: &Provenance, floor: Floor) -> Option<f64> {
    let noise = provenance.noise.as_ref()?;
    let by_variance = |floor: Floor| {
        let floor = floor.of_picture(radiance);
        let pairs = noise.variance.as_flattened().iter().zip(radiance.as_flattened());
        let sum: f64 = pairs.map(|(variance, r)| relative(f64::from(*variance), f64::from(*r), floor)).sum();
        sum / radiance.as_flattened().len() as f64
    };
    let bound = by_variance(Floor::DEFAULT);
    let better = provenance.rel_mse_estimate.filter(|_| bound > 0.0).map_or(1.0, |estimate| (estimate / bound).min(1.0));
    Some(by_variance(floor) * better)
}

/// Hash of everything that a converged render depends on. `spp` is that of the longest render.
pub fn identity(study_scene: &StudyScene, spp: u32) -> u64 {
    match &study_scene.known {
        Some((known, _)) => hash_of_picture(&radiance(study_scene, known)),
        None => spp_of_half(spp).into(),
    }
}

fn spp_of_half(spp_of_longest: u32) -> u32 {
    spp_of_longest.saturating_mul(TIMES_THE_SAMPLES / 2)
}

fn radiance(study_scene: &StudyScene, known: &KnownReference) -> Vec<[f32; 3]> {
    match known {
        KnownReference::Constant(radiance) => {
            let [width, height] = study_scene.camera.resolution;
            vec![*radiance; width as usize * height as usize]
        }
        KnownReference::Picture(picture, _) => picture.radiance.clone(),
    }
}

/// A converged render, kept as two independent halves in a folder.
pub struct Converged<'a> {
    pub study_scene: &'a StudyScene,
    pub bench: Bench<'a>,
    pub folder: &'a Path,
    /// All that an image of the scene depends on besides settings.
    pub fingerprint: u64,
    /// Samples per pixel of the longest render that is compared with it.
    pub spp: u32,
    /// Of relMSE.
    pub floor: Floor,
}

impl Converged<'_> {
    /// Reads or renders the reference. `done` gets the fraction of the work that is done.
    pub fn reference(&self, done: &mut dyn FnMut(f64)) -> Result<Reference, StudyError> {
        match known(self.study_scene, self.floor)? {
            Some(reference) => Ok(reference),
            None => self.render(done)?.if_lit(self.study_scene),
        }
    }

    /// For independent halves a and b, the error of their mean m has the same variance as (a − b)/2 = a − m, so the relMSE of m
    /// is that of a against m.
    fn render(&self, done: &mut dyn FnMut(f64)) -> Result<Reference, StudyError> {
        let halves = [self.half(0, &mut |share| done(share / 2.0))?, self.half(1, &mut |share| done(0.5 + share / 2.0))?];
        let mean = |(a, b): (&[f32; 3], &[f32; 3])| [0, 1, 2].map(|c| 0.5 * (a[c] + b[c]));
        let [(a, of_a), (b, of_b)] = &halves;
        let radiance: Vec<[f32; 3]> = a.iter().zip(b).map(mean).collect();
        let rel_mse = compare(a, &radiance, self.floor).rel_mse;
        let variance_of_mean = (of_a + of_b) / 4.0;
        let name = format!("a converged render (mis, Sobol, {} samples per pixel)", spp_of_half(self.spp) * 2);
        Ok(Reference { name, radiance, rel_mse, variance_of_mean, is_taken_for_exact: false, floor: self.floor })
    }

    fn file(&self, settings: &RenderSettings) -> PathBuf {
        let stem = self.study_scene.path.file_stem().unwrap_or_default().to_string_lossy();
        let parts = [
            self.fingerprint.to_le_bytes(),
            u64::from(settings.seed).to_le_bytes(),
            u64::from(spp_of_half(self.spp)).to_le_bytes(),
        ];
        let key = text(hash(&[&parts.concat()]));
        self.folder.join(format!("reference-{stem}-{key}.exr"))
    }

    /// One half with the variance of its mean, from its file if that is complete.
    fn half(&self, number: u32, done: &mut dyn FnMut(f64)) -> Result<(Vec<[f32; 3]>, f64), StudyError> {
        let settings = settings(self.study_scene);
        let settings = RenderSettings { seed: settings.seed.wrapping_add(number), ..settings };
        let path = self.file(&settings);
        let resolution = self.bench.camera.resolution;
        match image_file::read(&path) {
            Ok(kept) if [kept.width, kept.height] == resolution => {
                let noise = image_file::provenance(&path).noise;
                Ok((kept.radiance, noise.map_or(0.0, |noise| noise.variance_of_mean())))
            }
            _ => {
                let frame = self.render_half(&settings, done)?;
                self.keep(&frame, &settings, &path)?;
                Ok((frame.radiance, frame.noise.map_or(0.0, |noise| noise.variance_of_mean())))
            }
        }
    }

    fn render_half(&self, settings: &RenderSettings, done: &mut dyn FnMut(f64)) -> Result<Frame, StudyError> {
        let mut film = self.bench.film();
        for part in 1..=PARTS {
            let spp = u64::from(spp_of_half(self.spp)) * u64::from(part) / u64::from(PARTS);
            self.bench.pass(settings, &mut film, spp as u32)?;
            done(f64::from(part) / f64::from(PARTS));
        }
        Ok(self.bench.frame(&film))
    }

    fn keep(&self, frame: &Frame, settings: &RenderSettings, path: &Path) -> Result<(), StudyError> {
        let StudyScene { scene, camera, .. } = self.study_scene;
        let text = settings_text(scene, camera, settings, Display::default(), frame, &[]);
        image_file::save(frame, Display::default(), &text, path).map_err(|error| match error {
            image_file::ImageError::Write(error) => error.into(),
            error => StudyError::File { path: path.to_owned(), reason: error.to_string() },
        })
    }
}
