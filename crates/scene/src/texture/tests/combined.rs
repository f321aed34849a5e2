//! Textures of several others, compared with scalar formulas.
use super::{at, lanes_of, picture, plain};
use crate::texture::{
    ColourSource, Constant, NumberSource, Texture, TextureCoordinates, Textures, checker::Squares, image::Channel, mix::Mixture,
    noise::Clouds, product::Factors, ramp::Gradient, vertex_color::VertexLookup,
};
use noisefall_base::math::{F, Lanes, M, One, SimdLevel, U};

/// A few textures: their ids are 0, 1, ….
fn textures() -> Textures {
    let mut set = Textures::default();
    set.push(Texture::Noise(Clouds { scale: 3.0, octaves: 3, low: [0.1, 0.2, 0.3], high: [0.9, 0.5, 0.3] }));
    set.push(Texture::Image(plain(&picture())));
    set.push(Texture::Constant(Constant([0.0; 3])));
    set.push(Texture::Checker(Squares { even: 0, odd: 2, scale: 4.0 }));
    set
}

fn colour(set: &Textures, id: u32, at: &TextureCoordinates<One>) -> [f32; 3] {
    set.colour(One, U(id), M(true), at).lane(0)
}

fn luminance([r, g, b]: [f32; 3]) -> f32 {
    r * 0.2126 + (g * 0.7152 + b * 0.0722)
}

fn points() -> impl Iterator<Item = TextureCoordinates<'static, One>> {
    (0..300).map(|i| at(0.137 * i as f32 - 7.3, 0.093 * i as f32 - 11.1))
}

const GREEN: [f32; 3] = [0.25, 1.0, 0.5];

#[test]
fn products_multiply() {
    let mut set = textures();
    let two = set.push(Texture::Product(Factors { a: ColourSource::Texture(3), b: ColourSource::Texture(1) }));
    let one = set.push(Texture::Product(Factors { a: ColourSource::Constant(GREEN), b: ColourSource::Texture(1) }));
    for at in points() {
        let [checker, image] = [3, 1].map(|id| colour(&set, id, &at));
        assert_eq!(colour(&set, two, &at), [0, 1, 2].map(|i| checker[i] * image[i]));
        assert_eq!(colour(&set, one, &at), [0, 1, 2].map(|i| GREEN[i] * image[i]));
    }
    assert_eq!((set.mean(one), set.maximum(one)), ([0.625, 25.0, 0.25], [1.25, 50.0, 0.25]));
    assert_eq!(set.maximum(two), [0.9 * 5.0, 25.0, 0.15], "the largest values of both");
    let steps = set.steps(One, U(two));
    assert_eq!([steps.u.0, steps.v.0, steps.p.0], [1.0 / 128.0, 1.0 / 128.0, 1.0 / 192.0]);
}

#[test]
fn mixtures_interpolate_by_luminance() {
    let mut set = textures();
    let [a, b] = [1, 0].map(ColourSource::Texture);
    let varying = set.push(Texture::Mix(Mixture { a, b, weight: NumberSource::Texture(3) }));
    let constant = set.push(Texture::Mix(Mixture { a, b: ColourSource::Constant(GREEN), weight: NumberSource::Constant(0.25) }));
    for at in points() {
        let [noise, image, checker] = [0, 1, 3].map(|id| colour(&set, id, &at));
        let weight = luminance(checker).min(1.0);
        assert_eq!(colour(&set, varying, &at), [0, 1, 2].map(|i| image[i] * (1.0 - weight) + noise[i] * weight));
        assert_eq!(colour(&set, constant, &at), [0, 1, 2].map(|i| image[i] * 0.75 + GREEN[i] * 0.25));
    }
    assert_eq!((set.mean(constant), set.maximum(constant)), ([1.9375, 19.0, 0.5], [3.8125, 37.75, 0.5]));
    assert_eq!(set.maximum(varying), [5.0, 50.0, 0.5], "the first colour counts fully where the weight is 0");
}

#[test]
fn the_largest_value_of_a_mixture_is_that_of_the_largest_weight() {
    let mut set = textures();
    // The luminance of the checker is at most that of the highest noise.
    let most = luminance([0.9, 0.5, 0.3]);
    let (a, b) = (ColourSource::Constant([0.5; 3]), ColourSource::Constant([1.0; 3]));
    let id = set.push(Texture::Mix(Mixture { a, b, weight: NumberSource::Texture(3) }));
    assert!(set.maximum(id).iter().all(|x| (x - (0.5 + 0.5 * most)).abs() < 1e-6), "{:?}", set.maximum(id));
    assert!(points().all(|at| colour(&set, id, &at)[0] <= set.maximum(id)[0] + 1e-6));
    // The weight and the colours do not depend on each other.
    let weight = luminance(set.mean(3));
    assert!((set.mean(id)[0] - (0.5 + 0.5 * weight)).abs() < 1e-6);
}

/// Stops at 0.25, twice at 0.5, and at 0.75.
fn stops() -> Vec<(f32, [f32; 3])> {
    vec![(0.25, [1.0, 0.0, 0.0]), (0.5, [0.0, 1.0, 0.0]), (0.5, [0.0, 0.0, 1.0]), (0.75, [4.0, 4.0, 4.0])]
}

#[test]
fn ramps_interpolate_between_their_stops() {
    let mut set = textures();
    let expected = [
        (0.0, [1.0, 0.0, 0.0]),
        (0.25, [1.0, 0.0, 0.0]),
        (0.375, [0.5, 0.5, 0.0]),
        (0.5, [0.0, 0.0, 1.0]),
        (0.625, [2.0, 2.0, 2.5]),
        (0.75, [4.0, 4.0, 4.0]),
        (1.0, [4.0, 4.0, 4.0]),
    ];
    for (place, expected) in expected {
        let id = set.push(Texture::Ramp(Gradient { input: NumberSource::Constant(place), stops: stops() }));
        assert_eq!((colour(&set, id, &at(0.3, 0.4)), set.mean(id)), (expected, expected), "{place}");
    }
    let one = set.push(Texture::Ramp(Gradient { input: NumberSource::Texture(0), stops: vec![(0.5, GREEN)] }));
    assert!(points().all(|at| colour(&set, one, &at) == GREEN));
}

#[test]
fn ramps_of_textures_are_at_their_luminance() {
    let mut set = textures();
    let grey = vec![(0.0, [0.0, 1.0, 0.5]), (1.0, [1.0, 0.0, 0.5])];
    let id = set.push(Texture::Ramp(Gradient { input: NumberSource::Texture(0), stops: grey }));
    for at in points() {
        let place = luminance(colour(&set, 0, &at));
        let found = colour(&set, id, &at);
        assert!((0..3).all(|i| (found[i] - [place, 1.0 - place, 0.5][i]).abs() < 1e-6), "{found:?} at {place}");
    }
    // Of 1024 points, whose luminance deviates by less than 0.1 from its mean.
    let place = luminance(set.mean(0));
    assert!((set.mean(id)[0] - place).abs() < 4.0 * 0.1 / 32.0 && (set.mean(id)[1] - (1.0 - place)).abs() < 4.0 * 0.1 / 32.0);
    assert_eq!(set.maximum(id), [1.0, 1.0, 0.5]);
    // A ramp whose colour no point of the grid meets is not black.
    let rare = vec![(0.999, [0.0; 3]), (1.0, [3.0; 3])];
    let id = set.push(Texture::Ramp(Gradient { input: NumberSource::Texture(0), stops: rare }));
    assert_eq!(set.mean(id), [1.5; 3]);
}

#[test]
fn vertex_colours_are_those_of_the_point() {
    let mut set = Textures::default();
    assert!(!set.use_vertices());
    let ids = Channel::ALL.map(|channel| set.push(Texture::VertexColor(VertexLookup(channel))));
    assert!(set.use_vertices());
    let vertex = [0.125, 0.25, 0.5, 0.75].map(F::<One>);
    let at = TextureCoordinates { vertex: Some(&vertex), ..at(0.0, 0.0) };
    let expected = [[0.125, 0.25, 0.5], [0.125; 3], [0.25; 3], [0.5; 3], [0.75; 3]];
    assert_eq!(ids.map(|id| colour(&set, id, &at)), expected);
    assert_eq!(ids.map(|id| colour(&set, id, &super::at(0.0, 0.0))), [[1.0; 3]; 5]);
}

#[test]
fn lookups_of_others_are_counted() {
    let mut set = textures();
    let [image, checker, constant] = [ColourSource::Texture(1), ColourSource::Texture(3), ColourSource::Constant(GREEN)];
    let one = set.push(Texture::Product(Factors { a: image, b: constant }));
    let two = set.push(Texture::Product(Factors { a: image, b: checker }));
    let mix = Mixture { a: ColourSource::Texture(two), b: ColourSource::Texture(one), weight: NumberSource::Texture(3) };
    let mix = set.push(Texture::Mix(mix));
    let squares = set.push(Texture::Checker(Squares { even: mix, odd: two, scale: 2.0 }));
    assert_eq!([0, 1, 3, one, two, mix, squares].map(|id| set.lookups(id)), [0, 0, 0, 1, 2, 6, 8]);
}

#[test]
fn every_width_gives_the_same_bits_of_combined_textures() {
    let mut set = textures();
    let [noise, image, checker] = [0, 1, 3].map(ColourSource::Texture);
    let product = set.push(Texture::Product(Factors { a: checker, b: image }));
    let weight = NumberSource::Texture(0);
    let mix = set.push(Texture::Mix(Mixture { a: ColourSource::Texture(product), b: noise, weight }));
    set.push(Texture::Ramp(Gradient { input: NumberSource::Texture(3), stops: stops() }));
    set.push(Texture::Checker(Squares { even: mix, odd: product, scale: 3.0 }));
    assert_eq!(set.len(), 8);
    for round in 0..100u32 {
        let coordinates = [1u32, 2, 3].map(|axis| {
            std::array::from_fn(|lane| crate::sampling::hash::hash_one(64 * round + 4 * lane as u32 + axis) as f32 / 4.0e9)
        });
        let one = |lane: usize| lanes_of(One, &set, &coordinates.map(|c| [c[lane]; 16]), U((lane % 8) as u32))[0];
        for level in SimdLevel::available() {
            let found = noisefall_base::math::in_lanes!(level, l => lanes_of(l, &set, &coordinates, l.iota() & 7));
            let expected: Vec<_> = (0..found.len()).map(one).collect();
            assert_eq!(found, expected, "{level:?}");
        }
    }
}
