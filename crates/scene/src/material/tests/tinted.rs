//! Tinted and Beckmann dielectrics: energy, reciprocity, and smooth ones.
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::super::{
    Bsdf, Dielectric, DielectricBsdf, Distribution, Local, Materials, Shade,
    dielectric::TintedDielectric,
    tests::dielectric_fixtures::{COSINES, view},
    tinted_dielectric::TintedDielectricBsdf,
};
use crate::sampling::Directions;
use noisefall_base::math::{F, M, One, U, V};

const REFLECTED: [f32; 3] = [1.0, 0.5, 0.25];
const TRANSMITTED: [f32; 3] = [1.0, 0.2, 0.0];
const INDEX: f32 = 1.5;

fn glass(distribution: Distribution, alpha: f32) -> Materials {
    let tint = |tint: [f32; 3]| tint.map(f64::from).into();
    let glass = Dielectric {
        distribution,
        specular_reflectance: tint(REFLECTED),
        specular_transmittance: tint(TRANSMITTED),
        ..Dielectric::new(INDEX, alpha, false)
    };
    Materials::new(&[glass.into()])
}

fn at(materials: &Materials, alpha: f32, front: bool) -> TintedDielectricBsdf<'_, One> {
    let local = Local { material: U(0), colour: V::splat(One, REFLECTED), alpha: F(alpha), front: M(front) };
    let bsdf = TintedDielectric::at(One, materials, Directions::Bsdf, &local);
    TintedDielectric::with_transmittance(bsdf, V::splat(One, TRANSMITTED))
}

#[test]
fn smooth_glass_has_its_tints() {
    let materials = glass(Distribution::Ggx, 0.0);
    for front in [true, false] {
        let clear = DielectricBsdf { eta: F(if front { INDEX } else { 1.0 / INDEX }) };
        for (cos, lobe) in COSINES.into_iter().flat_map(|cos| [1e-4, 0.9999].map(|lobe| (cos, lobe))) {
            let (wo, u) = (view(cos), (F(0.3), F(0.6)));
            let (tinted, clear) = (at(&materials, 0.0, front).sample(wo, u, F(lobe)), clear.sample(wo, u, F(lobe)));
            let tint = if clear.wi.z.0 < 0.0 { TRANSMITTED } else { REFLECTED };
            assert_eq!((tinted.wi.lane(0), tinted.delta.0), (clear.wi.lane(0), true));
            assert_eq!(tinted.weight.lane(0), tint.map(|tint| clear.weight.x.0 * tint));
            assert_eq!(at(&materials, 0.0, front).eval(wo, clear.wi).1.0, 0.0);
        }
    }
}

#[test]
fn no_light_is_made_and_weights_are_the_quotient_of_value_and_pdf() {
    let mut rng = SmallRng::seed_from_u64(41);
    for alpha in [0.01, 0.1, 0.3, 1.0] {
        let materials = glass(Distribution::Beckmann, alpha);
        for (front, cos) in [true, false].into_iter().flat_map(|front| COSINES.map(|cos| (front, cos))) {
            let (bsdf, wo) = (at(&materials, alpha, front), view(cos));
            let index = if front { INDEX } else { 1.0 / INDEX };
            for _ in 0..2000 {
                let sample = bsdf.sample(wo, (F(rng.random()), F(rng.random())), F(rng.random()));
                let (f, pdf) = bsdf.eval(wo, sample.wi);
                for (weight, f) in sample.weight.lane(0).into_iter().zip(f.lane(0)) {
                    assert!(weight == 0.0 || (weight - f / pdf.0).abs() <= 1e-4 * weight, "{alpha} {front} {cos}");
                }
                // Single scattering keeps at most all light, apart from what refraction does to radiance.
                let scale = if sample.wi.z.0 < 0.0 { index * index } else { 1.0 };
                assert!(sample.weight.x.0 * scale < 1.0 + 1e-4, "{alpha} {front} {cos}: {}", sample.weight.x.0);
            }
        }
    }
}

#[test]
fn light_and_viewer_can_be_exchanged() {
    let mut rng = SmallRng::seed_from_u64(42);
    for alpha in [0.1, 0.3, 1.0] {
        let materials = glass(Distribution::Beckmann, alpha);
        let [outside, inside] = [true, false].map(|front| at(&materials, alpha, front));
        for cos in COSINES {
            let wo = view(cos);
            for _ in 0..200 {
                let wi = outside.sample(wo, (F(rng.random()), F(rng.random())), F(rng.random())).wi;
                if wi.z.0.abs() < 1e-3 {
                    continue;
                }
                let there = outside.eval(wo, wi).0.x.0 / wi.z.0.abs();
                let flipped = |v: V<One>| V { z: -v.z, ..v };
                let back = if wi.z.0 > 0.0 {
                    outside.eval(wi, wo).0.x.0 / wo.z.0
                } else {
                    inside.eval(flipped(wi), flipped(wo)).0.x.0 / wo.z.0 / (INDEX * INDEX)
                };
                assert!((there - back).abs() <= 2e-3 * there.max(back), "{alpha} {cos}: {there} {back}");
            }
        }
    }
}
