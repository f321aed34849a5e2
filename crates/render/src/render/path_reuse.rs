//! Decides what pixels share, by a trial on parts of a few tiles.
use std::panic::{AssertUnwindSafe, catch_unwind};

use rayon::prelude::*;

use super::{light_trial::estimator_unless, threads::PassJob, tile::Tile};
use noisefall_base::{math::SimdLevel, parallel::PerThread};
use noisefall_kernel::{
    integrator::{Batch, Interrupted, TILE, Work, thresholds, trace},
    measure::{Floor, relative},
};
use noisefall_scene::scene::{CameraRays, Estimator, PathReuse, RenderSettings, Reuse, Scene};

/// Positions of the parts of the image that are tried.
const PLACES: [[f64; 2]; 5] = [[0.25, 0.25], [0.75, 0.25], [0.5, 0.5], [0.25, 0.75], [0.75, 0.75]];
/// Width and height of a part. Whole tiles decide nearly the same, and 16 samples per pixel then take 2 to 6 % longer (benches/LOG.md).
const SIZE: [u32; 2] = [TILE, TILE / 2];
/// Samples per pixel, for each way to share and each seed.
const SPP: u32 = 4;
/// Errors are relative to the mean of this many pixels, a row of a tile: the mean of a pixel alone follows its noise.
const ROW: usize = TILE as usize;
/// Cost of a sample with reused path suffixes relative to one without: in scenes of lists, and in scenes with trees. Measured costs are 1.7
/// to 2.2 and 1.1 to 1.5.
const COST: f64 = 2.1;
const COST_WITH_TREES: f64 = 1.4;
/// Cost of a ray of a replay relative to other rays: replays are few, and go where paths are long.
const COST_OF_REPLAYS: f64 = 1.5;
/// Rays of replays, relative to all others, from which suffixes that do not pay alone are tried together with outliers.
const MANY_REPLAYS: f64 = 0.5;
/// Outliers are tried if outliers have this part of the error. With less, all of them could not gain as much.
const LEAST_OUTLIERS: f64 = 0.2;
/// The gain that makes correlated noise worth it. The trial sees few outliers.
const LEAST_GAIN: f64 = 1.3;
/// Seeds that images are unlikely to have.
const SEEDS: [u32; 2] = [0x7f4a_7c15, 0x2545_f491];

/// Resolves [`Estimator::Auto`] and [`Reuse::Auto`] in settings. Where path reuse is possible, the decision depends on the scene
/// alone and is made once, with the scene's own estimator, or with `mis` if that one has light paths: a change of sampler,
/// estimator or cap never turns path reuse on or off.
pub fn resolved(scene: &Scene, rays: &CameraRays, settings: &RenderSettings) -> RenderSettings {
    resolved_unless(scene, rays, settings, &|| false).unwrap_or(*settings)
}

/// Resolves settings unless the trial is interrupted. Then nothing is decided.
pub(super) fn resolved_unless(
    scene: &Scene,
    rays: &CameraRays,
    settings: &RenderSettings,
    interrupted: &(dyn Fn() -> bool + Sync),
) -> Result<RenderSettings, Interrupted> {
    let decided = || {
        let known = &scene.path_reuse_by_trial;
        if let Some(best) = known.get() {
            return Ok(*best);
        }
        // A scene that fails will fail again in the pass, which reports the place.
        let best = catch_unwind(AssertUnwindSafe(|| best(scene, interrupted))).unwrap_or(Ok(PathReuse::Off))?;
        Ok(*known.get_or_init(|| best))
    };
    let settings = &RenderSettings {
        estimator: estimator_unless(scene, settings, interrupted)?,
        merging: scene.merges(settings),
        ..*settings
    };
    if settings.reuse != Reuse::Auto {
        return Ok(*settings);
    }
    let possible = scene.possible_path_reuse(rays, settings);
    let best = if possible.len() > 1 { decided()? } else { PathReuse::Off };
    let reuse = if possible.contains(&best) { best.reuse() } else { Reuse::Off };
    Ok(RenderSettings { reuse, ..*settings })
}

/// Result of a trial of path reuse.
struct ReuseTrial {
    /// Means of the pixels of all parts, row by row, with each seed.
    images: [Vec<[f64; 3]>; 2],
    rays: f64,
}

/// Tries path suffixes first, and then outliers in addition to what is better. Suffixes that do not pay alone are tried again beside
/// many replays: they leave fewer outliers, and take a smaller part of the time.
fn best(scene: &Scene, interrupted: &(dyn Fn() -> bool + Sync)) -> Result<PathReuse, Interrupted> {
    // With light paths nothing is shared, but another estimator may be chosen later.
    let own = scene.settings.estimator;
    let estimator = if own.traces_light_paths() { Estimator::Mis } else { own };
    let settings = RenderSettings { estimator, ..Default::default() };
    let rays = scene.rays(&scene.camera);
    let possible = scene.possible_path_reuse(&rays, &settings);
    let batches = PerThread::new(rayon::current_num_threads());
    let trial = |path_reuse: PathReuse| {
        trial(scene, &rays, &RenderSettings { reuse: path_reuse.reuse(), ..settings }, &batches, interrupted)
    };
    let mut best = (PathReuse::Off, trial(PathReuse::Off)?);
    if possible.contains(&PathReuse::Suffixes) {
        let suffixes = trial(PathReuse::Suffixes)?;
        let cost = if scene.shapes.are_listed() { COST } else { COST_WITH_TREES };
        if gain(&best.1, &suffixes) > cost {
            best = (PathReuse::Suffixes, suffixes);
        }
    }
    let with_bright = if best.0.has_suffixes() { PathReuse::Both } else { PathReuse::Outliers };
    if !possible.contains(&with_bright) || part_of_outliers(&best.1) <= LEAST_OUTLIERS {
        return Ok(best.0);
    }
    let bright = trial(with_bright)?;
    let replays = bright.rays / best.1.rays.max(1.0) - 1.0;
    if gain(&best.1, &bright) <= LEAST_GAIN * (1.0 + COST_OF_REPLAYS * replays) {
        return Ok(best.0);
    }
    if !best.0.has_suffixes() && possible.contains(&PathReuse::Both) && replays > MANY_REPLAYS {
        let both = trial(PathReuse::Both)?;
        if gain(&bright, &both) > LEAST_GAIN * (both.rays / bright.rays).max(1.0) {
            return Ok(PathReuse::Both);
        }
    }
    Ok(with_bright)
}

/// The factor by which the squared error falls, relative to the means of both trials.
fn gain(before: &ReuseTrial, after: &ReuseTrial) -> f64 {
    let scale = ErrorScale::of(&[before, after]);
    let error = |trial| scale.errors(trial).sum::<f64>();
    error(before) / error(after)
}

/// The part of the error that is in channels of pixels that differ by more than the radiance around them: an outlier makes the mean of
/// [`SPP`] differ by twice as much.
fn part_of_outliers(trial: &ReuseTrial) -> f64 {
    const LARGE: f64 = 1.0;
    let scale = ErrorScale::of(&[trial]);
    let [all, large] =
        scale.errors(trial).fold([0.0; 2], |[all, large], error| [all + error, large + if error > LARGE { error } else { 0.0 }]);
    if all > 0.0 { large / all } else { 0.0 }
}

/// Radiance that errors are relative to.
struct ErrorScale {
    rows: Vec<[f64; 3]>,
    floor: f64,
}

impl ErrorScale {
    /// The means of trials.
    fn of(trials: &[&ReuseTrial]) -> ErrorScale {
        let images = trials.iter().flat_map(|trial| &trial.images).map(Vec::as_slice).collect::<Vec<_>>();
        let pixels = images[0].len();
        let squares = images.iter().copied().flatten().flatten().map(|x| x * x);
        let floor = Floor::DEFAULT.of(squares.sum::<f64>() / (3 * images.len() * pixels.max(1)) as f64);
        ErrorScale { rows: (0..pixels).step_by(ROW).map(|start| mean_of_row(&images, start)).collect(), floor }
    }

    /// Relative squared differences of the images of a trial, by pixel and channel.
    fn errors<'a>(&'a self, ReuseTrial { images: [a, b], .. }: &'a ReuseTrial) -> impl Iterator<Item = f64> + 'a {
        let of =
            move |pixel: usize, c: usize| relative((a[pixel][c] - b[pixel][c]).powi(2), self.rows[pixel / ROW][c], self.floor);
        (0..a.len()).flat_map(move |pixel| (0..3).map(move |c| of(pixel, c)))
    }
}

/// The mean over all images of the pixels from one on.
fn mean_of_row(images: &[&[[f64; 3]]], start: usize) -> [f64; 3] {
    let pixels = || images.iter().flat_map(|image| image.iter().skip(start).take(ROW));
    [0, 1, 2].map(|channel| pixels().map(|pixel| pixel[channel]).sum::<f64>() / pixels().count() as f64)
}

/// A few samples of parts of some tiles, with two seeds: the difference of the images shows the error that Sobol points leave.
fn trial(
    scene: &Scene,
    rays: &CameraRays,
    settings: &RenderSettings,
    batches: &PerThread<Batch>,
    interrupted: &(dyn Fn() -> bool + Sync),
) -> Result<ReuseTrial, Interrupted> {
    let resolution = scene.camera.resolution;
    let tile = |(seed, place): (u32, [f64; 2])| {
        let origin = [0, 1].map(|i| (f64::from(resolution[i]) * place[i]) as u32 / SIZE[i] * SIZE[i]);
        let size = [0, 1].map(|i| SIZE[i].min(resolution[i] - origin[i]));
        let settings = RenderSettings { seed, ..*settings };
        let job = PassJob { scene, rays, settings: &settings };
        sampled(&mut batches.get(), job, Tile::new(origin, size), interrupted)
    };
    let places: Vec<_> = SEEDS.into_iter().flat_map(|seed| PLACES.map(|place| (seed, place))).collect();
    let tiles = places.into_par_iter().with_max_len(1).map(tile).collect::<Result<Vec<_>, Interrupted>>()?;
    let image = |tiles: &[(Vec<[f64; 3]>, u64)]| tiles.iter().flat_map(|(means, _)| means.iter().copied()).collect();
    let (first, second) = tiles.split_at(PLACES.len());
    Ok(ReuseTrial { images: [image(first), image(second)], rays: tiles.iter().map(|(_, rays)| *rays as f64).sum() })
}

/// The means of the pixels of a tile after a few samples, and the number of rays.
fn sampled(
    batch: &mut Batch,
    PassJob { scene, rays, settings }: PassJob,
    mut tile: Tile,
    interrupted: &dyn Fn() -> bool,
) -> Result<(Vec<[f64; 3]>, u64), Interrupted> {
    let level = SimdLevel::best();
    let first = Work::tile(scene, rays, settings, tile.origin, tile.size, 0);
    let thresholds = thresholds(level, &first, batch, interrupted)?;
    batch.rays = 0;
    for sample in 0..SPP {
        trace(level, &Work { sample, thresholds: thresholds.as_ref(), ..first }, batch, interrupted)?;
        tile.add(batch.radiance());
    }
    let means = (0..tile.size[1] as usize).flat_map(|row| tile.estimates(row)).map(|of| of.mean).collect();
    Ok((means, batch.rays))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two rows, the second of which is ten times as bright and as noisy. The floor is a hundredth of the mean square.
    #[test]
    fn a_gain_is_that_of_the_errors_relative_to_rows() {
        let trial = |noise: f64| {
            let image = |sign: f64| {
                (0..2 * ROW).map(|i| if i < ROW { [1.0 + sign * noise; 3] } else { [10.0 + sign * 10.0 * noise; 3] }).collect()
            };
            ReuseTrial { images: [image(1.0), image(-1.0)], rays: 1.0 }
        };
        assert!(part_of_outliers(&trial(0.02)) == 0.0 && part_of_outliers(&trial(0.9)) > 0.9);
        assert!((gain(&trial(0.02), &trial(0.01)) - 4.0).abs() < 1e-9);
        assert!((gain(&trial(0.01), &trial(0.02)) - 0.25).abs() < 1e-9);
    }

    #[test]
    fn a_trial_that_is_interrupted_decides_nothing() {
        let scene = noisefall_scene::scene::built_in();
        let rays = scene.rays(&scene.camera);
        let settings = RenderSettings { reuse: Reuse::Auto, ..scene.settings };
        assert!(resolved_unless(&scene, &rays, &settings, &|| true).is_err());
        let fresh = noisefall_scene::scene::built_in();
        assert_eq!(resolved(&scene, &rays, &settings), resolved(&fresh, &fresh.rays(&fresh.camera), &settings));
    }
}
