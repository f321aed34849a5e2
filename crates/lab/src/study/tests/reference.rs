//! References and their own errors.
use std::sync::Arc;

use crate::study::{
    StudyScene,
    measure::Bench,
    reference::{Converged, identity, known, settings},
};
use noisefall_base::math::SimdLevel;
use noisefall_kernel::measure::{Floor, SampleNoise, compare};
use noisefall_render::render::{
    image_file::{Picture, Provenance},
    reference::Reference as KnownReference,
    threads::Threads,
};
use noisefall_scene::scene::parse;

const SIZE: [u32; 2] = [32, 8];

fn study_scene(known: Option<KnownReference>, is_declared: bool) -> StudyScene {
    let scene = parse("scene.toml", include_str!("../../../../../scenes/furnace.toml").to_owned()).expect("a scene");
    let camera = noisefall_scene::scene::Camera { resolution: SIZE, ..scene.camera };
    StudyScene { path: "scene.toml".into(), scene, camera, known: known.map(|known| (known, "an image".to_owned())), is_declared }
}

/// An image of radiance 2 with this variance and this estimate of relMSE.
fn rendered(variance: Option<f32>, rel_mse_estimate: Option<f64>) -> KnownReference {
    let picture = Picture { width: 16, height: 16, radiance: vec![[2.0; 3]; 256] };
    let noise = variance.map(|v| SampleNoise {
        width: 16,
        variance: vec![[v; 3]; 256],
        blocks: vec![f64::from(v)],
        block_degrees: 7.0,
        effective_samples: 1e4,
    });
    KnownReference::Picture(Arc::new(picture), Arc::new(Provenance { noise, rel_mse_estimate, ..Provenance::default() }))
}

#[test]
fn the_own_error_of_a_reference_comes_from_its_file() {
    let own = |reference, is_declared, floor| {
        let found = known(&study_scene(Some(reference), is_declared), floor).expect("it is lit").expect("it is known");
        (found.rel_mse, found.is_taken_for_exact, found.variance_of_mean)
    };
    let near = |(found, taken, variance): (f64, bool, f64), exact: f64| {
        assert!((found - exact).abs() < 1e-7 && !taken, "{found} {exact} {taken}");
        assert!((variance - 0.0404).abs() < 1e-8, "that of its only block, whatever the floor: {variance}");
    };
    near(own(rendered(Some(0.0404), None), false, Floor::DEFAULT), 0.01);
    near(own(rendered(Some(0.0404), None), false, Floor::Absolute(0.04)), 0.01);
    near(own(rendered(Some(0.0404), None), false, Floor::Absolute(4.08)), 0.005);
    // Its samples were five times as good as independent ones. They cannot be worse than independent ones.
    near(own(rendered(Some(0.0404), Some(0.002)), false, Floor::DEFAULT), 0.002);
    near(own(rendered(Some(0.0404), Some(0.5)), false, Floor::DEFAULT), 0.01);
    assert_eq!(own(rendered(None, None), false, Floor::DEFAULT), (0.0, true, 0.0));
    // The reference of a scene is exact.
    assert_eq!(own(rendered(None, None), true, Floor::DEFAULT), (0.0, false, 0.0));
    assert_eq!(own(KnownReference::Constant([2.0; 3]), true, Floor::DEFAULT), (0.0, false, 0.0));
}

#[test]
fn a_black_reference_is_refused_and_others_have_an_identity() {
    let black = KnownReference::Constant([0.0; 3]);
    assert!(
        known(&study_scene(Some(black), true), Floor::DEFAULT).is_err_and(|error| error.to_string().contains("entirely black"))
    );
    let of = |known, spp| identity(&study_scene(known, true), spp);
    let constant = |x| Some(KnownReference::Constant([x; 3]));
    assert_ne!(of(constant(1.0), 4), of(constant(2.0), 4));
    assert_eq!(of(constant(1.0), 4), of(constant(1.0), 8));
    assert_ne!(of(None, 4), of(None, 8));
    let found = known(&study_scene(constant(2.0), true), Floor::Absolute(4.0)).expect("it is lit").expect("it is known");
    assert!((found.rel_mse_of_black() - 0.5).abs() < 1e-12 && found.radiance.len() == 256);
}

/// Independent halves: the error of their mean has the variance of half their difference, which is known for independent samples.
#[test]
fn a_converged_render_knows_its_own_error_and_is_kept() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut study_scene = study_scene(None, false);
    study_scene.scene.settings.reuse = noisefall_scene::scene::Reuse::Off;
    let threads = Threads::new(1, SimdLevel::best()).expect("threads");
    let bench = Bench { scene: &study_scene.scene, camera: &study_scene.camera, threads: &threads, stop: &|| false };
    let reference = |spp| {
        let converged =
            Converged { study_scene: &study_scene, bench, folder: folder.path(), fingerprint: 7, spp, floor: Floor::DEFAULT };
        let mut shares = Vec::new();
        let found = converged.reference(&mut |share| shares.push(share)).expect("a render");
        (found, shares)
    };
    let (found, shares) = reference(4);
    assert_eq!(found.name, "a converged render (mis, Sobol, 64 samples per pixel)");
    assert!(shares.windows(2).all(|pair| pair[0] < pair[1]) && shares.last() == Some(&1.0) && shares.len() == 64, "{shares:?}");
    let files: Vec<_> = std::fs::read_dir(folder.path()).expect("a folder").map(|entry| entry.expect("a file").path()).collect();
    assert_eq!(files.len(), 2);
    let halves: Vec<Vec<[f32; 3]>> =
        files.iter().map(|file| noisefall_render::render::image_file::read(file).expect("an image").radiance).collect();
    for (i, radiance) in found.radiance.iter().enumerate() {
        assert!((0..3).all(|c| (radiance[c] - 0.5 * (halves[0][i][c] + halves[1][i][c])).abs() < 1e-6));
    }
    // A quarter of the mean square of the difference.
    let quarter = compare(&halves[0], &found.radiance, Floor::DEFAULT).rel_mse;
    assert!((found.rel_mse / quarter - 1.0).abs() < 1e-6 && found.rel_mse > 0.0 && !found.is_taken_for_exact);
    let noises = files.iter().map(|file| noisefall_render::render::image_file::provenance(file).noise.expect("variances"));
    let of_mean = noises.map(|noise| noise.variance_of_mean()).sum::<f64>() / 4.0;
    let is_known = |variance: f64| (variance / of_mean - 1.0).abs() < 1e-6;
    assert!(is_known(found.variance_of_mean), "{} {of_mean}", found.variance_of_mean);
    // It is also about the error, over 256 pixels of noise.
    let truth = compare(&found.radiance, &[[2.0; 3]; 256], Floor::DEFAULT).rel_mse;
    assert!((0.6..1.6).contains(&(found.rel_mse / truth)), "{} {truth}", found.rel_mse);
    assert_ne!(settings(&study_scene).seed, study_scene.scene.settings.seed);
    // An existing reference is not rendered again, unless it is too short for longer renders.
    let (again, shares) = reference(4);
    assert!(shares.is_empty() && again.radiance == found.radiance && is_known(again.variance_of_mean));
    assert!(!reference(8).1.is_empty());
}

#[test]
fn a_converged_render_keeps_its_channels_apart() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut study_scene = study_scene(None, false);
    let sky = "format = 1\ncamera = { eye = [0, 0, 0], look_at = [0, 0, 1], fov = 60, resolution = [8, 8] }\n\
               environment.radiance = [0.25, 0.5, 1.0]\n";
    study_scene.scene = parse("sky.toml", sky.to_owned()).expect("a scene");
    study_scene.camera = study_scene.scene.camera;
    let threads = Threads::new(1, SimdLevel::best()).expect("threads");
    let bench = Bench { scene: &study_scene.scene, camera: &study_scene.camera, threads: &threads, stop: &|| false };
    let (fingerprint, spp, floor) = (7, 4, Floor::DEFAULT);
    let converged = Converged { study_scene: &study_scene, bench, folder: folder.path(), fingerprint, spp, floor };
    let found = converged.reference(&mut |_| {}).expect("a render");
    assert_eq!(found.radiance, [[0.25, 0.5, 1.0]; 64]);
}
