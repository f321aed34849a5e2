//! One render of one combination, stopped at powers of two of samples to compare it: the time of comparing does not count.
use std::time::{Duration, Instant};

use super::{Plan, StudyError, checkpoints};
use crate::{
    measure::{Comparison, SampleNoise, compare},
    render::{
        Frame,
        film::Film,
        pass::PassCount,
        sharing::resolved,
        threads::{PassJob, Threads},
    },
    scene::{Camera, RenderSettings, Scene},
};

/// The error after some samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checkpoint {
    /// Samples per pixel.
    pub spp: u32,
    /// Rendering time up to here.
    pub seconds: f64,
    /// As in [`crate::measure::Comparison`].
    pub rmse: f64,
    /// relMSE against the reference.
    pub rel_mse: f64,
    /// Mean difference from the reference.
    pub bias: f64,
    /// Of `bias`, as the variance of the samples gives it; `None` before the second sample.
    pub bias_standard_error: Option<f64>,
    /// How many samples of equal weight would make up that variance, as in [`SampleNoise::effective_samples`]; `None` before the second
    /// sample, and where nothing varies.
    pub effective_samples: Option<f64>,
}

/// What the samples say of the noise of a picture's mean.
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
    /// Time and errors at powers of two of samples.
    pub checkpoints: Vec<Checkpoint>,
    /// Samples that were not finite or negative.
    pub invalid_samples: u64,
    /// Why the picture does not converge to the solution; empty when it does.
    pub bias: String,
    /// Pixels shared paths, and samples went where noise was: what became of the settings.
    pub shares: bool,
    /// Whether sampling was adaptive.
    pub adapts: bool,
}

/// What renders: a scene before a camera, threads, and somebody who may stop it.
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
    /// Brings a film to so many samples a pixel. Returns how long that took.
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

/// Renders one combination as far as the plan says, and compares it with the reference on the way.
pub fn measure(bench: Bench, settings: &RenderSettings, plan: &Plan, reference: &[[f32; 3]]) -> Result<Run, StudyError> {
    let mut film = bench.film();
    // A sample that does not count, since it takes memory and fills caches; but where it takes long that does not matter.
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
    let bias = settings.bias().or((cut_paths > 0).then(|| format!("{cut_paths} paths cut"))).unwrap_or_default();
    let rays = bench.scene.rays(bench.camera);
    let shares = bench.scene.shares(&rays, &resolved(bench.scene, &rays, settings));
    Ok(Run { invalid_samples: film.invalid_samples(), bias, shares, adapts: film.is_adaptive(), ..run })
}

/// The checkpoints of a run as far as the plan says, and the paths that were cut. `to` brings the picture to a number of samples, and says
/// how long that took, how many paths were cut, the error, and the noise of its mean.
pub(super) fn follow(
    plan: &Plan,
    mut to: impl FnMut(u32) -> Result<(Duration, u64, Comparison, Option<NoiseOfMean>), StudyError>,
) -> Result<(Run, u64), StudyError> {
    let (mut run, mut elapsed, mut cut_paths) = (Run::default(), Duration::ZERO, 0);
    for spp in checkpoints(plan.spp) {
        // Refused by the rate so far: a doubling that is cut short would be lost.
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
