//! Values where they are known, continuity, means, and lanes of different textures.
mod combined;
mod images;
mod limits;

use std::sync::Arc;

use super::{
    Constant, Edge, ImagePattern, ImageTexture, Texture, TextureCoordinates, Textures,
    checker::{self, Squares},
    noise::{self, Clouds},
};
use crate::chi_squared::chi_squared;
use crate::{image::Picture, sampling::gradient_noise::fraction};
use noisefall_base::math::{F, Lanes, M, One, SimdLevel, U, V};

fn at(u: f32, v: f32) -> TextureCoordinates<'static, One> {
    TextureCoordinates { u: F(u), v: F(v), p: V { x: F(u), y: F(v), z: F(0.0) }, vertex: None }
}

fn noise_at([x, y, z]: [f32; 3], octaves: u32) -> f32 {
    fraction(V::<One> { x: F(x), y: F(y), z: F(z) }, 1.0, octaves).0
}

fn picture() -> Picture {
    Picture { width: 3, height: 2, radiance: (0..6).map(|i| [i as f32, 10.0 * i as f32, 0.5]).collect() }
}

fn plain(picture: &Picture) -> ImagePattern {
    ImagePattern::Plain(Arc::new(ImageTexture::new(picture.into())))
}

#[test]
fn images_have_their_texels_at_their_centres_and_repeat() {
    let image = ImageTexture::new((&picture()).into());
    let colour = |u: f32, v: f32, edge| image.colour(One, F(u), F(v), edge).lane(0);
    for (i, texel) in picture().radiance.iter().enumerate() {
        let (u, v) = (((i % 3) as f32 + 0.5) / 3.0, ((i / 3) as f32 + 0.5) / 2.0);
        for (du, dv) in [(0.0, 0.0), (1.0, 0.0), (-2.0, 3.0)] {
            let found = colour(u + du, v + dv, Edge::Repeat);
            assert!((0..3).all(|k| (found[k] - texel[k]).abs() < 1e-5), "{i}: {found:?}");
        }
        assert!((colour(u, v, Edge::Clamp)[1] - texel[1]).abs() < 1e-5);
    }
    assert!((colour(1.0 / 3.0, 0.25, Edge::Repeat)[0] - 0.5).abs() < 1e-6, "halfway between texels");
    assert!((colour(0.0, 0.25, Edge::Repeat)[0] - 1.0).abs() < 1e-6, "halfway across the seam");
    assert!((colour(0.5, 0.0, Edge::Repeat)[0] - 2.5).abs() < 1e-6, "halfway from bottom to top");
    assert_eq!(colour(0.5, 0.0, Edge::Clamp)[0], 1.0);
    assert_eq!(colour(0.5, 1.0, Edge::Clamp)[0], 4.0);
    for odd in [f32::NAN, f32::INFINITY, -f32::INFINITY, 1e30, -1e-9, -0.0] {
        let found = colour(odd, odd, Edge::Repeat);
        assert!((0.0..=5.0).contains(&found[0]), "{odd}: {found:?}");
    }
    assert_eq!((image.mean(), image.maximum()), ([2.5, 25.0, 0.5], [5.0, 50.0, 0.5]));
}

#[test]
fn checkers_alternate_and_know_their_share() {
    let even = |u: f32, v: f32| checker::is_even(F::<One>(u), F(v), 4.0).0;
    assert_eq!([even(0.1, 0.1), even(0.3, 0.1), even(0.1, 0.3), even(0.3, 0.3)], [true, false, false, true]);
    assert!(!even(-0.1, 0.1) && even(-0.1, -0.1));
    for scale in [0.5, 1.0, 1.5, 2.0, 2.7, 3.0, 8.0, 9.3] {
        let inside = |i: u32| F::<One>((i as f32 + 0.5) / 1000.0);
        let count = (0..1_000_000).filter(|i| checker::is_even(inside(i % 1000), inside(i / 1000), scale).0).count();
        assert!((count as f32 / 1e6 - checker::even_share(scale)).abs() < 2e-3, "{scale}");
    }
}

#[test]
fn nested_checkers_are_followed() {
    let mut set = Textures::default();
    let [black, red, green] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|c| set.push(Texture::Constant(Constant(c))));
    let fine = set.push(Texture::Checker(Squares { even: red, odd: green, scale: 4.0 }));
    let coarse = set.push(Texture::Checker(Squares { even: fine, odd: black, scale: 2.0 }));
    let colour = |u, v| set.colour(One, U(coarse), M(true), &at(u, v)).lane(0);
    assert_eq!([colour(0.1, 0.1), colour(0.3, 0.1), colour(0.6, 0.1)], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0; 3]]);
    assert_eq!(set.mean(coarse), [0.25, 0.25, 0.0]);
    assert_eq!(set.maximum(coarse), [1.0, 1.0, 0.0]);
    assert!((set.height(One, U(coarse), M(true), &at(0.3, 0.1)).0 - 0.7152).abs() < 1e-6);
    assert_eq!(set.steps(One, U(coarse)).u.0, 1.0 / 128.0);
    assert_eq!(set.colour(One, U(red), M(false), &at(0.0, 0.0)).lane(0), [0.0; 3]);
}

#[test]
fn noise_is_continuous_in_range_and_half_on_average() {
    const COUNT: u32 = 400_000;
    let (mut sum, mut least, mut most, mut jump) = (0.0, 1.0f32, 0.0f32, 0.0f32);
    for i in 0..COUNT {
        let p = [1u32, 2, 3].map(|axis| crate::sampling::hash::hash_one(4 * i + axis) as f32 / 4.0e7 - 50.0);
        let t = noise_at(p, 5);
        sum += f64::from(t);
        (least, most) = (least.min(t), most.max(t));
        jump = jump.max((noise_at([p[0] + 1e-3, p[1], p[2]], 1) - noise_at(p, 1)).abs());
    }
    let mean = sum / f64::from(COUNT);
    println!("mean {mean:.4}, from {least:.3} to {most:.3}, at most {jump:.5} in 0.001");
    assert!((mean - 0.5).abs() < 0.005 && least >= 0.0 && most <= 1.0 && most - least > 0.8 && jump < 3e-3);
    for axis in 0..3 {
        for lattice in -20..20 {
            let side = |distance: f32| {
                let mut p = [0.37, 1.21, -0.64];
                p[axis] = lattice as f32 + distance;
                noise_at(p, 1)
            };
            assert!((side(1e-4) - side(-1e-4)).abs() < 5e-4, "a seam at {lattice}");
        }
    }
    assert_eq!(noise_at([3.0, -7.0, 2.0], 1), 0.5);
    for odd in [f32::NAN, f32::INFINITY, 1e30, -1e30] {
        assert!((0.0..=1.0).contains(&noise_at([odd, 0.3, odd], 4)));
    }
}

/// The gradient of noise at a point of the lattice.
fn gradient(p: [f32; 3]) -> [i32; 3] {
    const STEP: f32 = 1e-3;
    [0, 1, 2].map(|axis| {
        let mut beside = p;
        beside[axis] += STEP;
        // One octave is half of the noise above ½.
        (2.0 * (noise_at(beside, 1) - 0.5) / STEP).round() as i32
    })
}

#[test]
fn gradients_are_the_edges_of_a_cube_alike() {
    let mut counts = std::collections::BTreeMap::new();
    for i in 0..16 * 16 * 16 {
        let found = gradient([i % 16, i / 16 % 16, i / 256].map(|x| x as f32 - 8.0));
        assert_eq!(found.iter().map(|x| x * x).sum::<i32>(), 2, "{found:?} is no edge");
        *counts.entry(found).or_insert(0u32) += 1;
    }
    // Of sixteen hashes six give an edge in each of two planes, and four in the plane of x and z.
    assert_eq!(counts.len(), 12);
    let expected = |edge: &[i32; 3]| if edge[1] == 0 { 256.0 } else { 384.0 };
    let [found, expected]: [Vec<f64>; 2] =
        [counts.values().map(|count| f64::from(*count)).collect(), counts.keys().map(expected).collect()];
    assert!(chi_squared(&found, &expected) > 1e-4, "{counts:?}");
}

#[test]
fn noise_between_points_of_the_lattice_is_joined_by_the_quintic() {
    for i in 0..200 {
        let corner = [i % 7, i % 11, i % 13].map(|x| x as f32);
        for axis in 0..3 {
            let mut next = corner;
            next[axis] += 1.0;
            let (a, b) = (gradient(corner)[axis] as f32, gradient(next)[axis] as f32);
            for t in [0.125f32, 0.25, 0.5, 0.8125] {
                let mut p = corner;
                p[axis] += t;
                let fade = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
                let expected = 0.5 + 0.5 * ((1.0 - fade) * a * t + fade * b * (t - 1.0));
                assert!((noise_at(p, 1) - expected).abs() < 1e-5, "{p:?}: {} is not {expected}", noise_at(p, 1));
            }
        }
    }
}

#[test]
fn octaves_are_twice_as_fine_and_half_as_strong() {
    // At a point of the first lattices the finer one alone is left: its steps there are those of a cell half as large.
    let fraction = |x: f32, octaves: u32| noise_at([x, 0.3, -0.2], octaves) - noise_at([x, 0.3, -0.2], octaves - 1);
    for octave in 1..4u32 {
        let (mut squares, mut product) = (0.0f64, 0.0f64);
        let lag = 0.125 / f32::powi(2.0, octave as i32);
        for i in 0..20_000 {
            let x = i as f32 * 0.37;
            let (a, b) = (f64::from(fraction(x, octave + 1)), f64::from(fraction(x + lag, octave + 1)));
            (squares, product) = (squares + a * a, product + a * b);
        }
        let deviation = (squares / 20_000.0).sqrt() * f64::from(2u32 << octave);
        // Of lattice noise: 0.25 ± 0.03 on average over the cell, whatever the octave.
        assert!((0.2..0.32).contains(&deviation), "octave {octave}: {deviation}");
        // An eighth of its own cell apart: so much of it is the same.
        let same = product / squares;
        assert!((0.85..0.98).contains(&same), "octave {octave}: {same}");
    }
    // Lattices that met there would leave nothing at the points of the coarsest.
    assert_ne!(noise_at([3.0, -7.0, 2.0], 2), 0.5);
    assert_eq!(noise::step(4.0, 1), 1.0 / 64.0);
    assert_eq!(noise::step(4.0, 3), 1.0 / 256.0);
}

#[test]
fn scale_is_the_number_of_cells_to_a_metre() {
    let scaled = |x: f32| fraction(V::<One> { x: F(x), y: F(0.25), z: F(0.75) }, 4.0, 1).0;
    let plain = |x: f32| fraction(V::<One> { x: F(4.0 * x), y: F(1.0), z: F(3.0) }, 1.0, 1).0;
    (0..100).map(|i| i as f32 * 0.03125).for_each(|x| assert_eq!(scaled(x), plain(x)));
}

#[test]
fn noise_goes_from_its_low_colour_to_its_high_one() {
    let mut set = Textures::default();
    let (low, high) = ([0.1, 0.9, 0.3], [0.8, 0.2, 0.3]);
    let id = set.push(Texture::Noise(Clouds { scale: 1.0, octaves: 2, low, high }));
    let mut most = 0.5f32;
    for i in 0..50 {
        let (u, v) = (0.37 * i as f32, 0.3 + 0.11 * i as f32);
        let t = noise_at([u, v, 0.0], 2);
        let found = set.colour(One, U(id), M(true), &at(u, v)).lane(0);
        assert!((0..3).all(|k| (found[k] - (low[k] + (high[k] - low[k]) * t)).abs() < 1e-5), "{t}: {found:?}");
        most = most.max(t);
    }
    assert!(most > 0.55, "one of them is not in the middle: {most}");
}

#[test]
fn steps_are_those_of_the_finest_part() {
    let mut set = Textures::default();
    let image = set.push(Texture::Image(plain(&picture())));
    let noise = set.push(Texture::Noise(Clouds { scale: 2.0, octaves: 3, low: [0.0, 0.75, 0.0], high: [1.0, 0.5, 0.25] }));
    let checker = set.push(Texture::Checker(Squares { even: image, odd: noise, scale: 8.0 }));
    let constant = set.push(Texture::Constant(Constant([0.5, 0.25, 0.125])));
    let steps = |id: u32| {
        let steps = set.steps(One, U(id));
        [steps.u.0, steps.v.0, steps.p.0]
    };
    assert_eq!(steps(image), [1.0 / 6.0 / 16.0, 1.0 / 64.0, f32::INFINITY]);
    assert_eq!(steps(noise), [1.0 / 64.0, 1.0 / 64.0, 1.0 / 128.0]);
    assert_eq!(steps(checker), [1.0 / 256.0, 1.0 / 256.0, 1.0 / 128.0]);
    assert_eq!(steps(constant), [1.0 / 64.0, 1.0 / 64.0, f32::INFINITY]);
    assert_eq!((set.mean(noise), set.maximum(noise)), ([0.5, 0.625, 0.125], [1.0, 0.75, 0.25]));
    assert_eq!((set.mean(constant), set.maximum(constant)), ([0.5, 0.25, 0.125], [0.5, 0.25, 0.125]));
    // Of 8 × 8 squares half are even.
    assert_eq!((set.mean(checker), set.maximum(checker)), ([1.5, 12.8125, 0.3125], [5.0, 50.0, 0.5]));
}

#[inline(always)]
fn lanes_of<L: Lanes>(l: L, set: &Textures, coordinates: &[[f32; 16]; 3], ids: U<L>) -> Vec<[u32; 3]> {
    let [u, v, z] = [0, 1, 2].map(|axis| l.load(&coordinates[axis]));
    let at = TextureCoordinates { u, v, p: V { x: u, y: v, z }, vertex: None };
    let colour = set.colour(l, ids, l.first(L::N), &at);
    (0..L::N).map(|lane| colour.lane(lane).map(f32::to_bits)).collect()
}

#[test]
fn every_width_gives_the_same_bits() {
    let mut set = Textures::default();
    let low = set.push(Texture::Noise(Clouds { scale: 9.0, octaves: 6, low: [0.1, 0.2, 0.3], high: [0.9, 0.5, 0.3] }));
    let image = set.push(Texture::Image(plain(&picture())));
    set.push(Texture::Checker(Squares { even: low, odd: image, scale: 5.0 }));
    set.push(Texture::Constant(Constant([0.25; 3])));
    for round in 0..200u32 {
        let coordinates = [1u32, 2, 3].map(|axis| {
            std::array::from_fn(|lane| crate::sampling::hash::hash_one(64 * round + 4 * lane as u32 + axis) as f32 / 4.0e9)
        });
        let one = |lane: usize| lanes_of(One, &set, &coordinates.map(|c| [c[lane]; 16]), U((lane % 4) as u32))[0];
        for level in SimdLevel::available() {
            let found = noisefall_base::math::in_lanes!(level, l => lanes_of(l, &set, &coordinates, l.iota() & 3));
            let expected: Vec<_> = (0..found.len()).map(one).collect();
            assert_eq!(found, expected, "{level:?}");
        }
    }
}

#[test]
fn noise_is_constant_where_cells_have_no_numbers_any_more() {
    let (mut least, mut most) = (1.0f32, 0.0f32);
    for i in 0..64 {
        let [y, z] = [0.3 + 0.37 * (i % 8) as f32, 0.6 + 0.29 * (i / 8) as f32];
        for sign in [1.0, -1.0] {
            let [near, far] = [5e6, 1e9].map(|x| noise_at([sign * x, y, z], 1));
            assert_eq!(near, far);
            (least, most) = (least.min(near), most.max(near));
        }
    }
    assert!(least > 0.0 && most < 1.0 && most - least > 0.2, "{least} {most}");
}
