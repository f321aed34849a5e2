//! Views, pixel by pixel, and their display.
use std::sync::Arc;

use crate::render::{
    Display, ToneMap,
    colour_map::ColourMap,
    film::Film,
    frame::Frame,
    image_file::{Picture, Provenance},
    reference::Reference,
    series::Series,
    threads::{PassJob, Threads},
    tone::to_srgb,
    view::{DisplaySettings, Field, Scale, Sources, View, ZScoreHistogram, draw},
};
use noisefall_kernel::integrator::Features;
use noisefall_scene::scene::{Camera, RenderSettings, Reuse, built_in};

const GREY: [u8; 4] = [96, 96, 96, 255];

/// 4 × 2 pixels: radiance 1 to 8, standard errors of a tenth of that.
fn frame() -> Frame {
    let values: Vec<f32> = (1..=8).map(|i| i as f32).collect();
    Frame {
        width: 4,
        height: 2,
        full_resolution: [4, 2],
        radiance: values.iter().map(|x| [*x; 3]).collect(),
        standard_error: values.iter().map(|x| x / 10.0).collect(),
        spp: 5,
        ..Frame::default()
    }
}

/// 8 × 4 pixels, of which a frame of 4 × 2 shows every other one.
fn features() -> Features {
    let numbers: Vec<f32> = (0..32).map(|i| i as f32).collect();
    Features {
        width: 8,
        height: 4,
        normal: (0..32).map(|i| if i == 18 { [1.0, 0.0, -1.0] } else { [0.0; 3] }).collect(),
        albedo: (0..32).map(|i| if i == 18 { [1.0, 0.0, 0.5] } else { [0.0; 3] }).collect(),
        depth: numbers.iter().map(|x| if *x == 0.0 { f32::INFINITY } else { *x }).collect(),
        position: vec![[0.0; 3]; 32],
        object: vec![0; 32],
        material: (0..32).map(|i| if i == 18 { u32::MAX } else { u32::from(i >= 16) }).collect(),
        cost: numbers.iter().map(|x| x * 2.0).collect(),
    }
}

fn sources<'a>(frame: &'a Frame, materials: &'a [String]) -> Sources<'a> {
    Sources { frame, radiance: None, reference: None, pinned: None, is_comparison: false, features: None, scale: None, materials }
}

fn numbers(view: View, sources: &Sources) -> Vec<f32> {
    let mut pixels = Vec::new();
    match draw(DisplaySettings { view, ..DisplaySettings::default() }, sources, &mut pixels) {
        Some((_, Field::Numbers(numbers))) => numbers,
        _ => panic!("{view:?} has no numbers"),
    }
}

fn is(found: &[f32], exact: &[f32]) {
    let near = |(a, b): (&f32, &f32)| a == b || (a - b).abs() <= 1e-5 * b.abs() || (a.is_nan() && b.is_nan());
    assert!(found.len() == exact.len() && found.iter().zip(exact).all(near), "{found:?} {exact:?}");
}

#[test]
fn views_show_the_numbers_they_are_named_after() {
    let (frame, features) = (frame(), features());
    let all = Sources { features: Some(&features), ..sources(&frame, &[]) };
    is(&numbers(View::StandardError, &all), &frame.standard_error);
    is(&numbers(View::SampleCount, &all), &[5.0; 8]);
    // The pixels of rows 0 and 2, columns 0, 2, 4 and 6; nothing is infinitely far.
    is(&numbers(View::Depth, &all), &[f32::NAN, 2.0, 4.0, 6.0, 16.0, 18.0, 20.0, 22.0]);
    is(&numbers(View::HitCost, &all), &[0.0, 4.0, 8.0, 12.0, 32.0, 36.0, 40.0, 44.0]);
    let counted = Frame { counts: (0..8).collect(), ..self::frame() };
    is(&numbers(View::SampleCount, &sources(&counted, &[])), &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
}

#[test]
fn scores_are_deviations_in_standard_errors() {
    let mut frame = frame();
    frame.standard_error[4] = 0.0;
    (frame.radiance[5], frame.standard_error[5]) = ([2.0; 3], 0.0);
    let truth = Reference::Constant([2.0; 3]);
    let scored = Sources { reference: Some(&truth), ..sources(&frame, &[]) };
    is(&numbers(View::ZScore, &scored), &[-10.0, 0.0, 10.0 / 3.0, 5.0, f32::INFINITY, 0.0, 50.0 / 7.0, 7.5]);
    let scores = ZScoreHistogram::of(&frame, &truth).expect("scores");
    // −10, 50/7, 7.5 and ∞ lie beyond ±5, 5 itself too; 0 twice and 10/3 do not.
    assert!((scores.beyond - 5.0 / 8.0).abs() < 1e-9, "{scores:?}");
    let filled: Vec<(usize, f64)> = scores.density.iter().copied().enumerate().filter(|(_, density)| *density > 0.0).collect();
    assert_eq!(filled.iter().map(|(bin, _)| *bin).collect::<Vec<_>>(), [25, 41]);
    assert!((filled[0].1 - 2.0 / 8.0 / 0.2).abs() < 1e-9 && (filled[1].1 - 1.0 / 8.0 / 0.2).abs() < 1e-9, "{filled:?}");
    assert!((ZScoreHistogram::middle(25) - 0.1).abs() < 1e-9 && (ZScoreHistogram::normal(1.0) - 0.241_970_724_519).abs() < 1e-9);
    let finite = [-10.0, 0.0, 10.0 / 3.0, 5.0, 0.0, 50.0 / 7.0, 7.5];
    let mean = finite.iter().sum::<f64>() / 7.0;
    let deviation = (finite.iter().map(|z: &f64| (z - mean).powi(2)).sum::<f64>() / 7.0).sqrt();
    assert!((scores.mean - mean).abs() < 1e-5 && (scores.deviation - deviation).abs() < 1e-5, "{scores:?}");
    let other = Picture { width: 2, height: 4, radiance: vec![[1.0; 3]; 8] };
    assert!(ZScoreHistogram::of(&frame, &Reference::Picture(Arc::new(other), Arc::new(Provenance::default()))).is_none());
}

#[test]
fn a_difference_is_relative_to_the_pinned_image() {
    let frame = frame();
    let pinned = Frame { radiance: vec![[2.0; 3]; 8], ..self::frame() };
    let root = 4.04f32.sqrt();
    let exact: Vec<f32> = (1..=8).map(|i| (i as f32 - 2.0) / root).collect();
    is(&numbers(View::Difference, &Sources { pinned: Some(&pinned), ..sources(&frame, &[]) }), &exact);
    // Of a term in place of the frame's own radiance.
    let term = vec![[3.0; 3]; 8];
    is(
        &numbers(View::Difference, &Sources { pinned: Some(&pinned), radiance: Some(&term), ..sources(&frame, &[]) }),
        &[1.0 / root; 8],
    );
    let black = Frame { radiance: vec![[0.0; 3]; 8], ..self::frame() };
    is(&numbers(View::Difference, &Sources { pinned: Some(&black), ..sources(&black, &[]) }), &[0.0; 8]);
    let narrow = Frame { width: 2, height: 4, ..pinned };
    let mut pixels = Vec::new();
    let shown = draw(
        DisplaySettings { view: View::Difference, ..DisplaySettings::default() },
        &Sources { pinned: Some(&narrow), ..sources(&frame, &[]) },
        &mut pixels,
    );
    assert!(matches!(shown, Some((_, Field::Missing))) && pixels == [GREY; 8]);
}

#[test]
fn views_of_surfaces_have_their_colours() {
    let (frame, features, names) = (frame(), features(), ["white".to_owned(), "red".to_owned()]);
    let all = Sources { features: Some(&features), ..sources(&frame, &names) };
    let shown = |view| {
        let mut pixels = Vec::new();
        let (legend, _) = draw(DisplaySettings { view, ..DisplaySettings::default() }, &all, &mut pixels).expect("a legend");
        (pixels, legend)
    };
    // Pixel 5 of the frame is pixel 18 of the features.
    let (normals, _) = shown(View::Normals);
    assert_eq!((normals[5], normals[0]), ([255, 128, 0, 255], [128, 128, 128, 255]));
    assert_eq!(shown(View::Albedo).0[5], [255, 0, 188, 255]);
    let (materials, legend) = shown(View::Materials);
    let [white, red] = [[0, 114, 178], [230, 159, 0]];
    assert_eq!((materials[5], materials[0], materials[4]), ([24, 24, 24, 255], [0, 114, 178, 255], [230, 159, 0, 255]));
    // 16 pixels of the features are white, 15 red.
    assert_eq!(legend.entries, [(white, "white".to_owned()), (red, "red".to_owned())]);
    assert!(legend.scale.is_none() && legend.title == View::Materials.title());
    let mut swapped = self::features();
    swapped.material.iter_mut().filter(|id| **id < 2).for_each(|id| *id = 1 - *id);
    let all = Sources { features: Some(&swapped), ..sources(&frame, &names) };
    let (legend, _) =
        draw(DisplaySettings { view: View::Materials, ..DisplaySettings::default() }, &all, &mut Vec::new()).expect("a legend");
    assert_eq!(legend.entries, [(red, "red".to_owned()), (white, "white".to_owned())], "the most seen comes first");
    let mut pixels = Vec::new();
    let missing =
        draw(DisplaySettings { view: View::Albedo, ..DisplaySettings::default() }, &sources(&frame, &names), &mut pixels);
    assert!(matches!(missing, Some((_, Field::Missing))) && pixels == [GREY; 8]);
}

#[test]
fn without_a_pinned_image_the_reference_is_subtracted() {
    let one = |radiance: f32| Frame { width: 1, height: 1, radiance: vec![[radiance; 3]], ..Frame::default() };
    let (frame, pinned, truth) = (one(3.0), one(1.0), Reference::Constant([2.0; 3]));
    let shown = |pinned| {
        let all = Sources { reference: Some(&truth), pinned, ..sources(&frame, &[]) };
        let look = DisplaySettings { view: View::Difference, ..DisplaySettings::default() };
        let (legend, _) = draw(look, &all, &mut Vec::new()).expect("a legend");
        (legend.title, numbers(View::Difference, &all)[0])
    };
    let floor = |mean: f32| (mean * mean * 1.01).sqrt();
    let [(title, with_pinned), (other_title, without)] = [Some(&pinned), None].map(shown);
    assert_eq!([&*title, &*other_title], ["Difference image − pinned image", "Difference image − reference"]);
    is(&[with_pinned, without], &[2.0 / floor(1.0), 1.0 / floor(2.0)]);
}

#[test]
fn numbers_have_the_colours_of_their_scale() {
    let mut frame = frame();
    frame.radiance[7] = [f32::NAN; 3];
    let truth = Reference::Constant([2.0; 3]);
    let mut pixels = vec![[1; 4]; 3];
    let look = DisplaySettings { view: View::ZScore, map: ColourMap::Cividis, ..DisplaySettings::default() };
    let (legend, _) = draw(look, &Sources { reference: Some(&truth), ..sources(&frame, &[]) }, &mut pixels).expect("scores");
    let scale = legend.scale.expect("a scale");
    assert_eq!((scale.map, scale.ends, scale.log), (ColourMap::Diverging, [-4.0, 4.0], false));
    let table = ColourMap::Diverging.table();
    assert_eq!([pixels[0], pixels[1], pixels[3], pixels[7]], [table[0], table[128], table[255], GREY]);
    // The scale of another image replaces its own.
    let given = Scale { ends: [0.0, 2.0], ..scale };
    let (legend, _) = draw(look, &Sources { reference: Some(&truth), scale: Some(given), ..sources(&frame, &[]) }, &mut pixels)
        .expect("scores");
    assert_eq!((legend.scale, pixels[1]), (Some(given), table[0]));
    let (legend, _) =
        draw(DisplaySettings { view: View::StandardError, ..look }, &sources(&frame, &[]), &mut pixels).expect("errors");
    let scale = legend.scale.expect("a scale");
    assert_eq!((scale.map, scale.ends, scale.log), (ColourMap::Cividis, [0.01, 1.0], true));
}

#[test]
fn a_scale_has_the_unit_of_its_view_and_missing_inputs_are_asked_for() {
    let (frame, features) = (Frame { counts: (0..8).collect(), ..frame() }, features());
    let truth = Reference::Constant([2.0; 3]);
    let all = Sources { features: Some(&features), reference: Some(&truth), pinned: Some(&frame), ..sources(&frame, &[]) };
    let legend = |view, sources: &Sources| {
        draw(DisplaySettings { view, ..DisplaySettings::default() }, sources, &mut Vec::new()).expect("a legend").0
    };
    for (view, unit, high) in [
        (View::StandardError, "W·sr⁻¹·m⁻²", 1.0),
        (View::SampleCount, "samples", 7.0),
        (View::ZScore, "σ", 4.0),
        (View::Difference, "relative to the pinned image", 0.001),
        (View::Depth, "m", 50.0),
        (View::HitCost, "ns per ray", 50.0),
    ] {
        let scale = legend(view, &all).scale.expect("a scale");
        assert_eq!((scale.unit, scale.ends[1]), (unit, high), "{view:?}");
    }
    let missing = [View::ZScore, View::Difference, View::Depth].map(|view| legend(view, &sources(&frame, &[])).title);
    let starts = ["No reference", "No image of this size", "Rendering view"];
    assert!(missing.iter().zip(starts).all(|(title, start)| title.starts_with(start)), "{missing:?}");
}

#[test]
fn colours_are_compared_by_luminance() {
    let one = |radiance| Frame { width: 1, height: 1, radiance: vec![radiance], standard_error: vec![0.25], ..Frame::default() };
    let (green, pinned, truth) = (one([0.0, 1.0, 0.0]), one([1.0, 0.0, 0.0]), Reference::Constant([0.0, 0.0, 1.0]));
    let all = Sources { reference: Some(&truth), pinned: Some(&pinned), ..sources(&green, &[]) };
    is(&numbers(View::ZScore, &all), &[(0.7152 - 0.0722) / 0.25]);
    // The mean square of red, green and blue is a third: 1 % of that is the floor.
    is(&numbers(View::Difference, &all), &[(0.7152 - 0.2126) / (0.2126f32.powi(2) + 0.01 / 3.0).sqrt()]);
}

#[test]
fn every_pixel_of_a_large_picture_has_its_own_code() {
    let radiance: Vec<[f32; 3]> = (0..1300).map(|i| [i as f32 / 1300.0, 1.0 - i as f32 / 1300.0, 0.25]).collect();
    for tone_map in ToneMap::ALL {
        let display = Display { exposure: -0.5, tone_map, ..Display::default() };
        let shown = |radiance: &[[f32; 3]]| {
            let mut pixels = vec![[7; 4]; 5];
            to_srgb(radiance, display, &mut pixels);
            pixels
        };
        let alone: Vec<[u8; 4]> = radiance.iter().flat_map(|pixel| shown(&[*pixel])).collect();
        assert_eq!(shown(&radiance), alone, "{tone_map:?}");
        assert!(alone.iter().all(|pixel| pixel[3] == 255));
    }
}

#[test]
fn false_colours_are_six_decades_around_one() {
    let shown = |luminance: f32, exposure: f32| {
        let mut pixels = Vec::new();
        to_srgb(&[[luminance; 3]], Display { exposure, tone_map: ToneMap::FalseColour, ..Display::default() }, &mut pixels);
        [pixels[0][0], pixels[0][1], pixels[0][2]]
    };
    let near = |found: [u8; 3], at: f32| {
        let exact = ColourMap::Viridis.of(at);
        assert!(found.iter().zip(exact).all(|(a, b)| a.abs_diff(b) <= 4), "{at}: {found:?} {exact:?}");
    };
    for (luminance, at) in
        [(1e-3, 0.0), (1e-2, 1.0 / 6.0), (0.1, 1.0 / 3.0), (1.0, 0.5), (100.0, 5.0 / 6.0), (1e3, 1.0), (1e9, 1.0)]
    {
        near(shown(luminance, 0.0), at);
        near(shown(luminance / 8.0, 3.0), at);
    }
}

#[test]
fn colours_are_those_of_the_maps_and_even_between() {
    assert_eq!(ColourMap::Viridis.of(0.5), [38, 130, 142]);
    assert_eq!(ColourMap::Viridis.of(1.0 / 16.0), [70, 21, 102]);
    assert_eq!([0.0, 0.5, 1.0].map(|at| ColourMap::Cividis.of(at)), [[0, 34, 78], [112, 113, 115], [254, 232, 56]]);
    assert_eq!([0.0, 0.5, 1.0].map(|at| ColourMap::Diverging.of(at)), [[170, 216, 250], [24, 24, 26], [255, 214, 140]]);
    let table = ColourMap::Cividis.table();
    let [r, g, b] = ColourMap::Cividis.of(0.2);
    assert_eq!([table[0], table[51], table[255]], [[0, 34, 78, 255], [r, g, b, 255], [254, 232, 56, 255]]);
}

/// The terms of every pixel, in tiles that do not fill the image, add up to the image and to those before.
#[test]
fn a_series_is_the_picture_by_numbers_of_bounces() {
    let scene = built_in();
    let resolution = [75, 40];
    let rays = scene.rays(&Camera { resolution, ..scene.camera });
    let threads = Threads::new(2, noisefall_base::math::SimdLevel::best()).expect("threads");
    let film = |max_bounces| {
        let settings = RenderSettings { reuse: Reuse::Off, max_bounces, ..scene.settings };
        let mut film = Film::new(resolution);
        film.keep_series();
        threads.pass(PassJob { scene: &scene, rays: &rays, settings: &settings }, &mut film, 3, &|| false);
        film
    };
    let whole = film(None);
    let series = Series::of_film(&whole).expect("it was kept");
    let near = |found: &[[f32; 3]], exact: &[[f32; 3]], what: &str| {
        let far = |(a, b): (&f32, &f32)| (a - b).abs() > 1e-4 * (1.0 + b.abs());
        assert!(found.len() == 75 * 40 && !found.as_flattened().iter().zip(exact.as_flattened()).any(far), "{what}");
    };
    let frame = |film: &Film| Frame::of_film(film, 0, resolution, resolution).radiance;
    near(&series.up_to(series.terms.len() - 1), &frame(&whole), "all terms are the image");
    for cap in [0, 1, 3] {
        near(&series.up_to(cap), &frame(&film(Some(cap as u32))), "what a cap lets pass");
    }
    near(&series.up_to(0), &series.terms[0], "the first term");
    let light =
        |picture: &[[f32; 3]]| picture.iter().map(|rgb| f64::from(noisefall_base::math::colour::luminance(*rgb))).sum::<f64>();
    for k in 0..4 {
        let share = light(&series.terms[k]) / light(&frame(&whole));
        assert!((series.shares[k] / share - 1.0).abs() < 2e-3, "{k}: {} {share}", series.shares[k]);
        let lost = 1.0 - light(&series.up_to(k)) / light(&frame(&whole));
        assert!((series.lost_by_cap(k) - lost).abs() < 1e-3, "{k}");
    }
}
