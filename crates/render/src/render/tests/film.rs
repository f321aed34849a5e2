//! Films of tiles.
use super::*;
use crate::render::{film::Film, frame::Frame, region::Region};

const RESOLUTION: [u32; 2] = [75, 40];

fn film(samples: u32) -> Film {
    let mut film = Film::new(RESOLUTION);
    film.tiles.iter_mut().for_each(|tile| add(tile, 0..samples));
    film
}

#[test]
fn tiles_cover_every_pixel_once() {
    let film = film(3);
    let frame = Frame::of_film(&film, 7, RESOLUTION, [150, 80]);
    assert_eq!((film.spp(), film.samples(), film.invalid_samples()), (3, 3 * 75 * 40, 0));
    assert_eq!((frame.generation, frame.spp, frame.width, frame.height, frame.full_resolution), (7, 3, 75, 40, [150, 80]));
    assert!(frame.is_coarse() && !frame.is_black() && frame.counts.is_empty() && frame.spp_at(12) == 3);
    for (i, radiance) in (0..).zip(&frame.radiance) {
        let [mean, variance] = exact(i % 75, i / 75, 3);
        assert!(
            radiance.iter().zip([1.0, 2.0, 4.0]).all(|(c, factor)| is_about(f64::from(*c), f64::from((factor * mean) as f32)))
        );
        let noise = &frame.noise.as_ref().expect("three samples").variance[i as usize];
        assert!(noise.iter().zip([1.0, 4.0, 16.0]).all(|(v, factor)| (f64::from(*v) / (factor * variance) - 1.0).abs() < 1e-3));
    }
    assert_eq!(film.tile_rows().map(<[Tile]>::len).collect::<Vec<_>>(), [3, 3]);
}

#[test]
fn the_least_number_of_samples_is_that_of_the_film() {
    let mut film = film(2);
    add(&mut film.tiles[4], 2..5);
    assert_eq!((film.spp(), film.samples()), (2, 2 * 75 * 40 + 3 * 32 * 8));
    let right = Region { from: [64, 0], to: [75, 40] };
    assert_eq!((film.spp_in(&right), film.spp_in(&Region { from: [32, 32], to: [64, 40] })), (Some(2), Some(5)));
    assert_eq!(film.spp_in(&Region { from: [75, 0], to: [80, 40] }), None);
    let frame = Frame::of_film(&film, 0, RESOLUTION, RESOLUTION);
    let more = |i: u32| (32..64).contains(&(i % 75)) && i / 75 >= 32;
    assert!((0..75 * 40).all(|i| frame.spp_at(i as usize) == if more(i) { 5 } else { 2 }), "counts are by pixel");
    film.focus = Some(right);
    assert_eq!(film.tiles_in_focus().map(|tile| tile.origin).collect::<Vec<_>>(), [[64, 0], [64, 32]]);
}

#[test]
fn a_recycled_film_is_empty() {
    let mut used = film(4);
    (used.focus, used.is_piloted) = (Some(Region { from: [0, 0], to: [1, 1] }), true);
    used.tiles[0].blocks[0].rate = 2;
    used.keep_series();
    let again = used.recycled(RESOLUTION);
    assert_eq!((again.spp(), again.samples(), again.is_adaptive(), again.has_series()), (0, 0, false, false));
    assert!(again.focus.is_none() && !again.is_piloted);
    let larger = again.recycled([80, 40]);
    assert_eq!((larger.resolution, larger.tiles.len()), ([80, 40], 6));
}
