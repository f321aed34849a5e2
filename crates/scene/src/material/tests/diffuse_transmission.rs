//! The sheet that reflects and transmits diffusely: energy, reciprocity, pdf and lanes.
use fearless_simd_macros::simd;
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{
    super::{Bsdf, DiffuseTransmission, Material, Materials, diffuse_transmission::DiffuseTransmissionBsdf},
    cases::COSINES,
    lattice, viewer,
};
use crate::sampling::Directions;
use noisefall_base::{
    declare::Textured,
    math::{F, Lanes, MAX_LANES, One, SimdLevel, V, in_lanes},
};

const REFLECTANCE: [f32; 3] = [0.3, 0.5, 0.0];
const TRANSMITTANCE: [f32; 3] = [0.7, 0.1, 0.4];

fn sheet<L: Lanes>(l: L, [reflectance, transmittance]: [[f32; 3]; 2], directions: Directions) -> DiffuseTransmissionBsdf<L> {
    DiffuseTransmissionBsdf { reflectance: V::splat(l, reflectance), transmittance: V::splat(l, transmittance), directions }
}

fn all() -> impl Iterator<Item = DiffuseTransmissionBsdf<One>> {
    let black = [0.0; 3];
    let colours = [[REFLECTANCE, TRANSMITTANCE], [REFLECTANCE, black], [black, TRANSMITTANCE], [black; 2]];
    Directions::ALL.into_iter().flat_map(move |directions| colours.map(|colours| sheet(One, colours, directions)))
}

#[test]
fn a_sheet_scatters_its_fractions_to_both_sides() {
    const POINTS: u32 = 10_946;
    for bsdf in all() {
        let mut sums = [[0.0f64; 3]; 2];
        for (i, u) in lattice(POINTS, 6765).enumerate() {
            // An irrational step keeps the lobe independent of the direction.
            let lobe = (i as f64 * 0.754_877_666_246_692_7).fract() as f32;
            let sample = bsdf.sample(viewer(0.6), u, F(lobe));
            let side = &mut sums[usize::from(sample.wi.z.0 < 0.0)];
            let weight = sample.weight.lane(0);
            (0..3).for_each(|channel| side[channel] += f64::from(weight[channel]) / f64::from(POINTS));
        }
        for (sum, colour) in sums.iter().zip([bsdf.reflectance.lane(0), bsdf.transmittance.lane(0)]) {
            for channel in 0..3 {
                assert!((sum[channel] - f64::from(colour[channel])).abs() < 5e-3, "{:?}: {sums:?}", bsdf.directions);
            }
        }
    }
}

#[test]
fn weights_are_eval_over_pdf_and_light_and_viewer_can_be_exchanged() {
    let mut random = SmallRng::seed_from_u64(21);
    for bsdf in all() {
        for cos in COSINES {
            let wo = viewer(cos);
            for _ in 0..200 {
                let sample = bsdf.sample(wo, (F(random.random()), F(random.random())), F(random.random()));
                let (f, pdf) = bsdf.eval(wo, sample.wi);
                assert!(!sample.delta.0 && (sample.pdf.0 - pdf.0).abs() <= 1e-5 * pdf.0, "{} {}", sample.pdf.0, pdf.0);
                // Seen from the other end of a transmitted ray, both directions are on the other side.
                let turn = if sample.wi.z.0 < 0.0 { -1.0 } else { 1.0 };
                let back = bsdf.eval(sample.wi * turn, wo * turn).0.lane(0);
                for ((weight, f), back) in sample.weight.lane(0).into_iter().zip(f.lane(0)).zip(back) {
                    assert!((weight * pdf.0 - f).abs() <= 1e-5 * f, "{weight} {} {f}", pdf.0);
                    let (there, back) = (f / sample.wi.z.0.abs(), back / wo.z.0);
                    assert!((there - back).abs() <= 1e-5 * there, "{there} {back}");
                }
            }
        }
    }
}

/// Integrates the pdf over the sphere by rings of equal solid angle.
#[test]
fn the_pdf_of_both_sides_adds_up_to_1() {
    const RINGS: u32 = 4000;
    for bsdf in all() {
        let pdf = |i: u32| {
            let z = (f64::from(i) + 0.5) / f64::from(RINGS) * 2.0 - 1.0;
            let wi = V { x: F((1.0 - z * z).sqrt() as f32), y: F(0.0), z: F(z as f32) };
            f64::from(bsdf.eval(viewer(0.5), wi).1.0)
        };
        let whole = (0..RINGS).map(pdf).sum::<f64>() * 4.0 * std::f64::consts::PI / f64::from(RINGS);
        assert!((whole - 1.0).abs() < 1e-3, "{:?}: {whole}", bsdf.directions);
    }
}

#[simd]
fn answers<L: Lanes>(l: L, columns: &[Vec<f32>; 3], out: &mut Vec<u32>) {
    let bsdf = sheet(l, [REFLECTANCE, TRANSMITTANCE], Directions::Bsdf);
    let wo = V::splat(l, [0.6, 0.0, 0.8]);
    for start in (0..columns[0].len()).step_by(L::N) {
        let [u, v, lobe] = [0, 1, 2].map(|column| l.load(&columns[column][start..]));
        let sample = bsdf.sample(wo, (u, v), lobe);
        let (f, pdf) = bsdf.eval(wo, sample.wi);
        for lane in 0..L::N {
            out.extend([sample.wi, sample.weight, f].map(|v| v.lane(lane).map(f32::to_bits)).as_flattened());
            out.push(pdf.to_array()[lane].to_bits());
        }
    }
}

#[test]
fn any_number_of_lanes_gives_the_same_bits() {
    let mut random = SmallRng::seed_from_u64(22);
    let columns = [(); 3].map(|()| (0..16 * MAX_LANES).map(|_| random.random()).collect::<Vec<f32>>());
    let all: Vec<Vec<u32>> = SimdLevel::available()
        .into_iter()
        .map(|level| {
            let mut out = Vec::new();
            in_lanes!(level, l => answers(l, &columns, &mut out));
            out
        })
        .collect();
    assert!(all.windows(2).all(|pair| pair[0] == pair[1]));
}

#[test]
fn a_sheet_may_scatter_all_that_it_receives() {
    let sheet = |reflectance: [f64; 3], transmittance: [f64; 3]| {
        let [reflectance, transmittance] = [reflectance, transmittance].map(Textured::Constant);
        Material::from(DiffuseTransmission { reflectance, transmittance })
    };
    assert_eq!(Materials::new(&[sheet([0.7, 0.1, 1.0], [0.3, 0.9, 0.0])]).len(), 1);
}
