//! The white furnace: total reflected and transmitted light.
use super::{
    super::{Bsdf, Local, Material, Materials, Mirror, Plastic, Shade},
    cases::{Any, COSINES, cases},
    lattice, viewer,
};
use crate::{
    material::{
        albedo::{Albedo, LOSS},
        microfacets,
    },
    sampling::Directions,
};
use noisefall_base::{
    declare::Textured,
    math::{F, M, One, U, V},
};

/// Directional albedo in red, by a lattice of samples of each lobe.
fn albedo(bsdf: &Any<'_>, cos: f32) -> f64 {
    const POINTS: u32 = 10_946;
    let mut whole = 0.0;
    let mut start = 0.0;
    for end in ends_of_lobes(bsdf, cos) {
        let lobe = F(0.5 * (start + end));
        let weights = lattice(POINTS, 6765).map(|u| f64::from(bsdf.sample(viewer(cos), u, lobe).weight.x.0));
        whole += f64::from(end - start) * weights.sum::<f64>() / f64::from(POINTS);
        start = end;
    }
    whole
}

/// The numbers at which the chosen lobe changes, and 1: found by bisection of octaves towards both ends.
fn ends_of_lobes(bsdf: &Any<'_>, cos: f32) -> Vec<f32> {
    let direction = |lobe: f32| bsdf.sample(viewer(cos), (F(0.3), F(0.6)), F(lobe)).wi.lane(0);
    let low = (1..=40).rev().map(|k| 0.5f32.powi(k));
    let high = (2..=23).map(|k| 1.0 - 0.5f32.powi(k));
    let octaves: Vec<f32> = low.chain(high).collect();
    let mut ends = Vec::new();
    for pair in octaves.windows(2) {
        let [mut a, mut b] = [pair[0], pair[1]];
        if direction(a) != direction(b) {
            for _ in 0..30 {
                let middle = 0.5 * (a + b);
                if direction(middle) == direction(pair[0]) { a = middle } else { b = middle }
            }
            ends.push(b);
        }
    }
    ends.push(1.0);
    ends
}

#[test]
fn no_light_is_made_and_lossless_materials_lose_none() {
    for case in &cases() {
        for cos in COSINES {
            let albedo = albedo(&case.bsdf(), cos);
            assert!(albedo < case.most, "{} at {cos}: {albedo}", case.name);
            assert!(!case.lossless || albedo > 0.9995, "{} at {cos}: {albedo}", case.name);
        }
    }
}

#[test]
fn a_mirror_is_exact() {
    for case in &cases() {
        if let Material::Mirror(Mirror { reflectance }) = &case.material {
            let Textured::Constant(reflectance) = reflectance else { unreachable!("no textures here") };
            for cos in COSINES {
                let sample = case.bsdf().sample(viewer(cos), (F(0.3), F(0.6)), F(0.5));
                assert_eq!(sample.weight.lane(0).map(f64::from), *reflectance);
                assert!(sample.delta.0);
            }
        }
    }
}

#[test]
fn the_table_of_lost_light_is_interpolated_within_four_ten_thousandths() {
    for (alpha, cos) in lattice(144, 89) {
        let alpha = F(0.001 + 0.999 * alpha.0 * alpha.0 * alpha.0);
        let wo = viewer(cos.0 * cos.0 * cos.0);
        let table = Albedo::at(&LOSS, U(0), alpha).value(One, wo.z);
        let mut loss = 0.0;
        for u in lattice(28_657, 17_711) {
            let wi = microfacets::sample_reflection(alpha, wo, u);
            loss += 1.0 - if wi.z.0 > 0.0 { f64::from(microfacets::g1(alpha, wi).0) } else { 0.0 };
        }
        let loss = loss / 28_657.0;
        assert!((f64::from(table.0) - loss).abs() < 4e-4, "{} {}: {} {loss}", alpha.0, wo.z.0, table.0);
    }
}

/// A coloured surface is in each channel a grey one of that value.
#[test]
fn channels_know_nothing_of_each_other() {
    const COLOUR: [f32; 3] = [0.8, 0.3, 0.1];
    for alpha in [0.0, 0.3] {
        let plastic = |albedo: [f32; 3]| {
            let materials = Materials::new(&[Plastic::new(albedo, 1.5, alpha).into()]);
            let at = Local { material: U(0), colour: V::splat(One, albedo), alpha: F(alpha), front: M(true) };
            let f = Plastic::at(One, &materials, Directions::Bsdf, &at).eval(viewer(0.7), viewer(0.4)).0;
            [f.x.0, f.y.0, f.z.0]
        };
        let coloured = plastic(COLOUR);
        for channel in 0..3 {
            assert_eq!(coloured[channel], plastic([COLOUR[channel]; 3])[channel], "{alpha} {channel}");
        }
    }
}
