//! Light samples against their pdfs.
use glam::DVec3;

use super::{
    Emission, Environment, LightCoordinates, Lights, Lobe, PunctualLight, ReferencePoint, Side,
    environment::constant::ConstantRadiance,
};
use crate::chi_squared::chi_squared_with;
use crate::{
    geometry::{MISS, Motion, Nearest, PrimitiveRef, Shape, Shapes},
    sampling::hash::hash_one,
};
use noisefall_base::math::{F, M, One, U, V};

/// Two lights, one of them partly below the horizon, a shell that shines inwards, one that shines away, and a sky.
fn lights() -> (Lights, Shapes, Vec<Shapes>) {
    let spheres = [
        (DVec3::new(1.5, 0.5, 1.0), 0.6),
        (DVec3::new(-0.4, 0.2, 0.3), 0.4),
        (DVec3::new(0.0, 0.5, 0.0), 20.0),
        (DVec3::new(0.0, 2.0, 0.5), 0.5),
    ]
    .map(|(center, radius)| Shape::sphere(center, radius));
    let emission =
        |light: f32, side| Emission { radiance: [light; 3], mean: [light; 3], texture: None, side, translucent: false };
    let emissions = [emission(8.0, Side::Front), emission(3.0, Side::Both), emission(0.2, Side::Back), emission(9.0, Side::Back)];
    let shapes_of = shapes;
    let shapes = shapes_of(&spheres);
    let emitters: Vec<_> =
        spheres.iter().cloned().zip(emissions).map(|(shape, emission)| (shape, STILL.clone(), emission)).collect();
    let lights =
        Lights::new(&shapes, &emitters, &[], Some(Environment::Constant(ConstantRadiance([0.5, 0.4, 0.6]))), DVec3::ZERO);
    let alone = spheres.iter().map(|sphere| shapes_of(std::slice::from_ref(sphere))).collect();
    (lights, shapes, alone)
}

fn vector(x: f64, y: f64, z: f64) -> V<One> {
    V { x: F(x as f32), y: F(y as f32), z: F(z as f32) }
}

fn place(primitive: U<One>) -> PrimitiveRef<One> {
    PrimitiveRef::of(One, primitive)
}

fn shapes(of: &[Shape]) -> Shapes {
    Shapes::new(of.iter().map(|shape| (shape, &STILL)), DVec3::ZERO)
}

static STILL: Motion = Motion(Vec::new());

fn random(i: u32) -> F<One> {
    F(((hash_one(i) >> 9) as f32 + 0.5) / (1 << 23) as f32)
}

fn coordinates(i: u32) -> LightCoordinates<One> {
    let n = 5 * i;
    LightCoordinates {
        choice: random(n),
        cell: (random(n + 1), random(n + 2)),
        place: (random(n + 3), random(n + 4)),
        sky: (random(n + 3), random(n + 4)),
    }
}

#[test]
fn directions_to_lights_are_distributed_as_their_pdf() {
    const ACROSS: usize = 24;
    const AROUND: usize = 48;
    const SUB: usize = 24;
    const SAMPLES: u32 = 400_000;
    let (lights, shapes, alone) = lights();
    let glossy = |alpha| Some(Lobe { wo: vector(0.6, 0.0, 0.8), alpha: F(alpha) });
    for (transmits, lobe) in [(false, None), (true, None), (false, glossy(0.1)), (false, glossy(0.6))] {
        let at = ReferencePoint { p: vector(0.1, -0.2, 0.1), n: vector(0.0, 0.6, 0.8), transmits: M(transmits), lobe };
        let mut counts = vec![0.0; ACROSS * AROUND];
        let mut drawn = 0.0;
        for i in 0..SAMPLES {
            let sample = lights.sample(One, &shapes, &at, F(0.0), &coordinates(i));
            if sample.pdf.0 == 0.0 {
                continue;
            }
            let pdf = lights.pdf(One, &shapes, &at, sample.wi, &place(sample.target));
            assert!((pdf.0 / sample.pdf.0 - 1.0).abs() < 1e-3, "{} {}", pdf.0, sample.pdf.0);
            let [x, y, z] = sample.wi.lane(0).map(f64::from);
            let turn = (y.atan2(x) / std::f64::consts::TAU).rem_euclid(1.0);
            let across = (((z + 1.0) / 2.0 * ACROSS as f64) as usize).min(ACROSS - 1);
            counts[across * AROUND + ((turn * AROUND as f64) as usize).min(AROUND - 1)] += 1.0;
            drawn += 1.0;
        }
        // The density over all lights that lie in a direction, hidden or not.
        let density = |d: V<One>| {
            let lit = |(i, shape): (usize, &Shapes)| {
                let seen = shape.closest(One, M(true), at.p, d, F(0.0)).primitive.0 != MISS;
                if seen { f64::from(lights.pdf(One, &shapes, &at, d, &place(U(i as u32))).0) } else { 0.0 }
            };
            alone.iter().enumerate().map(lit).sum::<f64>() + f64::from(lights.pdf(One, &shapes, &at, d, &place(U(MISS))).0)
        };
        let cell = 2.0 / ACROSS as f64 * std::f64::consts::TAU / AROUND as f64 / (SUB * SUB) as f64;
        let mut all = Vec::new();
        for bin in 0..counts.len() {
            let mut expected = 0.0;
            for sub in 0..SUB * SUB {
                let z = -1.0 + 2.0 * ((bin / AROUND) as f64 + ((sub / SUB) as f64 + 0.5) / SUB as f64) / ACROSS as f64;
                let turn = ((bin % AROUND) as f64 + ((sub % SUB) as f64 + 0.5) / SUB as f64) / AROUND as f64;
                let (sin, cos) = (turn * std::f64::consts::TAU).sin_cos();
                let r = (1.0 - z * z).sqrt();
                expected += density(vector(r * cos, r * sin, z)) * cell;
            }
            all.push(expected);
        }
        let whole: f64 = all.iter().sum();
        // Lights that face away are chosen but have no directions: the pdf integrates to the probability that a sample exists.
        let exists = drawn / f64::from(SAMPLES);
        assert!((whole - exists).abs() < 4.0 * (exists * (1.0 - exists) / f64::from(SAMPLES)).sqrt() + 1e-3, "{whole} {exists}");
        all.iter_mut().for_each(|expected| *expected *= f64::from(SAMPLES));
        // Edges of cones run through bins: the quadrature knows them to a part in its points along a side.
        let p = chi_squared_with(&counts, &all, 0.01);
        assert!(p > 1e-4, "transmits: {transmits}, p = {p}");
    }
}

#[test]
fn the_luminance_of_an_environment_is_that_of_its_colour() {
    let found = Environment::Constant(ConstantRadiance([0.5, 0.25, 0.125])).luminance();
    assert!((found - (0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722 * 0.125)).abs() < 1e-6, "{found}");
}

/// A ball, a point light, a directional light and a light below the horizon.
fn with_punctual() -> (Lights, Shapes) {
    let ball = Shape::sphere(DVec3::new(0.0, 3.0, 1.0), 0.5);
    let light = Emission { radiance: [4.0; 3], mean: [4.0; 3], texture: None, side: Side::Front, translucent: false };
    let shapes = shapes(std::slice::from_ref(&ball));
    let punctual_lights = [
        PunctualLight::point(DVec3::new(1.0, 2.0, 0.0), [3.0; 3]),
        PunctualLight::directional(DVec3::new(0.6, 0.8, 0.0), [0.7; 3]),
        PunctualLight::point(DVec3::new(0.0, -1.0, 0.0), [100.0; 3]),
    ];
    (Lights::new(&shapes, &[(ball, STILL.clone(), light)], &punctual_lights, None, DVec3::ZERO), shapes)
}

fn on_floor() -> ReferencePoint<One> {
    ReferencePoint { p: vector(0.0, 0.0, 0.0), n: vector(0.0, 1.0, 0.0), transmits: M(false), lobe: None }
}

/// The irradiance of a ball is π L sin²θ times the cosine of its middle; of a point light, I cos/d²; of a directional one, E cos.
#[test]
fn samples_of_surfaces_and_lights_add_up_to_the_irradiance_of_all() {
    const SAMPLES: u32 = 100_000;
    let (lights, shapes) = with_punctual();
    let ball = std::f64::consts::PI * 4.0 * (0.25 / 10.0) * (3.0 / 10f64.sqrt());
    let punctual_lights = 3.0 / 5.0 * (2.0 / 5f64.sqrt()) + 0.7 * 0.8;
    let at = on_floor();
    let mean = |sample: &dyn Fn(u32) -> super::LightSample<One>| {
        let value = |i: u32| {
            let sample = sample(i);
            let cos = sample.wi.dot(at.n).0.max(0.0);
            if sample.pdf.0 > 0.0 { f64::from(sample.radiance.x.0 * cos / sample.pdf.0) } else { 0.0 }
        };
        let sums = (0..SAMPLES).map(value).fold([0.0; 2], |[sum, squares], x| [sum + x, squares + x * x]);
        let mean = sums[0] / f64::from(SAMPLES);
        (mean, ((sums[1] / f64::from(SAMPLES) - mean * mean).max(0.0) / f64::from(SAMPLES)).sqrt())
    };
    let (all, error) = mean(&|i| lights.sample(One, &shapes, &at, F(0.0), &coordinates(i)));
    assert!((all - ball - punctual_lights).abs() < 4.0 * error + 1e-5, "{all} ± {error} for {}", ball + punctual_lights);
    let (alone, error) = mean(&|i| lights.sample_punctual(One, at, coordinates(i)));
    assert!((alone - punctual_lights).abs() < 4.0 * error + 1e-5, "{alone} ± {error} for {punctual_lights}");
}

#[test]
fn the_pdf_of_a_surface_next_to_lights_has_its_part_of_the_choice() {
    let (lights, shapes) = with_punctual();
    let at = on_floor();
    let (mut surfaces, mut punctual_lights) = (0, 0);
    for i in 0..2000 {
        let sample = lights.sample(One, &shapes, &at, F(0.0), &coordinates(i));
        match lights.punctual_at(sample.target.0) {
            None => {
                let pdf = lights.pdf(One, &shapes, &at, sample.wi, &place(sample.target));
                assert!(
                    (pdf.0 / sample.pdf.0 - 1.0).abs() < 1e-3 && !lights.are_punctual(sample.target).0,
                    "{} {}",
                    pdf.0,
                    sample.pdf.0
                );
                surfaces += 1;
            }
            Some(punctual_light) => {
                assert!(
                    punctual_light < 2 && lights.are_punctual(sample.target).0 && sample.pdf.0 <= 1.0,
                    "the third light is below the horizon: {punctual_light}"
                );
                punctual_lights += 1;
            }
        }
    }
    assert!(surfaces > 100 && punctual_lights > 100, "{surfaces} {punctual_lights}");
}

#[test]
fn a_light_arrives_unless_something_is_nearer() {
    let (lights, _) = with_punctual();
    let arrives = |target: u32, t: f32, primitive: u32| {
        let nearest = Nearest { t: F(t), primitive: U(primitive), element: U(0) };
        let (arrives, end) = lights.arrives(One, U(target), vector(0.0, 0.0, 0.0), nearest);
        (arrives.0, end.t.0)
    };
    // Light 0 is the ball; primitive 1 is something dark, whose number is that of a light.
    let distance = 5f32.sqrt();
    assert_eq!(arrives(1, 2.0, 1), (false, 2.0));
    assert_eq!(arrives(1, 3.0, 1), (true, distance));
    assert_eq!(arrives(1, 3.0, 0), (true, distance));
    assert_eq!(arrives(1, f32::INFINITY, MISS), (true, distance));
    assert_eq!(arrives(2, f32::INFINITY, MISS), (true, f32::INFINITY));
    assert_eq!(arrives(2, 1e30, 2), (false, 1e30));
    assert_eq!([arrives(0, 2.0, 0).0, arrives(0, 2.0, 1).0], [true, false]);
}

#[test]
fn an_even_sky_is_sampled_except_where_a_narrow_lobe_reflects_it() {
    let (several, shapes, _) = lights();
    let sky = || Some(Environment::Constant(ConstantRadiance([0.5, 0.4, 0.6])));
    let alone = Lights::new(&shapes, &[], &[], sky(), DVec3::ZERO);
    let cases = [(0.0, true), (0.1, false), (0.6, true)];
    for (lights, (alpha, sampled)) in [&several, &alone].into_iter().flat_map(|lights| cases.map(|case| (lights, case))) {
        let lobe = Some(Lobe { wo: vector(0.6, 0.0, 0.8), alpha: F(alpha) });
        let at = ReferencePoint { p: vector(0.1, -0.2, 0.1), n: vector(0.0, 0.6, 0.8), transmits: M(false), lobe };
        let samples = (0..1000).map(|i| lights.sample(One, &shapes, &at, F(0.0), &coordinates(i)));
        assert_eq!(samples.filter(|sample| sample.target.0 == MISS && sample.pdf.0 > 0.0).count() > 0, sampled, "{alpha}");
        assert_eq!(lights.pdf(One, &shapes, &at, vector(0.0, 0.0, 1.0), &place(U(MISS))).0 > 0.0, sampled, "{alpha}");
    }
}
