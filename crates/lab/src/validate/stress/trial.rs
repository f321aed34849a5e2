//! Trial of one scene: it is read, compiled, rendered and compared with its exact values.
use std::{
    cell::RefCell,
    panic::{AssertUnwindSafe, catch_unwind},
    time::{Duration, Instant},
};

use super::{
    surfaces::{Comparison, compare},
    trial_scene::{Expected, TrialScene},
};
use crate::validate::check::largest;
use noisefall_base::math::SimdLevel;
use noisefall_kernel::{
    integrator::{Batch, TILE, Work, trace},
    measure::{Mean, sample_image},
};
use noisefall_render::render::pass::panic_message;
use noisefall_scene::scene::{CameraRays, RenderSettings, Scene, parse};

/// Time limit of a scene, more than a hundred times as long as the slowest one takes.
const PATIENCE: Duration = Duration::from_secs(20);
/// Largest relative error of a sample with a known value.
pub const ENERGY: f64 = 1e-4;

/// Outcome of a scene.
#[derive(Default)]
pub struct TrialOutcome {
    pub samples: u64,
    /// Samples that are negative or not finite.
    pub invalid: u64,
    /// Largest relative error of a sample, if every sample is known.
    pub energy: Option<f64>,
    /// The number of samples with a larger error than [`ENERGY`]; `first_off` is the first of them as options of the command
    /// line.
    pub off: u64,
    pub first_off: Option<String>,
    /// Fraction of the light that is lost, if some loss is allowed.
    pub lost: Option<f64>,
    /// Deviation of the mean in standard errors, if the mean is known.
    pub z: Option<f64>,
    pub surfaces: Comparison,
    /// Whether the scene was rejected with a position.
    pub refused: bool,
    pub seconds: f64,
    /// Any other failure: a panic, a time-out, a valid scene that was rejected, or an invalid one that was not.
    pub trouble: Option<String>,
}

thread_local! {
    static BATCH: RefCell<Batch> = RefCell::default();
}

/// Tries a scene. `text` is the whole file of the trial scene.
pub fn run(text: &str, trial_scene: &TrialScene, settings: impl Fn(RenderSettings) -> RenderSettings) -> TrialOutcome {
    let start = Instant::now();
    let tried = catch_unwind(AssertUnwindSafe(|| try_scene(text, trial_scene, settings, start)));
    let mut outcome = tried.unwrap_or_else(|panic| TrialOutcome::trouble(format!("panics: {}", panic_message(&*panic))));
    outcome.seconds = start.elapsed().as_secs_f64();
    if outcome.trouble.is_none() && start.elapsed() > PATIENCE {
        outcome.trouble = Some(format!("takes {:.0} s", outcome.seconds));
    }
    outcome
}

impl TrialOutcome {
    fn trouble(what: impl Into<String>) -> TrialOutcome {
        TrialOutcome { trouble: Some(what.into()), ..TrialOutcome::default() }
    }
}

fn try_scene(
    text: &str,
    trial_scene: &TrialScene,
    settings: impl Fn(RenderSettings) -> RenderSettings,
    start: Instant,
) -> TrialOutcome {
    let may_be_refused = matches!(trial_scene.expected, Expected::Refused | Expected::ValidOrRefused);
    let scene = match parse("stress", text.to_owned()) {
        Ok(_) if trial_scene.expected == Expected::Refused => return TrialOutcome::trouble("is not rejected"),
        Ok(scene) => scene,
        Err(error) if may_be_refused && error.line_column().is_some() && !error.to_string().is_empty() => {
            return TrialOutcome { refused: true, ..TrialOutcome::default() };
        }
        Err(error) => return TrialOutcome::trouble(format!("is refused: {error}")),
    };
    let (settings, rays) = (settings(scene.settings), scene.rays(&scene.camera));
    let Some(outcome) = render(&scene, &settings, &rays, trial_scene, start) else {
        return TrialOutcome::trouble(format!("is not finished after {} s", PATIENCE.as_secs()));
    };
    let surfaces = compare(&scene, &settings, &rays, matches!(trial_scene.expected, Expected::Everywhere(_)));
    TrialOutcome { surfaces, ..outcome }
}

/// Renders the scene. Returns `None` if that takes too long.
fn render(
    scene: &Scene,
    settings: &RenderSettings,
    rays: &CameraRays,
    trial_scene: &TrialScene,
    start: Instant,
) -> Option<TrialOutcome> {
    let size = scene.camera.resolution.map(|side| side.min(TILE));
    let mut outcome = TrialOutcome::default();
    let (mut sum, mut square, mut worst) = (0.0, 0.0, 0.0f64);
    let exact = match trial_scene.expected {
        Expected::Everywhere(exact) | Expected::Mean(exact) | Expected::Within { radiance: exact, .. } => exact,
        _ => 1.0,
    };
    if scene.traces_light_paths(settings) {
        return render_bidirectional(scene, settings, rays, trial_scene, exact, start);
    }
    for sample in 0..trial_scene.spp {
        let work = Work::tile(scene, rays, settings, [0, 0], size, sample);
        BATCH.with_borrow_mut(|batch| {
            trace(SimdLevel::best(), &work, batch, &|| start.elapsed() > PATIENCE).ok()?;
            for slot in (0..size[1]).flat_map(|row| (0..size[0]).map(move |column| row * TILE + column)) {
                let [r, g, b, _] = batch.radiance()[slot as usize];
                outcome.samples += 1;
                outcome.invalid += u64::from([r, g, b].iter().any(|x| !x.is_finite() || *x < 0.0));
                let relative = f64::from(r) / exact;
                let error = largest([r, g, b].map(|x| (f64::from(x) / exact - 1.0).abs()));
                if error > ENERGY {
                    outcome.off += 1;
                    outcome.first_off.get_or_insert_with(|| format!("--pixel {},{} --sample {sample}", slot % TILE, slot / TILE));
                }
                worst = largest([worst, error]);
                (sum, square) = (sum + (relative - 1.0), square + (relative - 1.0).powi(2));
            }
            Some(())
        })?;
    }
    match trial_scene.expected {
        Expected::Everywhere(_) => outcome.energy = Some(worst),
        Expected::Within { .. } => outcome.lost = Some((sum / outcome.samples as f64).abs()),
        Expected::Mean(_) => outcome.z = Some(deviation(sum, square, outcome.samples as f64)),
        _ => {}
    }
    Some(outcome)
}

/// Renders the scene with light paths, too. Only means are known, and that of an image is a single value, as its pixels depend on
/// each other.
fn render_bidirectional(
    scene: &Scene,
    settings: &RenderSettings,
    rays: &CameraRays,
    trial_scene: &TrialScene,
    exact: f64,
    start: Instant,
) -> Option<TrialOutcome> {
    let mut outcome = TrialOutcome::default();
    let (mut sum, mut square) = (0.0, 0.0);
    for sample in 0..trial_scene.spp {
        let image = sample_image(scene, rays, settings, sample, &|| start.elapsed() > PATIENCE).ok()?;
        outcome.samples += image.len() as u64;
        outcome.invalid +=
            image.iter().filter(|[r, g, b, _]| ![r, g, b].iter().all(|x| (0.0..=f32::MAX).contains(*x))).count() as u64;
        let relative = image.iter().map(|[r, ..]| f64::from(*r) / exact).sum::<f64>() / image.len() as f64 - 1.0;
        (sum, square) = (sum + relative, square + relative * relative);
    }
    if let Expected::Mean(_) | Expected::Everywhere(_) = trial_scene.expected {
        outcome.z = Some(deviation(sum, square, f64::from(trial_scene.spp)));
    }
    Some(outcome)
}

/// Deviation from 1 of a mean, in standard errors that include the error of tables of lost energy.
fn deviation(sum: f64, square: f64, count: f64) -> f64 {
    let mean = sum / count;
    let variance = (square / count - mean * mean).max(0.0) / count;
    Mean { mean: 1.0 + mean, variance_of_mean: variance + (crate::validate::check::TABLES / crate::validate::SIGMAS).powi(2) }
        .z(1.0)
}
