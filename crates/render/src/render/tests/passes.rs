//! Passes, films and frames, sample by sample.
use std::sync::atomic::{AtomicU32, Ordering};

use super::super::{
    Frame, Region,
    film::Film,
    pass::{Failure, PassCount, SampleId},
    threads::{PassJob, Threads},
};
use noisefall_base::math::{SimdLevel, colour::luminance};
use noisefall_scene::scene::{Camera, Scene, built_in, parse};

fn threads(count: usize) -> Threads {
    Threads::new(count, SimdLevel::best()).expect("threads can be had")
}

/// A sphere around the camera that emits and reflects nothing: a path is one segment.
fn plain(resolution: [u32; 2]) -> Scene {
    let text = format!(
        "format = 1\n[camera]\neye = [0, 0, 0]\nlook_at = [0, 0, 1]\nfov = 60\nresolution = {resolution:?}\n\
         [[objects]]\nshape = {{ sphere = {{ center = [0, 0, 0], radius = 1 }} }}\nflip = true\nemission = {{ radiance = 0.5 }}\n"
    );
    parse("plain.toml", text).expect("it is good")
}

fn pass(scene: &Scene, film: &mut Film, spp: u32, threads: &Threads, interrupted: &(dyn Fn() -> bool + Sync)) -> PassCount {
    let camera = Camera { resolution: film.resolution, ..scene.camera };
    threads.pass(PassJob { scene, rays: &scene.rays(&camera), settings: &scene.settings }, film, spp, interrupted)
}

fn frame(film: &Film) -> Frame {
    Frame::of_film(film, 1, film.resolution, film.resolution)
}

#[test]
fn the_figures_of_an_interrupted_image_are_true_of_every_pixel() {
    const SIZE: [u32; 2] = [80, 50];
    let (scene, threads) = (built_in(), threads(1));
    let whole: Vec<Frame> = (1..=4)
        .map(|spp| {
            let mut film = Film::new(SIZE);
            pass(&scene, &mut film, spp, &threads, &|| false);
            frame(&film)
        })
        .collect();
    // Interrupted later and later, until some tiles have samples that others have not.
    let mut uneven = 0;
    for patience in (0..).step_by(37) {
        let (mut film, asked) = (Film::new(SIZE), AtomicU32::new(0));
        pass(&scene, &mut film, 1, &threads, &|| false);
        pass(&scene, &mut film, 4, &threads, &|| asked.fetch_add(1, Ordering::Relaxed) >= patience);
        let picture = frame(&film);
        let counts = picture.sample_counts();
        let mut total = 0;
        for tile in &film.tiles {
            total += u64::from(tile.spp) * u64::from(tile.size[0] * tile.size[1]);
            for (x, y) in (0..tile.size[1]).flat_map(|y| (0..tile.size[0]).map(move |x| (x, y))) {
                let i = ((tile.origin[1] + y) * SIZE[0] + tile.origin[0] + x) as usize;
                assert_eq!(picture.spp_at(i), tile.spp);
                assert_eq!(picture.radiance[i], whole[tile.spp as usize - 1].radiance[i]);
            }
        }
        let spp: Vec<u32> = film.tiles.iter().map(|tile| tile.spp).collect();
        let [least, most] = [spp.iter().min(), spp.iter().max()].map(|spp| *spp.expect("a tile"));
        assert_eq!((counts.least, counts.most, counts.total, counts.pixels), (least, most, total, 4000));
        assert_eq!((picture.spp, film.spp(), film.samples()), (least, least, total));
        uneven += usize::from(least < most);
        pass(&scene, &mut film, 4, &threads, &|| false);
        assert!(frame(&film).radiance == whole[3].radiance, "it does not go on as if nothing had happened");
        if least == 4 {
            break;
        }
    }
    assert!(uneven > 3, "{uneven} of the interruptions came within a pass");
}

#[test]
fn a_pass_counts_every_segment_and_takes_no_sample_twice() {
    let scene = plain([70, 40]);
    let mut film = Film::new([70, 40]);
    assert_eq!(pass(&scene, &mut film, 3, &threads(2), &|| false), PassCount { rays: 3 * 2800, ..PassCount::default() });
    assert_eq!(pass(&scene, &mut film, 3, &threads(2), &|| false), PassCount::default());
    assert_eq!(pass(&scene, &mut film, 5, &threads(2), &|| false).rays, 2 * 2800);
    assert_eq!((film.spp(), film.samples(), film.invalid_samples()), (5, 5 * 2800, 0));
    let done = frame(&film);
    assert!(done.radiance.iter().all(|rgb| *rgb == [0.5; 3]) && done.standard_error.iter().all(|error| *error == 0.0));
}

#[test]
fn a_pass_is_left_within_its_paths() {
    // White walls and no roulette: a path has thousands of bounces, and the pass would take minutes.
    let text = "format = 1\ncamera = { eye = [0, 0, 0], look_at = [0, 0, 1], fov = 60, resolution = [512, 512] }\n\
                materials.white.lambertian.albedo = 0.9999\n[[objects]]\nshape.sphere = { center = [0, 0, 0], radius = 1 }\n\
                material = 'white'\nflip = true\nemission.radiance = 1\n[render]\nroulette = 'off'\n";
    let scene = parse("endless.toml", text.to_owned()).expect("it is good");
    let mut film = Film::new([512, 512]);
    let asked = AtomicU32::new(0);
    let soon = || asked.fetch_add(1, Ordering::Relaxed) > 60;
    let count = pass(&scene, &mut film, 1, &threads(2), &soon);
    assert_eq!((film.samples(), count.cut_paths), (0, 0));
    // Both tiles that were begun notice, and so does each that was to come.
    assert!(asked.load(Ordering::Relaxed) < 60 + 2 * 512, "{asked:?}");
}

#[test]
fn counts_of_tiles_are_added_and_the_first_of_their_faults_is_kept() {
    let id = |x, sample| SampleId { pixel: [x, 0], sample };
    let failure = |x| Failure { at: id(x, 0), replays: true, resolution: [9, 9], message: format!("at {x}") };
    let a = PassCount { rays: 2, cut_paths: 30, invalid: Some(id(5, 1)), failure: None };
    let b = PassCount { rays: 5, cut_paths: 700, invalid: Some(id(4, 8)), failure: Some(failure(3)) };
    let both = PassCount { rays: 7, cut_paths: 730, invalid: Some(id(4, 8)), failure: Some(failure(3)) };
    assert_eq!((a.clone().merge(b.clone()), b.clone().merge(a.clone())), (both.clone(), both));
    assert_eq!(a.clone().merge(PassCount::default()), a);
    assert_eq!(PassCount::default().merge(a.clone()), a);
}

#[test]
fn threads_are_as_many_as_are_asked_for() {
    assert_eq!((threads(1).count(), threads(3).count()), (1, 3));
    assert_eq!(threads(0).count(), std::thread::available_parallelism().expect("a number").get());
}

#[test]
fn pixels_of_a_frame_are_those_of_the_film() {
    const SIZE: [u32; 2] = [70, 40];
    // Two samples a pixel, which say where they are.
    let sample = |x: u32, y: u32, number: u32| {
        let place = (1 + x + 100 * y) as f32;
        [place, 2.0 * place + number as f32, (3 * number) as f32 * place, 0.0]
    };
    let mut film = Film::new(SIZE);
    for tile in &mut film.tiles {
        for number in 0..2 {
            let mut radiance = vec![[0.0; 4]; 32 * 32];
            for (x, y) in (0..tile.size[1]).flat_map(|y| (0..tile.size[0]).map(move |x| (x, y))) {
                radiance[(y * 32 + x) as usize] = sample(tile.origin[0] + x, tile.origin[1] + y, number);
            }
            assert_eq!(tile.add(&radiance), None);
        }
    }
    let frame = frame(&film);
    for (x, y) in (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y))) {
        let i = frame.index_at([x, y]).expect("it lies in the image");
        let [a, b] = [0, 1].map(|number| sample(x, y, number));
        assert_eq!(frame.radiance[i], [0, 1, 2].map(|c| 0.5 * (a[c] + b[c])), "{x}, {y}");
        // The standard error of the mean of two is half their difference; those of channels add up.
        let exact = luminance([0, 1, 2].map(|c| 0.5 * (a[c] - b[c]).abs()));
        assert!((frame.standard_error[i] / exact - 1.0).abs() < 1e-3, "{x}, {y}: {} and {exact}", frame.standard_error[i]);
    }
    assert!(frame.counts.is_empty() && frame.spp == 2 && frame.generation == 1 && !frame.is_coarse() && !frame.is_black());
}

#[test]
fn a_coarse_frame_covers_the_whole_picture() {
    let coarse = Frame { width: 3, height: 2, full_resolution: [10, 4], radiance: vec![[0.0; 3]; 6], ..Frame::default() };
    assert_eq!(
        [[0, 0], [3, 1], [4, 0], [9, 0], [0, 2], [9, 3]].map(|pixel| coarse.index_at(pixel)),
        [0, 0, 1, 2, 3, 5].map(Some)
    );
    assert_eq!([coarse.index_at([10, 0]), coarse.index_at([0, 4])], [None, None]);
    assert!(coarse.is_coarse() && coarse.is_black());
    let lit = Frame { radiance: vec![[0.0; 3], [0.0, 0.0, 1e-30]], ..Frame::default() };
    assert!(!lit.is_black());
}

#[test]
fn samples_that_are_no_radiance_are_named_and_count_as_black() {
    for bad in [f32::NAN, f32::INFINITY, -1e-3] {
        let mut film = Film::new([40, 40]);
        for tile in &mut film.tiles[..3] {
            assert_eq!(tile.add(&vec![[1.0; 4]; 32 * 32]), None);
        }
        let tile = &mut film.tiles[3];
        let mut radiance = vec![[1.0; 4]; 32 * 32];
        (radiance[2 * 32 + 5][1], radiance[6 * 32 + 1][2]) = (bad, bad);
        assert_eq!(tile.add(&radiance), Some([32 + 5, 32 + 2]));
        assert_eq!(tile.add(&vec![[1.0; 4]; 32 * 32]), None);
        assert_eq!(film.invalid_samples(), 2);
        let frame = frame(&film);
        assert_eq!((frame.radiance[34 * 40 + 37], frame.radiance[34 * 40 + 36]), ([0.5; 3], [1.0; 3]));
    }
}

#[test]
fn samples_go_where_the_focus_is_and_are_counted_there() {
    let scene = plain([80, 80]);
    let mut film = Film::new([80, 80]);
    let region = Region::between([40, 5], [70, 10]);
    pass(&scene, &mut film, 1, &threads(2), &|| false);
    film.focus = Some(region);
    pass(&scene, &mut film, 4, &threads(2), &|| false);
    assert_eq!((film.spp(), film.spp_in(&region)), (1, Some(4)));
    assert_eq!(film.spp_in(&Region::between([0, 0], [40, 0])), Some(1), "the least of all tiles there");
    assert_eq!(film.spp_in(&Region::between([90, 0], [99, 9])), None);
    // The second and the third tile of the first row have three more.
    assert_eq!(film.samples(), 80 * 80 + 3 * (48 * 32));
    let frame = frame(&film);
    assert_eq!([31, 32, 79, 80 * 32 + 40].map(|i| frame.spp_at(i)), [1, 4, 4, 1]);
    assert_eq!(film.tiles_in_focus().count(), 2);
}

#[test]
fn a_film_that_is_used_again_is_empty() {
    let (scene, threads) = (built_in(), threads(2));
    let mut film = Film::new([64, 40]);
    film.keep_series();
    pass(&scene, &mut film, 3, &threads, &|| false);
    (film.is_piloted, film.focus) = (true, Some(Region::between([0, 0], [5, 5])));
    film.tiles[0].invalid = 7;
    let mut film = film.recycled([64, 40]);
    assert!(!film.is_piloted && film.focus.is_none() && !film.has_series() && !film.is_adaptive());
    assert_eq!((film.spp(), film.samples(), film.invalid_samples()), (0, 0, 0));
    let mut new = Film::new([64, 40]);
    for film in [&mut film, &mut new] {
        pass(&scene, film, 4, &threads, &|| false);
    }
    let [again, new] = [frame(&film), frame(&new)];
    assert!(again.radiance == new.radiance && again.standard_error == new.standard_error);
    assert_eq!((again.rel_mse_estimate, again.spp), (new.rel_mse_estimate, 4));
    assert_eq!(film.recycled([40, 64]).resolution, [40, 64]);
}
