//! Frames against their references.
use std::sync::Arc;

use crate::render::{
    frame::Frame,
    image_file::{Picture, Provenance},
    reference::{Reference, contradiction},
    threads::Threads,
};
use noisefall_base::math::SimdLevel;
use noisefall_kernel::measure::SampleNoise;
use noisefall_scene::scene::parse;

/// 64 × 32 pixels of radiance 1.5, whose two blocks have these variances.
fn frame(blocks: [f64; 2]) -> Frame {
    let noise = SampleNoise {
        width: 64,
        variance: vec![[0.0; 3]; 64 * 32],
        blocks: blocks.to_vec(),
        block_degrees: f64::INFINITY,
        effective_samples: 1e6,
    };
    Frame {
        width: 64,
        height: 32,
        full_resolution: [64, 32],
        radiance: vec![[1.5; 3]; 64 * 32],
        noise: Some(noise),
        ..Frame::default()
    }
}

fn picture(radiance: f32, noise: Option<SampleNoise>) -> Reference {
    let picture = Picture { width: 64, height: 32, radiance: vec![[radiance; 3]; 64 * 32] };
    Reference::Picture(Arc::new(picture), Arc::new(Provenance { noise, ..Provenance::default() }))
}

#[test]
fn a_frame_is_held_against_a_radiance_or_a_picture_of_its_size() {
    let frame = frame([0.01, 0.03]);
    for reference in [Reference::Constant([1.0; 3]), picture(1.0, None)] {
        let found = reference.compare(&frame).expect("the same size");
        assert!((found.rel_mse - 0.25 / 1.01).abs() < 1e-9 && found.bias == 0.5, "{found:?}");
        assert_eq!(reference.mismatch([64, 32]), None);
        // The variance of the mean of two equal blocks is a quarter of the sum of theirs.
        assert!(reference.bias(&frame).and_then(|bias| bias.z).is_some_and(|z| (z - 0.5 / 0.1).abs() < 1e-6));
    }
    let other = Frame { width: 32, height: 64, ..frame };
    assert!(picture(1.0, None).compare(&other).is_none() && picture(1.0, None).bias(&other).is_none());
    assert!(picture(1.0, None).mismatch([32, 64]).is_some_and(|why| why.contains("64 × 32") && why.contains("32 × 64")));
    assert_eq!(Reference::Constant([1.0; 3]).mismatch([32, 64]), None);
    assert!(Reference::Constant([1.0; 3]).compare(&other).is_some());
}

#[test]
fn nothing_is_held_against_a_denoised_image() {
    let frame = frame([0.01, 0.03]);
    let Reference::Picture(picture, _) = picture(1.0, None) else { panic!("it is an image") };
    let reference = Reference::Picture(picture, Arc::new(Provenance { is_denoised: true, ..Provenance::default() }));
    assert!(reference.compare(&frame).is_none() && reference.bias(&frame).is_none() && reference.block_errors(&frame).is_none());
    assert_eq!(reference.contradiction(&frame), None);
    assert!(reference.mismatch([64, 32]).is_some_and(|why| why.starts_with("the reference image is denoised, and so biased")));
}

#[test]
fn the_errors_without_a_block_are_those_of_the_others() {
    let mut frame = frame([0.01, 0.01]);
    // The right one of two blocks is exact.
    frame.radiance = (0..64 * 32).map(|pixel| [if pixel % 64 < 32 { 1.5 } else { 1.0 }; 3]).collect();
    for reference in [Reference::Constant([1.0; 3]), picture(1.0, None)] {
        let errors = reference.block_errors(&frame).expect("the same size");
        assert!(errors.without[0].abs() < 1e-9 && (errors.without[1] / errors.whole - 2.0).abs() < 1e-9, "{errors:?}");
    }
}

#[test]
fn the_noise_of_the_reference_counts_and_unknown_scores_are_not_claimed() {
    let noisy = frame([0.01, 0.03]);
    let reference = picture(1.0, frame([0.05, 0.07]).noise);
    assert!(reference.bias(&noisy).and_then(|bias| bias.z).is_some_and(|z| (z - 0.5 / 0.2).abs() < 1e-6));
    let unknown = reference.bias(&Frame { noise: None, ..noisy }).expect("the same size");
    assert_eq!((unknown.mean, unknown.standard_error, unknown.z), (0.5, None, None));
    // Without noise a difference is no number of standard errors.
    assert_eq!(Reference::Constant([1.0; 3]).bias(&frame([0.0; 2])).and_then(|bias| bias.z), None);
}

#[test]
fn a_frame_contradicts_the_truth_where_noise_cannot_explain_the_difference() {
    let said = |reference: f32, frame: &Frame| Reference::Constant([reference; 3]).contradiction(frame).unwrap_or_default();
    assert!(
        said(1.0, &frame([0.01; 2])).ends_with("5.000e-1 more radiance on average than [reference] says, by 7.1 standard errors")
    );
    let exact = frame([0.0; 2]);
    assert!(
        said(2.0, &exact)
            .ends_with("5.000e-1 less radiance on average than [reference] says, although its samples have no noise")
    );
    let mut heavy = frame([0.01; 2]);
    heavy.noise.as_mut().expect("it has noise").effective_samples = 20.0;
    let black = Frame { radiance: vec![[0.0; 3]; 64 * 32], ..frame([0.01; 2]) };
    for (reference, frame) in [(1.5, exact), (1.0, frame([0.1; 2])), (1.0, heavy), (1.0, black)] {
        assert_eq!(said(reference, &frame), "");
    }
}

#[test]
fn a_mirrored_truth_is_contradicted_by_its_blocks() {
    let halves = |left: f32, right: f32| (0..64 * 32).map(|i| [if i % 64 < 32 { left } else { right }; 3]).collect::<Vec<_>>();
    let said = |variance: f64, radiance: Vec<[f32; 3]>| {
        let truth = Picture { width: 64, height: 32, radiance: halves(1.0, 2.0) };
        let reference = Reference::Picture(Arc::new(truth), Arc::new(Provenance::default()));
        reference.contradiction(&Frame { radiance, ..frame([variance; 2]) }).unwrap_or_default()
    };
    assert!(
        said(0.0025, halves(2.0, 1.0)).contains("block of 32 × 32 pixels from 32,0 on has less radiance"),
        "{}",
        said(0.0025, halves(2.0, 1.0))
    );
    let none = String::new;
    assert_eq!((said(0.0025, halves(1.0, 2.0)), said(0.02, halves(2.0, 1.0))), (none(), none()));
    // Less than a tenth of the mean may be light that has not been found yet, however sure it seems.
    assert_eq!(said(1e-6, halves(1.14, 1.86)), none());
    assert!(said(1e-6, halves(1.16, 1.84)).contains("though the mean of the image agrees"));
}

/// The truth is that of the equation, whatever the scene's own cap leaves out.
#[test]
fn a_scene_is_held_against_its_truth_without_its_cap() {
    let mut scene = parse("furnace.toml", include_str!("../../../../../scenes/furnace.toml").to_owned()).expect("a scene");
    (scene.camera.resolution, scene.settings.max_bounces) = ([48, 8], Some(1));
    let threads = Threads::new(1, SimdLevel::best()).expect("a thread");
    assert_eq!(contradiction(&scene, &threads), None);
}

#[test]
fn blocks_are_those_of_the_frame_that_lie_side_by_side() {
    let mut uneven = frame([0.01, 0.04]);
    (0..32).for_each(|row| uneven.radiance[row * 64 + 32..][..32].fill([2.5; 3]));
    for reference in [Reference::Constant([1.0; 3]), picture(1.0, None)] {
        let scores = reference.bias(&uneven).expect("the same size").block_z;
        assert!(scores.len() == 2 && (scores[0] - 5.0).abs() < 1e-4 && (scores[1] - 7.5).abs() < 1e-4, "{scores:?}");
    }
}
