//! Advice: a short study of one scene that recommends the most efficient sampler, roulette, estimator and path reuse.
//!
//! ```text
//! settings in use ─▶ first stage: each roulette, estimator, path reuse ─▶ second stage: with the best of these, each sampler ─▶ Advice
//! Rounds: an image of each ─▶ Measured: noise and time ─▶ rank
//! ```
//! No reference is needed: images of the same settings with different seeds differ by their noise alone. This holds for every
//! sampler, because each seed scrambles its points differently. All candidates converge to the same image, because directions
//! and cap stay as they are. Settings that miss light that others find are never recommended.
mod candidate;
mod candidates;
mod measured;
mod missing;
mod rank;
mod rounds;
#[cfg(test)]
mod tests;
mod wording;

use std::time::Duration;

pub use self::candidate::{Advice, Candidate};
use self::{
    candidates::{MOST_OF_SECOND_STAGE, adopted, first_stage, second_stage},
    measured::measured,
    rank::rank,
    rounds::{Rounds, SPP},
};
use super::{StudyError, measure::Bench, plan::study_size};
use noisefall_render::render::{path_reuse::resolved, threads::Threads};
use noisefall_scene::scene::{Camera, PathReuse, RenderSettings, Reuse, Scene};

/// Rounds of a stage. Fewer would give a poor estimate of the spread, so if time is short the images are made smaller instead.
const ROUNDS: u32 = 8;
/// Smallest length of the longer side of an image, pixels.
const LEAST_SIDE: f64 = 32.0;

/// Tries candidates that could be better than `settings` for about this `time`. `progress` gets the number of images that are
/// finished and the number of all. `stop` is called within every batch.
pub fn advise(
    scene: &Scene,
    camera: &Camera,
    settings: &RenderSettings,
    threads: &Threads,
    time: Duration,
    progress: &mut dyn FnMut(usize, usize),
    stop: &(dyn Fn() -> bool + Sync),
) -> Result<Advice, StudyError> {
    let camera = Camera { resolution: study_size(camera.resolution), ..*camera };
    let first = threads.install(|| {
        let all = first_stage(settings, &other_reuses(scene, &camera, settings));
        rendered_otherwise(scene, &camera, all)
    });
    let bench = Bench { scene, camera: &camera, threads, stop };
    let in_a_round = first.len() + MOST_OF_SECOND_STAGE;
    let seconds = sample_of_each(bench, &first)? * f64::from(SPP) * in_a_round as f64 / first.len() as f64;
    let share = time.as_secs_f64() / (seconds * f64::from(ROUNDS));
    let camera = Camera { resolution: reduced(camera.resolution, share), ..camera };

    let total = ROUNDS as usize * in_a_round;
    let mut done = 0;
    let mut made = || {
        done += 1;
        progress(done, total);
    };
    let mut pictures = Rounds::new(Bench { camera: &camera, ..bench });
    pictures.make(&first, 0..ROUNDS, &mut made)?;
    let base = adopted(&rank(&threads.install(|| measured(&pictures.series)), SPP));
    pictures.make(&second_stage(settings, &base), ROUNDS..2 * ROUNDS, &mut made)?;
    let advice = rank(&threads.install(|| measured(&pictures.series)), SPP);
    // Candidates of both stages are measured once.
    progress(total, total);
    Ok(advice)
}

/// Returns the possible path reuse that is not in use.
fn other_reuses(scene: &Scene, camera: &Camera, settings: &RenderSettings) -> Vec<Reuse> {
    let rays = scene.rays(camera);
    let now = scene.path_reuse(&rays, &resolved(scene, &rays, settings));
    let possible = scene.possible_path_reuse(&rays, settings);
    possible.into_iter().filter(|path_reuse| *path_reuse != now).map(PathReuse::reuse).collect()
}

/// The first settings, and those of the others that are rendered in another way: `auto` is not compared with the estimator that it chooses.
fn rendered_otherwise(scene: &Scene, camera: &Camera, mut settings: Vec<RenderSettings>) -> Vec<RenderSettings> {
    let rays = scene.rays(camera);
    let in_use = settings[0];
    let in_force = resolved(scene, &rays, &in_use);
    settings.retain(|settings| *settings == in_use || resolved(scene, &rays, settings) != in_force);
    settings
}

/// The time in seconds of one sample per pixel of every candidate. A warm-up sample before that does not count: it allocates
/// memory, fills caches, and decides about path reuse.
fn sample_of_each(bench: Bench, candidates: &[RenderSettings]) -> Result<f64, StudyError> {
    let mut seconds = 0.0;
    for settings in candidates {
        let mut film = bench.film();
        bench.pass(settings, &mut film, 1)?;
        seconds += bench.pass(settings, &mut film, 2)?.0.as_secs_f64();
    }
    Ok(seconds)
}

/// A resolution of the same aspect ratio with this fraction of the pixels, but not below [`LEAST_SIDE`], and never a larger one.
fn reduced(resolution: [u32; 2], share: f64) -> [u32; 2] {
    let longer = f64::from(resolution[0].max(resolution[1]));
    let scale = share.sqrt().max(LEAST_SIDE / longer).min(1.0);
    resolution.map(|side| (f64::from(side) * scale).round().max(1.0) as u32)
}
