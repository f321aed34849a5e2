//! Disney's BSDF: values of Mitsuba, samples against integrals, and lobes.
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{
    super::{
        Bsdf, Lobes, Local, Materials, Shade, Stage,
        disney::{Disney, DisneyBsdf, DisneyGlass},
    },
    lattice,
    mitsuba::{Angles, assert_close, direction},
    viewer,
};
use crate::sampling::Directions;
use noisefall_base::{
    declare::Textured,
    math::{F, M, One, U, V},
};

const COLOR: [f32; 3] = [0.8, 0.3, 0.1];

fn number(value: f64) -> Textured<f64> {
    Textured::Constant(value)
}

fn usual() -> Disney {
    Disney { base_color: COLOR.map(f64::from).into(), ..Disney::default() }
}

/// The numbers that the surface stage looks up.
fn local(material: &Disney, front: bool) -> Local<One> {
    let Textured::Constant(root) = material.roughness else { unreachable!("no textures here") };
    Local { material: U(0), colour: V::splat(One, COLOR), alpha: F((root * root) as f32), front: M(front) }
}

fn clear(materials: &Materials, material: &Disney, front: bool) -> DisneyBsdf<One, true> {
    DisneyGlass::at(One, materials, Directions::Bsdf, &local(material, front))
}

fn opaque(materials: &Materials, material: &Disney) -> DisneyBsdf<One, false> {
    Disney::at(One, materials, Directions::Bsdf, &local(material, true))
}

/// A material, the two directions, and f |cos θ_i| of Mitsuba 3.9.1.
type Case = (Disney, [Angles; 2], [f32; 3]);

fn opaque_cases() -> Vec<Case> {
    let one = || number(1.0);
    vec![
        (usual(), [(0.9, 0.2), (0.8, 2.5)], [0.218_46, 0.091_124, 0.040_19]),
        (Disney { roughness: number(0.9), ..usual() }, [(0.3, 1.0), (0.4, 1.3)], [0.138_12, 0.053_419, 0.019_54]),
        (
            Disney { roughness: number(0.7), flatness: number(0.8), ..usual() },
            [(0.5, 0.0), (0.3, 2.0)],
            [0.105_72, 0.041_393, 0.015_661],
        ),
        (
            Disney { roughness: number(0.3), flatness: one(), ..usual() },
            [(0.2, 0.0), (0.15, 3.0)],
            [0.115_84, 0.074_25, 0.057_614],
        ),
        (Disney { sheen: number(0.7), ..usual() }, [(0.2, 0.0), (0.3, 3.0)], [0.360_34, 0.322_35, 0.307_15]),
        (
            Disney { sheen: number(0.7), sheen_tint: number(0.6), ..usual() },
            [(0.2, 0.0), (0.3, 3.0)],
            [0.389_56, 0.315_77, 0.286_25],
        ),
        (Disney { metallic: one(), roughness: number(0.4), ..usual() }, [(0.5, 0.0), (0.6, 3.3)], [1.736_7, 0.674_88, 0.250_13]),
        (
            Disney { metallic: number(0.6), roughness: number(0.4), anisotropic: number(0.7), ..usual() },
            [(0.5, 0.5), (0.6, 3.9)],
            [0.428_46, 0.178_1, 0.077_956],
        ),
        (
            Disney { metallic: number(0.6), roughness: number(0.7), anisotropic: one(), ..usual() },
            [(0.7, 1.5), (0.4, 4.4)],
            [0.100_51, 0.040_44, 0.016_413],
        ),
        (
            Disney { spec_tint: number(0.8), ior: 1.8, roughness: number(0.3), ..usual() },
            [(0.3, 1.0), (0.4, 4.0)],
            [0.347_14, 0.213_43, 0.159_95],
        ),
        (
            Disney { spec_tint: number(0.5), ior: 0.8, metallic: number(0.3), clearcoat: number(0.5), ..usual() },
            [(0.5, 1.0), (0.6, 4.3)],
            [1.764_7, 1.698_4, 1.671_9],
        ),
        (
            Disney { clearcoat: one(), roughness: number(0.6), ..usual() },
            [(0.5, 1.0), (0.52, 4.1)],
            [0.267_35, 0.185_46, 0.152_71],
        ),
        (
            Disney { clearcoat: number(0.7), clearcoat_gloss: number(0.8), metallic: number(0.2), ..usual() },
            [(0.3, 1.0), (0.31, 4.16)],
            [1.375_6, 1.071_7, 0.950_14],
        ),
        (
            Disney { metallic: number(0.5), ior: 1.0, clearcoat: number(0.6), ..usual() },
            [(0.5, 1.0), (0.52, 4.1)],
            [0.094_302, 0.053_483, 0.037_155],
        ),
    ]
}

/// The first direction is that of the viewer; below the surface it is inside.
fn clear_cases() -> Vec<Case> {
    let glass = |spec_trans: f64| Disney { spec_trans: number(spec_trans), roughness: number(0.4), ..usual() };
    vec![
        (glass(0.7), [(0.6, 0.0), (0.5, 3.0)], [0.189_96, 0.166_34, 0.156_89]),
        (
            Disney { anisotropic: number(0.4), metallic: number(0.2), ..glass(0.7) },
            [(0.8, 0.3), (-0.9, 3.6)],
            [1.567_9, 0.960_11, 0.554_32],
        ),
        (
            Disney { metallic: number(0.2), sheen: number(0.5), clearcoat: number(0.5), spec_tint: number(0.5), ..glass(0.7) },
            [(-0.6, 0.0), (-0.5, 3.0)],
            [1.15, 1.15, 1.15],
        ),
        (Disney { roughness: number(0.5), ..glass(1.0) }, [(-0.8, 0.3), (0.5, 3.4)], [8.779_1, 5.376_1, 3.103_9]),
        (
            Disney {
                metallic: number(0.2),
                roughness: number(0.45),
                anisotropic: number(0.3),
                spec_tint: number(0.4),
                flatness: number(0.5),
                sheen: number(0.6),
                sheen_tint: number(0.7),
                clearcoat: number(0.8),
                clearcoat_gloss: number(0.3),
                ..glass(0.3)
            },
            [(0.4, 0.7), (0.5, 3.9)],
            [1.063_1, 0.601_42, 0.416_73],
        ),
    ]
}

/// Mitsuba's numbers have five digits and its luminance has weights of other roundings.
const TOLERANCE: f32 = 3e-4;

#[test]
fn values_are_those_of_mitsuba() {
    for (material, [wo, wi], expected) in opaque_cases() {
        let materials = Materials::new(&[material.clone().into()]);
        assert_eq!(materials.stage(0), Stage::Disney);
        let found = opaque(&materials, &material).eval(direction(wo), direction(wi)).0;
        assert_close(found, expected, TOLERANCE, &format!("{material:?} {wo:?} {wi:?}"));
    }
    for (material, [wo, wi], expected) in clear_cases() {
        let materials = Materials::new(&[material.clone().into()]);
        assert_eq!(materials.stage(0), Stage::DisneyGlass);
        let front = wo.0 > 0.0;
        // The viewer is above in our frame.
        let [wo, wi] = [wo, wi].map(|(cos, azimuth)| direction((if front { cos } else { -cos }, azimuth)));
        let found = clear(&materials, &material, front).eval(wo, wi).0;
        assert_close(found, expected, TOLERANCE, &format!("{material:?} {:?} {:?}", wo.lane(0), wi.lane(0)));
    }
}

/// f |cos θ| and the pdf over the sphere by the midpoint rule.
fn integrals(bsdf: &impl Bsdf<One>, wo: V<One>) -> [f64; 4] {
    const STEPS: u32 = 300;
    let mut sums = [0.0; 4];
    for i in 0..STEPS * STEPS {
        let z = ((i / STEPS) as f32 + 0.5) / STEPS as f32 * 2.0 - 1.0;
        let (y, x) = (((i % STEPS) as f32 + 0.5) / STEPS as f32 * std::f32::consts::TAU).sin_cos();
        let across = ((1.0 - z) * (1.0 + z)).sqrt();
        let (f, pdf) = bsdf.eval(wo, V::splat(One, [across * x, across * y, z]));
        add(&mut sums, f, pdf.0);
    }
    sums.map(|sum| sum * 4.0 * std::f64::consts::PI / f64::from(STEPS * STEPS))
}

/// The mean weight of samples, and the share of those that exist.
fn means(bsdf: &impl Bsdf<One>, wo: V<One>) -> [f64; 4] {
    const POINTS: u32 = 17_711;
    let mut sums = [0.0; 4];
    for (i, u) in lattice(POINTS, 10_946).enumerate() {
        // An irrational step keeps the lobe independent of the direction.
        let lobe = ((i as f64 + 0.5) * std::f64::consts::SQRT_2).fract() as f32;
        let sample = bsdf.sample(wo, u, F(lobe));
        assert!(sample.weight.lane(0).into_iter().all(|weight| weight.is_finite() && (0.0..4.5).contains(&weight)));
        let exists = sample.weight.max_component().0 > 0.0;
        add(&mut sums, sample.weight, if exists { 1.0 } else { 0.0 });
    }
    sums.map(|sum| sum / f64::from(POINTS))
}

fn add(sums: &mut [f64; 4], color: V<One>, more: f32) {
    let [r, g, b] = color.lane(0);
    for (sum, more) in sums.iter_mut().zip([r, g, b, more]) {
        *sum += f64::from(more);
    }
}

fn assert_sampled(bsdf: &impl Bsdf<One>, what: &str) {
    for cos in [0.95, 0.5, 0.2] {
        let wo = viewer(cos);
        for (mean, integral) in means(bsdf, wo).into_iter().zip(integrals(bsdf, wo)) {
            assert!((mean - integral).abs() < 5e-3 * integral, "{what} at {cos}: {mean} {integral}");
        }
    }
}

#[test]
fn means_of_samples_are_integrals() {
    let layers = Disney {
        metallic: number(0.3),
        roughness: number(0.7),
        flatness: number(0.5),
        sheen: number(0.8),
        sheen_tint: number(0.5),
        clearcoat: number(1.0),
        spec_tint: number(0.6),
        ..usual()
    };
    let metal = Disney { metallic: number(1.0), anisotropic: number(0.8), ..usual() };
    for material in [usual(), metal, layers] {
        let materials = Materials::new(&[material.clone().into()]);
        assert_sampled(&opaque(&materials, &material), &format!("{material:?}"));
    }
    let mixed = Disney {
        roughness: number(0.6),
        spec_trans: number(0.6),
        metallic: number(0.2),
        anisotropic: number(0.4),
        clearcoat: number(0.5),
        sheen: number(0.5),
        ..usual()
    };
    let bubble = Disney { ior: 0.8, roughness: number(0.6), spec_trans: number(0.5), spec_tint: number(0.5), ..usual() };
    for material in [Disney { spec_trans: number(1.0), ..usual() }, mixed, bubble] {
        let materials = Materials::new(&[material.clone().into()]);
        for front in [true, false] {
            assert_sampled(&clear(&materials, &material, front), &format!("{material:?} {front}"));
        }
    }
}

#[test]
fn light_and_viewer_can_be_exchanged_across_the_surface() {
    let material = Disney { spec_trans: number(0.8), anisotropic: number(0.5), ..usual() };
    let materials = Materials::new(&[material.clone().into()]);
    let [outside, inside] = [true, false].map(|front| clear(&materials, &material, front));
    for [wo, wi] in [[(0.9, 0.3), (-0.8, 3.5)], [(0.5, 0.0), (-0.85, 3.0)], [(0.3, 2.0), (-0.7, 5.3)]] {
        let there = outside.eval(direction(wo), direction(wi)).0 * (1.5 * 1.5 / wi.0.abs());
        let turned = |(cos, azimuth): Angles| direction((-cos, azimuth));
        let back = inside.eval(turned(wi), turned(wo)).0 * (1.0 / wo.0);
        assert_close(there, back.lane(0), 1e-3, &format!("{wo:?} {wi:?}"));
    }
}

#[test]
fn a_lobe_is_called_as_the_direction_that_it_gives() {
    let mut rng = SmallRng::seed_from_u64(41);
    let material = Disney { spec_trans: number(0.7), clearcoat: number(0.5), ..usual() };
    let materials = Materials::new(&[material.clone().into()]);
    for front in [true, false] {
        let bsdf = clear(&materials, &material, front);
        for _ in 0..500 {
            let (wo, u, lobe) = (viewer(0.6), (F(rng.random()), F(rng.random())), F(rng.random()));
            let (sample, chosen) = (bsdf.sample(wo, u, lobe), bsdf.chosen(wo, u, lobe));
            assert!((0.0..=1.0).contains(&chosen.probability));
            if sample.weight.x.0 > 0.0 {
                assert_eq!(sample.wi.z.0 < 0.0, chosen.name == "microfacet refraction", "{chosen:?}");
            }
        }
    }
}
