//! Values where they are known, continuity, means, and lanes of different textures.
use super::{Edge, ImageTexture, Texture, TextureCoordinates, Textures, checker, noise};
use crate::{
    image::Picture,
    math::{F, Lanes, M, One, SimdLevel, U, V},
};

fn at(u: f32, v: f32) -> TextureCoordinates<One> {
    TextureCoordinates { u: F(u), v: F(v), p: V { x: F(u), y: F(v), z: F(0.0) } }
}

fn noise_at([x, y, z]: [f32; 3], octaves: u32) -> f32 {
    noise::fraction(V::<One> { x: F(x), y: F(y), z: F(z) }, 1.0, octaves).0
}

fn picture() -> Picture {
    Picture { width: 3, height: 2, radiance: (0..6).map(|i| [i as f32, 10.0 * i as f32, 0.5]).collect() }
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
    let [black, red, green] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|c| set.push(Texture::Constant(c)));
    let fine = set.push(Texture::Checker { even: red, odd: green, scale: 4.0 });
    let coarse = set.push(Texture::Checker { even: fine, odd: black, scale: 2.0 });
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

#[inline(always)]
fn lanes_of<L: Lanes>(l: L, set: &Textures, coordinates: &[[f32; 16]; 3], ids: U<L>) -> Vec<[u32; 3]> {
    let [u, v, z] = [0, 1, 2].map(|axis| l.load(&coordinates[axis]));
    let at = TextureCoordinates { u, v, p: V { x: u, y: v, z } };
    let colour = set.colour(l, ids, l.first(L::N), &at);
    (0..L::N).map(|lane| colour.lane(lane).map(f32::to_bits)).collect()
}

#[test]
fn every_width_gives_the_same_bits() {
    let mut set = Textures::default();
    let low = set.push(Texture::Noise { scale: 9.0, octaves: 6, low: [0.1, 0.2, 0.3], high: [0.9, 0.5, 0.3] });
    let image = set.push(Texture::Image(ImageTexture::new((&picture()).into())));
    set.push(Texture::Checker { even: low, odd: image, scale: 5.0 });
    set.push(Texture::Constant([0.25; 3]));
    for round in 0..200u32 {
        let coordinates = [1u32, 2, 3].map(|axis| {
            std::array::from_fn(|lane| crate::sampling::hash::hash_one(64 * round + 4 * lane as u32 + axis) as f32 / 4.0e9)
        });
        let one = |lane: usize| lanes_of(One, &set, &coordinates.map(|c| [c[lane]; 16]), U((lane % 4) as u32))[0];
        for level in SimdLevel::available() {
            let found = crate::in_lanes!(level, l => lanes_of(l, &set, &coordinates, l.iota() & 3));
            let expected: Vec<_> = (0..found.len()).map(one).collect();
            assert_eq!(found, expected, "{level:?}");
        }
    }
}
