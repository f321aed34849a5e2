//! Images with other settings than the defaults, compared with scalar formulas.
use std::sync::Arc;

use super::picture;
use crate::{
    image::Picture,
    texture::{
        Edge, ImageTexture,
        image::{Channel, Image, SampledImage, TexelFilter, Wrap},
    },
};
use noisefall_base::math::{F, One};

const FILTERS: [TexelFilter; 2] = [TexelFilter::Bilinear, TexelFilter::Nearest];

fn sampled_from(picture: &Picture, image: &Image) -> SampledImage {
    SampledImage::new(Arc::new(ImageTexture::new(picture.into())), image).expect("its settings are valid")
}

fn sampled(image: &Image) -> SampledImage {
    sampled_from(&picture(), image)
}

fn colour(image: &SampledImage, u: f32, v: f32) -> [f32; 3] {
    image.colour(One, F(u), F(v)).lane(0)
}

/// The texel that stands for one beyond an axis of `size` texels.
fn texel(wrap: Wrap, mut index: i32, size: i32) -> Option<i32> {
    match wrap {
        Wrap::Repeat => Some(index.rem_euclid(size)),
        Wrap::Clamp => Some(index.clamp(0, size - 1)),
        Wrap::Black => (0..size).contains(&index).then_some(index),
        Wrap::Mirror => {
            while !(0..size).contains(&index) {
                index = if index < 0 { -1 - index } else { 2 * size - 1 - index };
            }
            Some(index)
        }
    }
}

/// The texels of an axis at a coordinate, with their weights.
fn weights(wrap: Wrap, filter: TexelFilter, t: f64, size: i32) -> Vec<(i32, f64)> {
    let x = t * f64::from(size);
    let weighted = match filter {
        TexelFilter::Nearest => vec![(x.floor(), 1.0)],
        TexelFilter::Bilinear => {
            let (start, part) = ((x - 0.5).floor(), (x - 0.5).rem_euclid(1.0));
            vec![(start, 1.0 - part), (start + 1.0, part)]
        }
    };
    weighted.into_iter().filter_map(|(index, weight)| Some((texel(wrap, index as i32, size)?, weight))).collect()
}

/// The red of the 3 × 2 texels 0, 1, … 5.
fn red(image: &Image, s: f64, t: f64) -> f64 {
    let columns = weights(image.wrap_u, image.filter, s, 3);
    let rows = weights(image.wrap_v, image.filter, t, 2);
    rows.iter().flat_map(|(j, y)| columns.iter().map(move |(i, x)| x * y * f64::from(i + 3 * j))).sum()
}

/// Coordinates on no edge of texels, several images to both sides.
fn coordinates() -> impl Iterator<Item = (f64, f64)> + Clone {
    (0..2000).map(|i| (f64::from(i * 577 % 1621) / 271.0 - 2.99, f64::from(i * 919 % 1627) / 271.0 - 3.01))
}

#[test]
fn wraps_and_filters_continue_images_by_their_texels() {
    for filter in FILTERS {
        for (wrap_u, wrap_v) in Wrap::ALL.iter().flat_map(|u| Wrap::ALL.map(|v| (*u, v))) {
            let image = Image { filter, wrap_u, wrap_v, ..Image::default() };
            let found = sampled(&image);
            for (u, v) in coordinates() {
                let (expected, found) = (red(&image, u, v), f64::from(colour(&found, u as f32, v as f32)[0]));
                assert!((found - expected).abs() < 1e-4, "{image:?} at {u}, {v}: {found} is not {expected}");
            }
        }
    }
}

#[test]
fn seams_are_where_the_wrap_puts_them() {
    let at = |wrap: Wrap, filter: TexelFilter, u: f32| {
        colour(&sampled(&Image { wrap_u: wrap, wrap_v: Wrap::Clamp, filter, ..Image::default() }), u, 0.25)[0]
    };
    let bilinear = |wrap: Wrap| [-0.25, 0.0, 1.0, 1.25].map(|u| at(wrap, TexelFilter::Bilinear, u));
    assert_eq!(bilinear(Wrap::Repeat), [1.75, 1.0, 1.0, 0.25]);
    assert_eq!(bilinear(Wrap::Mirror), [0.25, 0.0, 2.0, 1.75]);
    assert_eq!(bilinear(Wrap::Clamp), [0.0, 0.0, 2.0, 2.0]);
    assert_eq!(bilinear(Wrap::Black), [0.0, 0.0, 1.0, 0.0]);
    let nearest = |wrap: Wrap| [-0.25, 0.0, 1.0, 1.25].map(|u| at(wrap, TexelFilter::Nearest, u));
    assert_eq!(nearest(Wrap::Repeat), [2.0, 0.0, 0.0, 0.0]);
    assert_eq!(nearest(Wrap::Mirror), [0.0, 0.0, 2.0, 2.0]);
    assert_eq!(nearest(Wrap::Clamp), [0.0, 0.0, 2.0, 2.0]);
    assert_eq!(nearest(Wrap::Black), [0.0; 4]);
}

#[test]
fn default_settings_give_the_bits_of_the_plain_lookup() {
    let (found, plain) = (sampled(&Image::default()), ImageTexture::new((&picture()).into()));
    for (u, v) in coordinates() {
        let (u, v) = (u as f32, v as f32);
        assert_eq!(colour(&found, u, v), plain.colour(One, F(u), F(v), Edge::Repeat).lane(0), "{u}, {v}");
    }
    assert_eq!(
        (found.summary().maximum, found.summary().steps),
        (plain.maximum(), [plain.step_u() / 16.0, plain.step_v() / 16.0, f32::INFINITY])
    );
}

#[test]
fn any_coordinates_give_a_colour_of_the_image() {
    for (wrap, filter) in Wrap::ALL.iter().flat_map(|wrap| FILTERS.map(|filter| (*wrap, filter))) {
        let found = sampled(&Image { wrap_u: wrap, wrap_v: wrap, filter, rotate: 30.0, ..Image::default() });
        for odd in [f32::NAN, f32::INFINITY, -f32::INFINITY, 1e30, -1e30, -1e-9, -0.0] {
            let found = colour(&found, odd, 0.3);
            assert!((0.0..=5.0).contains(&found[0]), "{wrap:?} {filter:?} {odd}: {found:?}");
        }
    }
}

#[test]
fn coordinates_are_scaled_then_rotated_then_moved() {
    let plain = Image { wrap_u: Wrap::Mirror, ..Image::default() };
    for (scale, rotate, offset) in
        [([2.0, -1.5], 30.0, [0.3, -0.7]), ([0.5, 3.0], -250.0, [-4.0, 0.1]), ([1.0, 1.0], 90.0, [0.0, 0.0])]
    {
        let found = sampled(&Image { scale, rotate, offset, ..plain.clone() });
        let (sin, cos) = f64::to_radians(rotate).sin_cos();
        for (u, v) in coordinates() {
            let (s, t) = (u * scale[0], v * scale[1]);
            let expected = red(&plain, s * cos - t * sin + offset[0], s * sin + t * cos + offset[1]);
            let found = f64::from(colour(&found, u as f32, v as f32)[0]);
            assert!((found - expected).abs() < 1e-3, "{rotate}° at {u}, {v}: {found} is not {expected}");
        }
    }
}

#[test]
fn means_are_those_of_the_unit_square() {
    const SIDE: u32 = 480;
    let centre = |i: u32| (i as f32 + 0.5) / SIDE as f32;
    let mean = |image: &SampledImage| {
        let reds = (0..SIDE * SIDE).map(|i| f64::from(colour(image, centre(i % SIDE), centre(i / SIDE))[0]));
        (reds.sum::<f64>() / f64::from(SIDE * SIDE)) as f32
    };
    let maps = [
        ([1.0, 1.0], 0.0, [0.0, 0.0]),
        ([2.3, -0.7], 0.0, [0.4, 1.2]),
        ([0.3, 0.2], 90.0, [0.9, -0.05]),
        ([-1.6, 2.5], 180.0, [-0.8, 0.3]),
        ([1.5, 1.5], 30.0, [0.1, 0.2]),
    ];
    for (scale, rotate, offset) in maps {
        for filter in FILTERS {
            for (wrap_u, wrap_v) in Wrap::ALL.map(|wrap| (wrap, wrap)).into_iter().chain([(Wrap::Black, Wrap::Mirror)]) {
                let image = Image { scale, rotate, offset, filter, wrap_u, wrap_v, ..Image::default() };
                let found = sampled(&image);
                let (expected, found) = (mean(&found), found.summary().mean[0]);
                // A point of the grid stands for a square of it, which edges of texels cross.
                let tolerance = if filter == TexelFilter::Nearest { 0.05 } else { 0.01 };
                assert!((found - expected).abs() < tolerance, "{image:?}: {found} is not {expected}");
            }
        }
    }
}

#[test]
fn means_are_exact_over_whole_images_and_at_their_edges() {
    let mean = |image: Image| sampled(&image).summary().mean[0];
    for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
        assert!((mean(Image { wrap_u: wrap, wrap_v: wrap, ..Image::default() }) - 2.5).abs() < 1e-6, "{wrap:?}");
    }
    for scale in [[4.0, -6.0], [1e4, 1e4]] {
        for wrap in [Wrap::Repeat, Wrap::Mirror] {
            let image = Image { wrap_u: wrap, wrap_v: wrap, scale, offset: [0.37, -123.4], ..Image::default() };
            assert!((mean(image) - 2.5).abs() < 1e-5, "{wrap:?} {scale:?}");
        }
    }
    // Along each axis the half texels at both edges lose a quarter of their light.
    let one = Picture { width: 1, height: 1, radiance: vec![[1.0; 3]] };
    let black = Image { wrap_u: Wrap::Black, wrap_v: Wrap::Black, ..Image::default() };
    assert_eq!(sampled_from(&one, &black).summary().mean, [0.5625; 3]);
    let far = Image { wrap_u: Wrap::Clamp, wrap_v: Wrap::Clamp, offset: [7.0, -8.0], ..Image::default() };
    assert_eq!(mean(far), 2.0, "the last texel of the first row");
    // A point of the image.
    let point = Image { scale: [0.0, 0.0], offset: [0.5, 0.25], ..Image::default() };
    assert!((mean(point) - 1.0).abs() < 1e-5);
}

#[test]
fn images_that_are_black_in_the_unit_square_have_another_mean() {
    let beside = Image { wrap_u: Wrap::Black, offset: [5.0, 0.0], ..Image::default() };
    assert_eq!(sampled(&beside).summary().mean, [2.5, 25.0, 0.5]);
    let black = Picture { width: 1, height: 1, radiance: vec![[0.0; 3]] };
    assert_eq!(sampled_from(&black, &beside).summary().mean, [0.0; 3]);
}

#[test]
fn a_channel_is_grey() {
    for (channel, mean, maximum) in [(Channel::Red, 2.5, 5.0), (Channel::Green, 25.0, 50.0), (Channel::Blue, 0.5, 0.5)] {
        let found = sampled(&Image { channel, ..Image::default() });
        let summary = found.summary();
        assert_eq!((summary.mean, summary.maximum), ([mean; 3], [maximum; 3]), "{channel:?}");
        let expected = [1.0, 10.0, 0.5][channel as usize - Channel::Red as usize];
        assert!(colour(&found, 0.5, 0.25).iter().all(|x| (x - expected).abs() < 1e-5), "{channel:?}");
    }
}

#[test]
fn steps_move_by_a_small_part_of_a_texel() {
    let steps = |scale: [f64; 2], rotate: f64| sampled(&Image { scale, rotate, ..Image::default() }).summary().steps;
    assert_eq!(steps([2.0, 4.0], 0.0), [1.0 / 12.0 / 16.0, 1.0 / 256.0, f32::INFINITY]);
    assert_eq!(steps([2.0, 4.0], 90.0), [1.0 / 128.0, 1.0 / 24.0 / 16.0, f32::INFINITY]);
    assert_eq!(steps([0.0, 0.0], 0.0), [1.0 / 32.0, 1.0 / 32.0, f32::INFINITY]);
}

#[test]
fn coordinates_far_beyond_the_image_are_refused() {
    let refused =
        |image: Image| SampledImage::new(Arc::new(ImageTexture::new((&picture()).into())), &image).err().map(|e| e.message);
    assert_eq!(refused(Image { scale: [1.0, 2e4], ..Image::default() }).as_deref(), Some("`scale` is out of range"));
    assert_eq!(refused(Image { offset: [f64::NAN, 0.0], ..Image::default() }).as_deref(), Some("`offset` is out of range"));
    assert_eq!(refused(Image { offset: [-1e4, 1e4], ..Image::default() }), None);
}
