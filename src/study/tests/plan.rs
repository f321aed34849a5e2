//! What is measured, and for how long.
use std::time::Duration;

use crate::{
    math::SimdLevel,
    measure::Floor,
    render::pass::Threads,
    sampling::{Directions, Sampler},
    scene::{Estimator, RenderSettings, Roulette},
    study::{
        Lists, Plan, StudyError, Subject, checkpoints,
        measure::{Bench, measure},
        plan::study_size,
        trial::group,
    },
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
    let lists = Lists {
        estimators: vec![Estimator::Mis, Estimator::Path, Estimator::Mis],
        directions: vec![Directions::Bsdf],
        samplers: vec![Sampler::Sobol, Sampler::Independent],
        roulettes: vec![Roulette::Off, Roulette::Fixed(0.8), Roulette::Fixed(0.8)],
        caps: vec![None],
    };
    let all = lists.combinations(RenderSettings { seed: 3, ..RenderSettings::default() });
    assert_eq!(all.len(), 2 * 2 * 2);
    assert!(all.iter().all(|settings| settings.seed == 3));
    // Equal pictures are one group, of which what the scene opens with is measured.
    let groups = group(&["a", "b", "a", "b", "c", "c", "c", "c"], &all, &all[2]);
    assert_eq!(groups.iter().map(|group| group.twins.len()).collect::<Vec<_>>(), [1, 1, 3]);
    assert_eq!(groups[0].settings, all[2]);
}

#[test]
fn a_run_stops_before_a_doubling_that_takes_too_long() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, include_str!("../../../scenes/furnace.toml")).expect("it can be written");
    let subject = Subject::load(&path, Some([8, 8]), None).expect("a scene");
    let threads = Threads::new(1, SimdLevel::best()).expect("threads");
    let bench = Bench { scene: &subject.scene, camera: &subject.camera, threads: &threads, stop: &|| false };
    let lists = Lists { estimators: vec![], directions: vec![], samplers: vec![], roulettes: vec![], caps: vec![] };
    let plan = |time| Plan { lists: lists.clone(), spp: 16, time, repeats: 1, floor: Floor::DEFAULT };
    let reference = [[2.0; 3]; 64];
    let run = |time| measure(bench, &subject.scene.settings, &plan(time), &reference).expect("a run");
    assert_eq!(run(Duration::from_secs(1000)).checkpoints.len(), 5);
    assert_eq!(run(Duration::ZERO).checkpoints.len(), 1);
    let stopped = Bench { stop: &|| true, ..bench };
    let ended = measure(stopped, &subject.scene.settings, &plan(Duration::MAX), &reference);
    assert!(matches!(ended, Err(StudyError::Interrupted)));
}
