//! Punctual lights at points, against formulas in double precision.
use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::{
    Picture as Cast, PunctualLight, PunctualLightKind, PunctualLights, Shine,
    directional::Directional,
    point::Point,
    projector::Projector,
    slide::Slide,
    spot::{Falloff, Spot},
};
use crate::{
    image::Picture,
    sampling::hash::hash_one,
    texture::{
        ImageTexture,
        image::{TexelFilter, Wrap},
    },
};
use noisefall_base::{
    declare::Resources,
    math::{F, Lanes, One, SimdLevel, U, V, in_lanes},
};

fn compiled(kind: &dyn Shine, map: &DAffine3) -> PunctualLight {
    kind.compile(map, &Resources::new("")).unwrap_or_else(|problem| panic!("{problem}"))
}

fn here(kind: impl Into<PunctualLightKind>) -> PunctualLights {
    PunctualLights::new(&[compiled(kind.into().kind(), &DAffine3::IDENTITY)])
}

/// Direction and irradiance at a point.
fn light(punctual_lights: &PunctualLights, p: DVec3) -> (DVec3, [f64; 3]) {
    let found = punctual_lights.sample(One, U(0), V::splat(One, p.as_vec3().to_array()));
    (glam::Vec3::from(found.wi.lane(0)).as_dvec3(), found.irradiance.lane(0).map(f64::from))
}

fn distance(punctual_lights: &PunctualLights, p: DVec3) -> f64 {
    f64::from(punctual_lights.distance(One, U(0), V::splat(One, p.as_vec3().to_array())).0)
}

fn random(i: u32) -> f64 {
    f64::from(hash_one(i)) / f64::from(u32::MAX)
}

fn any_point(i: u32) -> DVec3 {
    DVec3::new(random(3 * i), random(3 * i + 1), random(3 * i + 2)) * 8.0 - 4.0
}

#[test]
fn a_point_light_follows_the_inverse_square() {
    let position = DVec3::new(1.0, 2.0, -0.5);
    let punctual_lights = here(Point { position, intensity: [3.0, 2.0, 1.0] });
    for p in (0..200).map(any_point) {
        let (wi, irradiance) = light(&punctual_lights, p);
        let far = position.distance(p);
        assert!(wi.distance((position - p) / far) < 1e-5, "{p}");
        assert!((distance(&punctual_lights, p) / far - 1.0).abs() < 1e-5, "{p}");
        for (channel, intensity) in irradiance.iter().zip([3.0, 2.0, 1.0]) {
            assert!((channel * far * far / intensity - 1.0).abs() < 1e-5, "{p}: {irradiance:?}");
        }
    }
}

#[test]
fn a_directional_light_is_the_same_everywhere_and_infinitely_far_away() {
    let punctual_lights = here(Directional { direction: DVec3::new(2.0, -2.0, 1.0), irradiance: [5.0, 4.0, 3.0] });
    for p in (0..50).map(any_point) {
        let (wi, irradiance) = light(&punctual_lights, p);
        assert!(wi.distance(DVec3::new(-2.0, 2.0, -1.0) / 3.0) < 1e-6 && distance(&punctual_lights, p) == f64::INFINITY);
        assert_eq!(irradiance, [5.0, 4.0, 3.0]);
    }
}

/// The intensity of a spot at an angle, all in radians.
fn falloff(kind: Falloff, angle: f64, [inner, edge]: [f64; 2]) -> f64 {
    let by_cos = ((angle.cos() - edge.cos()) / (inner.cos() - edge.cos())).clamp(0.0, 1.0);
    match kind {
        Falloff::Smooth => by_cos * by_cos * (3.0 - 2.0 * by_cos),
        Falloff::Linear => ((edge - angle) / (edge - inner)).clamp(0.0, 1.0),
        Falloff::Square => by_cos * by_cos,
    }
}

#[test]
fn a_spot_falls_off_between_its_angles() {
    for (inner, edge) in [(20.0, 30.0), (0.0, 60.0), (80.0, 120.0), (1.0, 180.0)] {
        for kind in Falloff::ALL {
            let spot = Spot { position: DVec3::Y, target: DVec3::ZERO, intensity: [2.0; 3], angle: edge, inner, falloff: kind };
            let punctual_lights = here(spot);
            for step in 0..180 {
                let angle = (f64::from(step) + 0.5).to_radians();
                let (sin, cos) = angle.sin_cos();
                let (_, irradiance) = light(&punctual_lights, DVec3::Y + DVec3::new(0.6 * sin, -cos, 0.8 * sin) * 0.5);
                let exact = 2.0 * 4.0 * falloff(kind, angle, [inner, edge].map(f64::to_radians));
                assert!((irradiance[0] - exact).abs() < 1e-3, "{kind:?} {inner} {edge}, {step}°: {} {exact}", irradiance[0]);
            }
        }
    }
}

#[test]
fn a_spot_whose_inner_angle_is_its_edge_ends_sharply() {
    // An inner angle beyond the edge counts as the edge.
    for inner in [30.0, 90.0] {
        for falloff in Falloff::ALL {
            let spot = Spot { position: DVec3::Y, target: DVec3::ZERO, intensity: [1.0; 3], angle: 30.0, inner, falloff };
            let punctual_lights = here(spot);
            let at = |degrees: f64| light(&punctual_lights, DVec3::new(degrees.to_radians().tan(), 0.0, 0.0)).1[0] > 0.0;
            assert!([29.9, 10.0, 0.0].into_iter().all(at) && ![30.1, 45.0, 80.0].into_iter().any(at), "{falloff:?}");
        }
    }
}

#[test]
fn a_projector_without_an_image_casts_a_square_of_its_angle() {
    let position = DVec3::ZERO;
    let projector = Projector { position, target: DVec3::NEG_Z, fov: 60.0, scale: 3.0, ..Projector::default() };
    let [round, flat] = [false, true].map(|flat| here(Projector { flat, ..projector.clone() }));
    let half = 30f64.to_radians().tan();
    for i in 0..500 {
        let p = DVec3::new(2.0 * random(2 * i) - 1.0, 2.0 * random(2 * i + 1) - 1.0, -1.0);
        let inside = p.x.abs().max(p.y.abs());
        if (inside - half).abs() < 1e-4 {
            continue;
        }
        // On the screen z = −1, the irradiance times the cosine 1/|p| is 3 everywhere if the image is flat.
        for (punctual_lights, exact) in [(&round, 3.0 / p.length_squared()), (&flat, 3.0 * p.length())] {
            let exact = if inside < half { exact } else { 0.0 };
            assert!((light(punctual_lights, p).1[0] - exact).abs() < 1e-4, "{p}");
            assert_eq!(light(punctual_lights, -p).1, [0.0; 3], "behind it");
        }
    }
}

#[test]
fn the_cone_of_a_projector_is_that_of_a_linear_spot() {
    let [position, target, intensity] = [DVec3::Y, DVec3::new(0.2, 0.0, -0.1), DVec3::new(3.0, 1.5, 0.75)];
    let (angle, inner) = (20.0, 15.0);
    let falloff = Falloff::Linear;
    let spot = here(Spot { position, target, intensity: intensity.to_array(), angle, inner, falloff });
    let tint = [1.0, 0.5, 0.25];
    let fov = 2.0 * angle;
    let projector = here(Projector { position, target, fov, scale: 3.0, tint, angle, inner, ..Projector::default() });
    for i in 0..500 {
        let p = DVec3::new(random(2 * i) - 0.5, 0.0, random(2 * i + 1) - 0.5);
        let [found, expected] = [&projector, &spot].map(|punctual_lights| light(punctual_lights, p).1);
        assert!((0..3).all(|c| (found[c] - expected[c]).abs() < 2e-5), "{p}: {found:?} {expected:?}");
    }
}

/// Two texels: red to the left, green to the right.
fn red_and_green() -> Arc<ImageTexture> {
    let picture = Picture { width: 2, height: 1, radiance: vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] };
    Arc::new(ImageTexture::new((&picture).into()))
}

#[test]
fn the_image_of_a_projector_continues_as_its_wrap_says() {
    let folder = tempfile::tempdir().expect("a folder");
    let texels = [255, 0, 0, 0, 255, 0];
    ::image::save_buffer(folder.path().join("a.png"), &texels, 2, 1, ::image::ExtendedColorType::Rgb8).expect("it is written");
    let resources = Resources::new(folder.path());
    let red = |wrap, filter, x: f32| {
        let punctual_light = Projector {
            image: "a.png".to_owned(),
            wrap,
            filter,
            aspect: 1.0,
            fov: 90.0,
            up: DVec3::NEG_Z,
            flat: true,
            ..Projector::default()
        };
        let punctual_light =
            punctual_light.compile(&DAffine3::IDENTITY, &resources).unwrap_or_else(|problem| panic!("{problem}"));
        // A metre below the light, at a part of the width from the middle. The image is red on one side and green on the other.
        let p = V { x: F(x), y: F(1.0), z: F(0.0) };
        let light = PunctualLights::new(&[punctual_light]).sample(One, U(0), p).irradiance.lane(0);
        light[0] / (light[0] + light[1])
    };
    let edges = |wrap, filter| [-0.98, -0.75, 0.75, 0.98].map(|x| red(wrap, filter, x)).map(|red| (100.0 * red).round());
    let [held, repeated, nearest] = [
        edges(Wrap::Clamp, TexelFilter::Bilinear),
        edges(Wrap::Repeat, TexelFilter::Bilinear),
        edges(Wrap::Repeat, TexelFilter::Nearest),
    ];
    let sorted = |mut values: [f32; 4]| {
        values.sort_by(f32::total_cmp);
        values
    };
    assert_eq!(sorted(held), [0.0, 0.0, 100.0, 100.0]);
    assert_eq!(edges(Wrap::Mirror, TexelFilter::Bilinear), held);
    assert_eq!((sorted(nearest), nearest), (sorted(held), held));
    // At ±0.98, 0.01 of the image from its edge, 48 % come from the other side.
    assert_eq!(sorted(repeated), [25.0, 48.0, 52.0, 75.0]);
}

#[test]
fn the_image_of_a_projector_is_the_right_way_round_and_does_not_wrap() {
    let axes = [DVec3::X, DVec3::Y * 2.0, DVec3::NEG_Z];
    let cast = |image| PunctualLight::projector(DVec3::ZERO, [1.0; 3], Cast { axes, flat: false, image, cone: None });
    let punctual_lights = PunctualLights::new(&[cast(Some(Slide::Held(red_and_green()))), cast(None)]);
    // Seen from the projector, x is to the right. Beyond the middles of the texels there is only their colour, up to the edge.
    for (x, y, expected) in
        [(-0.7, 0.3, [1.0, 0.0]), (-0.999, 0.0, [1.0, 0.0]), (0.7, -0.3, [0.0, 1.0]), (0.999, 0.49, [0.0, 1.0])]
    {
        let p = DVec3::new(x, y, -1.0);
        let [r, g, b] = light(&punctual_lights, p).1.map(|x| x * p.length_squared());
        assert!((r - expected[0]).abs() < 1e-5 && (g - expected[1]).abs() < 1e-5 && b == 0.0, "{p}: {r} {g} {b}");
    }
    assert_eq!(light(&punctual_lights, DVec3::new(0.0, 0.51, -1.0)).1, [0.0; 3], "it is half as high as it is wide");
    let second = punctual_lights.sample(One, U(1), V::splat(One, [0.7, 0.3, -1.0])).irradiance.lane(0);
    assert!(second[0] > 0.0 && second[0] == second[2], "the second light is white: {second:?}");
}

#[test]
fn transforms_move_punctual() {
    let map = DAffine3::from_rotation_y(std::f64::consts::FRAC_PI_2) * DAffine3::from_translation(DVec3::X);
    let at = |kind: &dyn Shine| PunctualLights::new(&[compiled(kind, &map)]);
    // (0, 0, 2) goes to (1, 0, 2) and is turned to (2, 0, −1).
    let point = at(&Point { position: DVec3::Z * 2.0, intensity: [1.0; 3] });
    assert!(distance(&point, DVec3::new(2.0, 0.0, -1.0)) < 1e-6);
    let sun = at(&Directional { direction: DVec3::NEG_X, irradiance: [1.0; 3] });
    assert!(light(&sun, DVec3::ZERO).0.distance(DVec3::NEG_Z) < 1e-6);
    let projector = Projector { position: DVec3::ZERO, target: DVec3::NEG_Z, fov: 90.0, ..Projector::default() };
    let mirrored = PunctualLights::new(&[compiled(&projector, &DAffine3::from_scale(DVec3::new(-0.5, 1.0, 1.0)))]);
    assert!(
        light(&mirrored, DVec3::new(0.49, 0.9, -1.0)).1[0] > 0.0 && light(&mirrored, DVec3::new(0.51, 0.0, -1.0)).1[0] == 0.0
    );
}

#[test]
fn lights_without_a_direction_are_refused() {
    let refused = |kind: PunctualLightKind| kind.kind().compile(&DAffine3::IDENTITY, &Resources::new("")).is_err();
    assert!(refused(Directional { direction: DVec3::ZERO, ..Directional::default() }.into()));
    assert!(refused(Spot { position: DVec3::ONE, target: DVec3::ONE, ..Spot::default() }.into()));
    assert!(refused(Projector { position: DVec3::ONE, target: DVec3::ONE, ..Projector::default() }.into()));
    assert!(compiled(&Point { position: DVec3::X * 1e13, intensity: [1.0; 3] }, &DAffine3::IDENTITY).check().is_err());
    assert!(compiled(&Point { intensity: [0.0; 3], ..Point::default() }, &DAffine3::IDENTITY).is_black());
}

#[inline(always)]
fn bits_of<L: Lanes>(l: L, punctual_lights: &PunctualLights, numbers: &[f32], points: &[[f32; 16]; 3]) -> Vec<[u32; 7]> {
    let [x, y, z] = [0, 1, 2].map(|i| l.load(&points[i]));
    let (punctual_light, p) = (l.load(numbers).bits(), V { x, y, z });
    let found = punctual_lights.sample(l, punctual_light, p);
    let V { x, y, z } = found.wi;
    let V { x: r, y: g, z: b } = found.irradiance;
    let numbers = [x, y, z, r, g, b, punctual_lights.distance(l, punctual_light, p)].map(F::to_array);
    (0..L::N).map(|lane| numbers.map(|number| number[lane].to_bits())).collect()
}

#[test]
fn every_width_gives_the_same_bits() {
    let kinds: [PunctualLightKind; 4] =
        [Point::default().into(), Spot::default().into(), Directional::default().into(), Projector::default().into()];
    let mut all: Vec<PunctualLight> = kinds.iter().map(|kind| compiled(kind.kind(), &DAffine3::IDENTITY)).collect();
    let axes = [DVec3::X, DVec3::Z, DVec3::NEG_Y];
    let cast = Cast { axes, flat: false, image: Some(Slide::Held(red_and_green())), cone: Some([0.2, 0.7]) };
    all.push(PunctualLight::projector(DVec3::Y, [1.0; 3], cast));
    let punctual_lights = PunctualLights::new(&all);
    for round in 0..100 {
        let points: [[f32; 16]; 3] =
            std::array::from_fn(|axis| std::array::from_fn(|lane| any_point(16 * round + lane as u32)[axis] as f32));
        let numbers: [f32; 16] = std::array::from_fn(|lane| f32::from_bits((round + lane as u32) % 5));
        for level in SimdLevel::available() {
            let found = in_lanes!(level, l => bits_of(l, &punctual_lights, &numbers, &points));
            let one = |lane: usize| bits_of(One, &punctual_lights, &[numbers[lane]; 16], &points.map(|axis| [axis[lane]; 16]))[0];
            assert_eq!(found, (0..found.len()).map(one).collect::<Vec<_>>(), "{level:?}");
        }
    }
}
