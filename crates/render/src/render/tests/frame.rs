//! Pixels of frames.
use super::*;
use crate::render::{film::Film, frame::Frame};
use noisefall_scene::scene::PathReuse;

/// Standard errors add up by the weights of luminance: ITU-R BT.709-6.
#[test]
fn the_standard_error_of_a_colour_is_that_of_its_luminance() {
    let mut film = Film::new([3, 2]);
    // The last pixel has samples 1 ± 1, 2 ± 3 and 4 ± 0.5: the variance of the mean of two is the square of that.
    for sign in [1.0, -1.0] {
        let mut radiance = vec![[1.0, 2.0, 4.0, 0.0]; (TILE * TILE) as usize];
        radiance[(TILE + 2) as usize] = [1.0 + sign, 3.0 + 3.0 * sign, 4.0 + 0.5 * sign, 0.0];
        film.tiles[0].add(&radiance);
    }
    let frame = Frame::of_film(&film, 0, [3, 2], [3, 2]);
    let exact = 0.2126 * 1.0 + 0.7152 * 3.0 + 0.0722 * 0.5;
    assert!((frame.standard_error[5] - exact as f32).abs() < 1e-5, "{} {exact}", frame.standard_error[5]);
    assert!(frame.standard_error[..5].iter().all(|error| *error == 0.0));
    assert_eq!(frame.noise.expect("two samples").variance[5], [1.0, 9.0, 0.25]);
}

#[test]
fn before_the_second_sample_there_is_no_standard_error() {
    let mut film = Film::new([33, 2]);
    film.tiles.iter_mut().for_each(|tile| add(tile, 0..1));
    let frame = Frame::of_film(&film, 0, [33, 2], [33, 2]);
    assert!(frame.standard_error.iter().all(|error| error.is_nan()));
    assert!(frame.noise.is_none() && frame.rel_mse_estimate.is_none());
    // Nor as long as a single tile has but one.
    add(&mut film.tiles[0], 1..2);
    let frame = Frame::of_film(&film, 0, [33, 2], [33, 2]);
    assert!(frame.noise.is_none() && frame.rel_mse_estimate.is_none());
    assert!(frame.standard_error[31].is_finite() && frame.standard_error[32].is_nan());
}

/// By the scatter of whole samples: with one degree of freedom fewer than the tile has that has the fewest.
#[test]
fn blocks_that_share_paths_are_known_by_the_fewest_samples() {
    let mut film = Film::new([33, 2]);
    film.tiles.iter_mut().zip([3, 5]).for_each(|(tile, spp)| add(tile, 0..spp));
    let mut degrees = |path_reuse| {
        film.path_reuse = path_reuse;
        Frame::of_film(&film, 0, [33, 2], [33, 2]).noise.expect("three samples").block_degrees
    };
    assert_eq!([PathReuse::Off, PathReuse::Suffixes].map(&mut degrees), [f64::INFINITY, 2.0]);
}

#[test]
fn a_pixel_of_the_picture_is_found_in_a_coarse_frame() {
    let frame = Frame { width: 5, height: 3, full_resolution: [10, 9], ..Frame::default() };
    assert_eq!([[0, 0], [9, 8], [3, 5], [2, 3]].map(|pixel| frame.index_at(pixel)), [Some(0), Some(14), Some(6), Some(6)]);
    assert_eq!([[10, 0], [0, 9]].map(|pixel| frame.index_at(pixel)), [None, None]);
}

#[test]
fn one_lit_channel_of_one_pixel_is_not_black() {
    let mut frame = Frame { width: 2, height: 1, radiance: vec![[0.0; 3]; 2], ..Frame::default() };
    assert!(frame.is_black());
    frame.radiance[1][2] = f32::MIN_POSITIVE;
    assert!(!frame.is_black());
}
