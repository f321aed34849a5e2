//! Values of Mitsuba 3.9.1: `bsdf.eval` for directions by cosine and azimuth. Its masking of Beckmann facets is a rational
//! approximation within 0.35 % for each direction, and its transmittance of coats is interpolated from 64 cosines.
use super::super::{
    Bsdf, Conductor, Dielectric,
    Distribution::{self, Beckmann, Ggx},
    Local, Materials, Reflectance, RoughPlastic, Roughness, Shade,
    conductor::BeckmannConductor,
    dielectric::TintedDielectric,
};
use crate::sampling::Directions;
use noisefall_base::{
    declare::Textured,
    math::{F, M, One, U, V},
};

/// Cosine and azimuth of a direction.
pub(super) type Angles = (f32, f32);

pub(super) fn direction((cos, azimuth): Angles) -> V<One> {
    let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
    V::splat(One, [sin * azimuth.cos(), sin * azimuth.sin(), cos])
}

fn local(colour: [f32; 3], alpha: f32, front: bool) -> Local<One> {
    Local { material: U(0), colour: V::splat(One, colour), alpha: F(alpha), front: M(front) }
}

pub(super) fn assert_close(found: V<One>, expected: [f32; 3], tolerance: f32, what: &str) {
    for (found, expected) in found.lane(0).into_iter().zip(expected) {
        assert!((found - expected).abs() < tolerance * expected + 1e-6, "{what}: {found} {expected}");
    }
}

/// Facets, their width, the internal reflectance, the two directions and the value of a plastic.
type Case = (Distribution, f32, f64, [Angles; 2], [f32; 3]);

const PLASTIC: [Case; 9] = [
    (Ggx, 0.1, 0.5519, [(0.9, 0.2), (0.8, 2.5)], [0.191_13, 0.072_492, 0.001_636_8]),
    (Ggx, 0.1, 0.5519, [(0.5, 0.0), (0.6, 3.3)], [0.282_2, 0.125_11, 0.038_577]),
    (Ggx, 0.1, 0.5519, [(0.3, 1.0), (0.4, 4.0)], [0.257_59, 0.119_98, 0.046_769]),
    (Beckmann, 0.1, 0.5810, [(0.9, 0.2), (0.8, 2.5)], [0.198_42, 0.074_457, 9.774e-5]),
    (Beckmann, 0.1, 0.5810, [(0.5, 0.0), (0.6, 3.3)], [0.340_31, 0.152_96, 0.050_675]),
    (Ggx, 0.3, 0.4149, [(0.9, 0.2), (0.8, 2.5)], [0.152_2, 0.058_882, 0.003_612_8]),
    (Ggx, 0.3, 0.4149, [(0.5, 0.0), (0.6, 3.3)], [0.178_84, 0.077_722, 0.021_314]),
    (Beckmann, 0.3, 0.5300, [(0.9, 0.2), (0.8, 2.5)], [0.196_92, 0.076_514, 0.005_337_2]),
    (Beckmann, 0.3, 0.5300, [(0.3, 1.0), (0.4, 4.0)], [0.394_54, 0.188_6, 0.081_301]),
];

#[test]
fn rough_plastics_are_those_of_mitsuba() {
    for (distribution, alpha, internal_reflectance, [wo, wi], expected) in PLASTIC {
        let plastic = RoughPlastic {
            albedo: [0.8, 0.3, 0.0].into(),
            roughness: Roughness::alpha(alpha),
            distribution,
            specular_reflectance: [1.0, 0.5, 0.25],
            internal_reflectance,
            ..RoughPlastic::default()
        };
        let materials = Materials::new(&[plastic.into()]);
        let bsdf = RoughPlastic::at(One, &materials, Directions::Bsdf, &local([0.8, 0.3, 0.0], alpha, true));
        assert_close(
            bsdf.eval(direction(wo), direction(wi)).0,
            expected,
            8e-3,
            &format!("{distribution:?} {alpha} {wo:?} {wi:?}"),
        );
    }
}

const DIELECTRIC: [(Distribution, f32, [Angles; 2], [f32; 3]); 10] = [
    (Beckmann, 0.1, [(0.9, 0.2), (0.8, 3.5)], [0.118_82, 0.059_408, 0.029_704]),
    (Beckmann, 0.1, [(0.8, 0.3), (-0.9, 3.6)], [0.757_02, 1.514, 1.135_5]),
    (Beckmann, 0.1, [(0.4, 0.0), (-0.75, 3.2)], [5.189_9, 10.38, 7.784_8]),
    (Beckmann, 0.1, [(-0.7, 0.3), (0.3, 3.4)], [1.863, 3.726, 2.794_5]),
    (Beckmann, 0.3, [(0.5, 0.0), (0.6, 3.3)], [0.110_96, 0.055_482, 0.027_741]),
    (Beckmann, 0.3, [(0.8, 0.3), (-0.9, 3.6)], [3.534_7, 7.069_4, 5.302]),
    (Beckmann, 0.3, [(-0.7, 0.3), (0.3, 3.4)], [2.360_6, 4.721_3, 3.541]),
    (Ggx, 0.3, [(0.9, 0.2), (0.8, 3.5)], [0.032_428, 0.016_214, 0.008_107]),
    (Ggx, 0.3, [(0.8, 0.3), (-0.9, 3.6)], [2.573_9, 5.147_8, 3.860_9]),
    (Ggx, 0.3, [(-0.7, 0.3), (0.3, 3.4)], [1.571_4, 3.142_8, 2.357_1]),
];

#[test]
fn tinted_dielectrics_are_those_of_mitsuba() {
    for (distribution, alpha, [wo, wi], expected) in DIELECTRIC {
        let glass = Dielectric {
            distribution,
            specular_reflectance: [1.0, 0.5, 0.25].into(),
            specular_transmittance: [0.5, 1.0, 0.75].into(),
            ..Dielectric::new(1.5, alpha, false)
        };
        let materials = Materials::new(&[glass.into()]);
        let front = wo.0 > 0.0;
        let bsdf = TintedDielectric::at(One, &materials, Directions::Bsdf, &local([1.0, 0.5, 0.25], alpha, front));
        let bsdf = TintedDielectric::with_transmittance(bsdf, V::splat(One, [0.5, 1.0, 0.75]));
        // The viewer is above in our frame.
        let [wo, wi] = [wo, wi].map(|(cos, azimuth)| direction((if front { cos } else { -cos }, azimuth)));
        assert_close(bsdf.eval(wo, wi).0, expected, 8e-3, &format!("{distribution:?} {alpha} {:?} {:?}", wo.lane(0), wi.lane(0)));
    }
}

/// The widths along u and along v.
const CONDUCTOR: [([f64; 2], [Angles; 2], f32); 6] = [
    ([0.1, 0.1], [(0.9, 0.2), (0.8, 2.5)], 0.009_487_8),
    ([0.1, 0.1], [(0.5, 0.0), (0.6, 3.3)], 2.742_4),
    ([0.3, 0.3], [(0.9, 0.2), (0.8, 2.5)], 0.518_1),
    ([0.3, 0.3], [(0.3, 1.0), (0.4, 4.0)], 2.031_2),
    ([0.3, 0.1], [(0.5, 0.0), (0.6, 3.3)], 1.397_9),
    ([0.3, 0.1], [(0.7, 0.5), (0.75, 3.4)], 0.932_92),
];

#[test]
fn beckmann_metals_are_those_of_mitsuba() {
    for ([u, v], [wo, wi], expected) in CONDUCTOR {
        let alpha = (0.5 * (u * u + v * v)).sqrt() as f32;
        let white = Reflectance::Constant(Textured::grey(1.0));
        let metal = Conductor { distribution: Beckmann, anisotropy: 1.0 - v / u, ..Conductor::new(white, alpha, false) };
        let materials = Materials::new(&[metal.into()]);
        let bsdf = BeckmannConductor::at(One, &materials, Directions::Bsdf, &local([1.0; 3], alpha, true));
        assert_close(bsdf.eval(direction(wo), direction(wi)).0, [expected; 3], 8e-3, &format!("{u} {v} {wo:?} {wi:?}"));
    }
}
