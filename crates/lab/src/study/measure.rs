//! Measures one render of one combination: it pauses at powers of two of samples and is compared. Only rendering is timed.
use std::time::{Duration, Instant};

use super::{Plan, StudyError, checkpoints};
use noisefall_kernel::measure::{Comparison, SampleNoise, compare};
use noisefall_render::render::{
    Frame,
    film::Film,
    pass::PassCount,
    path_reuse::resolved,
    threads::{PassJob, Threads},
};
use noisefall_scene::scene::{Camera, PathReuse, RenderSettings, Scene};

/// The errors at one sample count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checkpoint {
    /// Samples per pixel.
    pub spp: u32,
    /// Rendering time up to here.
    pub seconds: f64,
    /// As in [`noisefall_kernel::measure::Comparison`].
    pub rmse: f64,
    /// relMSE against the reference.
    pub rel_mse: f64,
    /// Mean difference from the reference.
    pub bias: f64,
    /// Standard error of `bias` from the sample variance; `None` before the second sample.
    pub bias_standard_error: Option<f64>,
    /// Effective number of samples behind that variance, as in [`SampleNoise::effective_samples`]; `None` before the second
    /// sample, or if nothing varies.
    pub effective_samples: Option<f64>,
}

/// Noise of the mean of an image, from its samples.
#[derive(Clone, Copy, Debug)]
pub(super) struct NoiseOfMean {
    pub standard_error: f64,
    pub effective_samples: f64,
}

impl NoiseOfMean {
    fn of(noise: &SampleNoise) -> NoiseOfMean {
        NoiseOfMean { standard_error: noise.variance_of_mean().sqrt(), effective_samples: noise.effective_samples }
    }
}

/// One render of one combination.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Run {
    /// Times and errors at powers of two of samples.
    pub checkpoints: Vec<Checkpoint>,
    /// Number of samples that were negative or not finite.
    pub invalid_samples: u64,
    /// Why the estimate is biased; empty if it is not.
    pub bias: String,
    /// Path reuse, as the settings and the scene decided.
    pub path_reuse: PathReuse,
    /// Whether sampling was adaptive.
    pub adapts: bool,
}

/// Everything that a render needs besides its settings.
#[derive(Clone, Copy)]
pub struct Bench<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its camera at the resolution of the study.
    pub camera: &'a Camera,
    /// The threads that render.
    pub threads: &'a Threads,
    /// Whether to stop.
    pub stop: &'a (dyn Fn() -> bool + Sync),
}

impl Bench<'_> {
    /// Renders a film up to `spp` samples per pixel. Returns the rendering time.
    pub fn pass(&self, settings: &RenderSettings, film: &mut Film, spp: u32) -> Result<(Duration, PassCount), StudyError> {
        let scene = self.scene;
        let rays = scene.rays(self.camera);
        let settings = self.threads.install(|| resolved(scene, &rays, settings));
        let start = Instant::now();
        let count = self.threads.pass(PassJob { scene, rays: &rays, settings: &settings }, film, spp, self.stop);
        let took = start.elapsed();
        match &count.failure {
            Some(failure) => Err(StudyError::Renderer(failure.message.clone())),
            None if film.spp() < spp => Err(StudyError::Interrupted),
            None => Ok((took, count)),
        }
    }

    /// The image of a film.
    pub fn frame(&self, film: &Film) -> Frame {
        let resolution = self.camera.resolution;
        self.threads.install(|| Frame::of_film(film, 0, resolution, resolution))
    }

    /// An empty film.
    pub fn film(&self) -> Film {
        Film::new(self.camera.resolution)
    }
}

/// Renders one combination up to the limits of the plan, and compares it with the reference at every checkpoint.
pub fn measure(bench: Bench, settings: &RenderSettings, plan: &Plan, reference: &[[f32; 3]]) -> Result<Run, StudyError> {
    let mut film = bench.film();
    // A warm-up sample that does not count: it allocates memory and fills caches. Slow scenes do not need it.
    let mut counts = Some(bench.pass(settings, &mut film, 1)?);
    if counts.as_ref().is_some_and(|(took, _)| *took < plan.time) {
        (counts, film) = (None, film.recycled(bench.camera.resolution));
    }
    let (run, cut_paths) = follow(plan, |spp| {
        let (took, count) = counts.take().map_or_else(|| bench.pass(settings, &mut film, spp), Ok)?;
        let frame = bench.frame(&film);
        let noise = frame.noise.as_ref().map(NoiseOfMean::of);
        Ok((took, count.cut_paths, compare(&frame.radiance, reference, plan.floor), noise))
    })?;
    let rays = bench.scene.rays(bench.camera);
    let path_reuse = bench.scene.path_reuse(&rays, &resolved(bench.scene, &rays, settings));
    let cut = (cut_paths > 0).then(|| format!("{cut_paths} paths cut"));
    let bias = settings.bias_with(path_reuse).or(cut).unwrap_or_default();
    Ok(Run { invalid_samples: film.invalid_samples(), bias, path_reuse, adapts: film.is_adaptive(), ..run })
}

/// The checkpoints of a run up to the limits of the plan, and the number of paths that were cut. `to` renders up to a sample
/// count, and returns the time, the number of paths cut, the error, and the noise of the mean.
pub(super) fn follow(
    plan: &Plan,
    mut to: impl FnMut(u32) -> Result<(Duration, u64, Comparison, Option<NoiseOfMean>), StudyError>,
) -> Result<(Run, u64), StudyError> {
    let (mut run, mut elapsed, mut cut_paths) = (Run::default(), Duration::ZERO, 0);
    for spp in checkpoints(plan.spp) {
        // Skipped if it would end too late at the rate so far, because an incomplete doubling would be lost.
        let before = run.checkpoints.last().map_or(spp, |last| last.spp);
        if elapsed.as_secs_f64() * f64::from(spp) / f64::from(before) > plan.time.as_secs_f64() {
            break;
        }
        let (took, cut, error, noise) = to(spp)?;
        elapsed += took;
        cut_paths += cut;
        let seconds = elapsed.as_secs_f64();
        let Comparison { rmse, rel_mse, bias } = error;
        let bias_standard_error = noise.map(|noise| noise.standard_error);
        let effective_samples = noise.map(|noise| noise.effective_samples).filter(|count| count.is_finite());
        run.checkpoints.push(Checkpoint { spp, seconds, rmse, rel_mse, bias, bias_standard_error, effective_samples });
    }
    Ok((run, cut_paths))
}
