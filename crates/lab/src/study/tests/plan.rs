//! Plans, and the duration of runs.
use std::time::Duration;

use crate::study::{
    Lists, Plan, StudyError, StudyScene, checkpoints,
    measure::{Bench, NoiseOfMean, follow, measure},
    plan::study_size,
    trial::{group, groups},
};
use noisefall_base::math::SimdLevel;
use noisefall_kernel::measure::{Comparison, Floor};
use noisefall_render::render::threads::Threads;
use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::{Estimator, RenderSettings, Reuse, Roulette},
};

#[test]
fn checkpoints_are_powers_of_two_and_the_last() {
    assert_eq!(checkpoints(1), [1]);
    assert_eq!(checkpoints(8), [1, 2, 4, 8]);
    assert_eq!(checkpoints(11), [1, 2, 4, 8, 11]);
    assert_eq!(checkpoints(u32::MAX).len(), 33);
}

#[test]
fn large_pictures_are_made_smaller_in_shape() {
    assert_eq!(study_size([640, 640]), [256, 256]);
    assert_eq!(study_size([720, 400]), [256, 142]);
    assert_eq!(study_size([40, 30]), [40, 30]);
    assert_eq!(study_size([100_000, 10]), [256, 1]);
}

#[test]
fn lists_are_combined_each_value_once() {
    let any = RenderSettings::default();
    let lists = Lists::default()
        .with(
            RenderSettings::ESTIMATOR,
            [Estimator::Mis, Estimator::Path, Estimator::Mis].map(|estimator| RenderSettings { estimator, ..any }),
        )
        .with(RenderSettings::DIRECTIONS, [RenderSettings { directions: Directions::Bsdf, ..any }])
        .with(RenderSettings::SAMPLER, [Sampler::Sobol, Sampler::Independent].map(|sampler| RenderSettings { sampler, ..any }))
        .with(
            RenderSettings::ROULETTE,
            [Roulette::Off, Roulette::fixed(0.8), Roulette::fixed(0.8)].map(|roulette| RenderSettings { roulette, ..any }),
        )
        .with(RenderSettings::MAX_BOUNCES, [any])
        .with(RenderSettings::REUSE, [Reuse::Suffixes, Reuse::Off].map(|reuse| RenderSettings { reuse, ..any }));
    let all = lists.combinations(RenderSettings { seed: 3, ..any });
    assert_eq!(all.len(), 2 * 2 * 2 * 2);
    assert!(all.iter().all(|settings| settings.seed == 3 && !settings.adaptive));
    let adaptive = [false, true].map(|adaptive| RenderSettings { adaptive, ..any });
    assert_eq!(Lists::default().with(RenderSettings::ADAPTIVE, adaptive).combinations(all[0]).len(), 2);
    assert_eq!(lists.clone().replaced_by(Lists::default().with(RenderSettings::ESTIMATOR, [any])).combinations(any).len(), 8);
    assert_eq!(Lists::default().combinations(all[5]), [all[5]]);
    let all: Vec<RenderSettings> = all.into_iter().filter(|settings| settings.reuse == Reuse::Suffixes).collect();
    // Combinations with equal images are one group, which measures the settings of the scene.
    let groups = group(&["a", "b", "a", "b", "c", "c", "c", "c"], &all, &all[2]);
    assert_eq!(groups.iter().map(|group| group.twins.len()).collect::<Vec<_>>(), [1, 1, 3]);
    assert_eq!(groups[0].settings, all[2]);
}

#[test]
fn a_run_stops_before_a_doubling_that_takes_too_long() {
    with_furnace(|bench, settings| {
        let lists = Lists::default();
        let plan = |time| Plan { lists: lists.clone(), spp: 16, time, repeats: 1, floor: Floor::DEFAULT };
        let reference = [[2.0; 3]; 64];
        let run = |time| measure(bench, settings, &plan(time), &reference).expect("a run");
        assert_eq!(run(Duration::from_secs(1000)).checkpoints.len(), 5);
        assert_eq!(run(Duration::ZERO).checkpoints.len(), 1);
        let stopped = Bench { stop: &|| true, ..bench };
        let ended = measure(stopped, settings, &plan(Duration::MAX), &reference);
        assert!(matches!(ended, Err(StudyError::Interrupted)));
    });
}

/// Passes take 1, 2, 4, … seconds. The time of a checkpoint is the sum over all passes up to it.
#[test]
fn the_time_of_a_checkpoint_is_that_of_all_rendering_so_far() {
    let lists = Lists::default();
    let run = |time| {
        let plan = Plan { lists: lists.clone(), spp: 12, time: Duration::from_secs(time), repeats: 1, floor: Floor::DEFAULT };
        follow(&plan, |spp| {
            let error = f64::from(spp);
            let comparison = Comparison { rmse: error, rel_mse: 2.0 * error, bias: -error };
            let noise = NoiseOfMean { standard_error: 3.0 * error, effective_samples: 5.0 * error };
            Ok((Duration::from_secs(u64::from(spp)), u64::from(spp) * 10, comparison, Some(noise)))
        })
        .expect("nothing fails")
    };
    let (all, cut) = run(1000);
    let seconds: Vec<(u32, f64)> = all.checkpoints.iter().map(|point| (point.spp, point.seconds)).collect();
    assert_eq!(seconds, [(1, 1.0), (2, 3.0), (4, 7.0), (8, 15.0), (12, 27.0)]);
    assert_eq!(cut, 270);
    let last = all.checkpoints[4];
    assert_eq!(last.effective_samples, Some(60.0));
    assert_eq!((last.rmse, last.rel_mse, last.bias, last.bias_standard_error), (12.0, 24.0, -12.0, Some(36.0)));
    // After 7 s and 4 samples, 8 samples would take 14 s.
    assert_eq!([14, 13].map(|time| run(time).0.checkpoints.len()), [4, 3]);
}

fn with_furnace<T>(use_it: impl FnOnce(Bench, &RenderSettings) -> T) -> T {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, include_str!("../../../../../scenes/furnace.toml")).expect("it can be written");
    let scene = noisefall_scene::scene::load(&path).expect("a scene");
    let study_scene = StudyScene::new(&path, scene, Some([8, 8]), None).expect("a scene");
    let threads = Threads::new(1, SimdLevel::best()).expect("threads");
    let bench = Bench { scene: &study_scene.scene, camera: &study_scene.camera, threads: &threads, stop: &|| false };
    use_it(bench, &study_scene.scene.settings)
}

#[test]
fn a_run_has_the_errors_of_its_picture_and_says_why_it_is_biased() {
    with_furnace(|bench, settings| {
        let lists = Lists::default();
        let plan = |floor| Plan { lists: lists.clone(), spp: 2, time: Duration::MAX, repeats: 1, floor };
        // Every sample is the partial sum, 1.5.
        let capped =
            RenderSettings { max_bounces: Some(1), directions: Directions::Cosine, estimator: Estimator::Path, ..*settings };
        for (floor, rel_mse) in [(Floor::DEFAULT, 0.25 / 4.04), (Floor::Absolute(1.0), 0.25 / 5.0)] {
            let run = measure(bench, &capped, &plan(floor), &[[2.0; 3]; 64]).expect("a run");
            assert_eq!((run.bias.as_str(), run.checkpoints.len()), ("cap at 1", 2));
            for point in run.checkpoints {
                assert!(
                    (point.rel_mse - rel_mse).abs() < 1e-6 && (point.rmse - 0.5).abs() < 1e-6 && (point.bias + 0.5).abs() < 1e-6
                );
            }
        }
        assert_eq!(measure(bench, settings, &plan(Floor::DEFAULT), &[[2.0; 3]; 64]).expect("a run").bias, "");
        // With uniform directions a sample is 1 + cos θ, with variance 1/12. The relative standard error of the variance of 64
        // pairs is 0.15, so its root is within these bounds at 4σ.
        let (directions, sampler, reuse) = (Directions::Uniform, Sampler::Independent, Reuse::Off);
        let noisy = RenderSettings { directions, sampler, reuse, ..capped };
        let errors = measure(bench, &noisy, &plan(Floor::DEFAULT), &[[2.0; 3]; 64]).expect("a run").checkpoints;
        let ratio = errors[1].bias_standard_error.map_or(f64::NAN, |error| error / (1.0 / 12.0 / 128.0f64).sqrt());
        assert!(errors[0].bias_standard_error.is_none() && (0.63..1.27).contains(&ratio), "{ratio}");
    });
}

#[test]
fn pictures_that_are_the_same_are_measured_once_but_never_with_different_caps() {
    with_furnace(|bench, settings| {
        // At a diffuse surface `bsdf` equals `cosine`. Eight reflections cannot distinguish larger caps.
        let [cosine, bsdf, uniform] = [Directions::Cosine, Directions::Bsdf, Directions::Uniform]
            .map(|directions| RenderSettings { directions, ..*settings });
        let capped = RenderSettings { max_bounces: Some(100), ..cosine };
        let found = groups(bench, &[cosine, uniform, bsdf, capped]).expect("groups");
        let groups: Vec<(RenderSettings, usize)> = found.iter().map(|group| (group.settings, group.twins.len())).collect();
        assert_eq!(groups, [(cosine, 1), (uniform, 0), (capped, 0)]);
    });
}
