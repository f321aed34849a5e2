//! The white furnace over roughness and anisotropy: what is lossless loses nothing, and anisotropy begins without a jump.
use super::{
    super::{
        Bsdf, Conductor, Dielectric, Local, Material, Materials, Roughness, Shade,
        conductor::AnisotropicConductor,
        dielectric::{RoughDielectric, TintedDielectric},
        principled::{Principled, PrincipledGlass},
    },
    lattice,
};
use crate::{material::conductor_fresnel::Reflectance, sampling::Directions};
use noisefall_base::{
    declare::Textured,
    math::{F, M, One, U, V},
};

const ALPHAS: [f32; 3] = [0.09, 0.3, 1.0];
const ANISOTROPIES: [f64; 4] = [0.0, 0.001, 0.5, 0.95];
const IOR: f32 = 1.5;
/// Largest error of the mean over directions, and of each, where a table holds the loss.
const EXACT: [f64; 2] = [0.005, 0.02];

fn directions() -> impl Iterator<Item = V<One>> {
    [0.9f32, 0.5, 0.15].into_iter().flat_map(|cos| {
        let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
        [(1.0, 0.0), (0.6, 0.8), (0.0, 1.0)].map(|(x, y)| V::splat(One, [sin * x, sin * y, cos]))
    })
}

/// The light that leaves in all directions, without what refraction to an index does to radiance.
fn albedo(bsdf: &impl Bsdf<One>, wo: V<One>, index: f32) -> f64 {
    const POINTS: u32 = 6765;
    const STEP: f32 = 0.754_877_7;
    let weights = lattice(POINTS, 4181).enumerate().map(|(i, u)| {
        let sample = bsdf.sample(wo, u, F((i as f64 * f64::from(STEP)).fract() as f32));
        let scale = if sample.wi.z.0 < 0.0 { f64::from(index * index) } else { 1.0 };
        scale * f64::from(sample.weight.x.0)
    });
    weights.sum::<f64>() / f64::from(POINTS)
}

fn at(alpha: f32, front: bool) -> Local<One> {
    Local { material: U(0), colour: V::splat(One, [1.0; 3]), alpha: F(alpha), front: M(front) }
}

/// Checks albedos by (α, anisotropy), of which the first is round.
fn assert_furnace(name: &str, [most_mean, most]: [f64; 2], albedos: impl Fn(f32, f64) -> Vec<f64>) {
    for alpha in ALPHAS {
        let all = ANISOTROPIES.map(|anisotropy| albedos(alpha, anisotropy));
        for (anisotropy, found) in ANISOTROPIES.iter().zip(&all) {
            let mean = found.iter().sum::<f64>() / found.len() as f64;
            println!("{name} {alpha} {anisotropy}: mean {mean:.4}, {found:.3?}");
            assert!((mean - 1.0).abs() < most_mean, "{name}, α {alpha}, anisotropy {anisotropy}: mean {mean}");
            assert!(found.iter().all(|x| (x - 1.0).abs() < most), "{name}, α {alpha}, anisotropy {anisotropy}: {found:?}");
        }
        let jump = all[0].iter().zip(&all[1]).map(|(round, nearly)| (round - nearly).abs()).fold(0.0, f64::max);
        assert!(jump < 0.01, "{name}, α {alpha}: a jump of {jump} where anisotropy begins");
    }
}

#[test]
fn white_metal_loses_nothing() {
    assert_furnace("conductor", EXACT, |alpha, anisotropy| {
        let white = Reflectance::Constant(Textured::grey(1.0));
        let material = Conductor { anisotropy, ..Conductor::new(white, alpha, true) };
        let materials = Materials::new(&[material.into()]);
        if anisotropy == 0.0 {
            let round = Conductor::at(One, &materials, Directions::Bsdf, &at(alpha, true));
            return directions().map(|wo| albedo(&round, wo, 1.0)).collect();
        }
        let bsdf = AnisotropicConductor::at(One, &materials, Directions::Bsdf, &at(alpha, true));
        directions().map(|wo| albedo(&bsdf, wo, 1.0)).collect()
    });
}

#[test]
fn clear_glass_loses_nothing_from_either_side() {
    assert_furnace("dielectric", EXACT, |alpha, anisotropy| {
        let roughness = Roughness::alpha(alpha);
        let material = Dielectric { ior: IOR.into(), roughness, anisotropy, ..Dielectric::default() };
        let materials = Materials::new(&[Material::from(material)]);
        let sides = [true, false].into_iter().flat_map(|front| directions().map(move |wo| (front, wo)));
        let of_side = |(front, wo): (bool, V<One>)| {
            let (at, index) = (at(alpha, front), if front { IOR } else { 1.0 / IOR });
            match anisotropy {
                0.0 => albedo(&RoughDielectric::at(One, &materials, Directions::Bsdf, &at), wo, index),
                _ => {
                    let bsdf = TintedDielectric::at(One, &materials, Directions::Bsdf, &at);
                    albedo(&TintedDielectric::with_transmittance(bsdf, V::splat(One, [1.0; 3])), wo, index)
                }
            }
        };
        sides.map(of_side).collect()
    });
}

fn principled(anisotropy: f64) -> Principled {
    Principled {
        base_color: Textured::grey(1.0),
        specular_ior: IOR.into(),
        specular_roughness_anisotropy: Textured::Constant(anisotropy),
        ..Principled::default()
    }
}

#[test]
fn a_white_base_under_anisotropic_facets_loses_nothing() {
    assert_furnace("principled plastic", [0.02, 0.15], |alpha, anisotropy| {
        let number = Textured::Constant(f64::from(alpha.sqrt()));
        let materials = Materials::new(&[Principled { specular_roughness: number, ..principled(anisotropy) }.into()]);
        let bsdf = Principled::at(One, &materials, Directions::Bsdf, &at(alpha, true));
        directions().map(|wo| albedo(&bsdf, wo, 1.0)).collect()
    });
}

#[test]
fn principled_metal_and_glass_lose_nothing() {
    assert_furnace("principled metal", EXACT, |alpha, anisotropy| {
        let number = Textured::Constant(f64::from(alpha.sqrt()));
        let material =
            Principled { base_metalness: Textured::Constant(1.0), specular_roughness: number, ..principled(anisotropy) };
        let materials = Materials::new(&[material.into()]);
        let bsdf = Principled::at(One, &materials, Directions::Bsdf, &at(alpha, true));
        directions().map(|wo| albedo(&bsdf, wo, 1.0)).collect()
    });
    assert_furnace("principled glass", EXACT, |alpha, anisotropy| {
        let number = Textured::Constant(f64::from(alpha.sqrt()));
        let material =
            Principled { transmission_weight: Textured::Constant(1.0), specular_roughness: number, ..principled(anisotropy) };
        let materials = Materials::new(&[material.into()]);
        let sides = [true, false].into_iter().flat_map(|front| directions().map(move |wo| (front, wo)));
        let of_side = |(front, wo): (bool, V<One>)| {
            let bsdf = PrincipledGlass::at(One, &materials, Directions::Bsdf, &at(alpha, front));
            albedo(&bsdf, wo, if front { IOR } else { 1.0 / IOR })
        };
        sides.map(of_side).collect()
    });
}
