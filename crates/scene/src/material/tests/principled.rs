//! Principled materials: limits that are other materials, energy, and glass.
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{
    super::{
        Bsdf, Conductor, DielectricBsdf, Lobes, Local, Materials, Reflectance, Shade, Stage, fresnel,
        principled::{Principled, PrincipledBsdf, PrincipledGlass},
    },
    viewer,
};
use crate::sampling::Directions;
use noisefall_base::{
    declare::Textured,
    math::{F, M, One, U, V},
};

const COSINES: [f32; 4] = [1.0, 0.7, 0.3, 0.1];

fn number(value: f64) -> Textured<f64> {
    Textured::Constant(value)
}

/// The numbers that the surface stage looks up: base colour and α.
fn local(material: &Principled, front: bool) -> Local<One> {
    let (Textured::Constant(color), Textured::Constant(root)) = (&material.base_color, &material.specular_roughness) else {
        unreachable!("no textures here")
    };
    let alpha = *root as f32;
    Local { material: U(0), colour: V::splat(One, color.map(|x| x as f32)), alpha: F(alpha * alpha), front: M(front) }
}

fn compiled(material: &Principled) -> Materials {
    Materials::new(&[material.clone().into()])
}

fn opaque<'a>(materials: &'a Materials, material: &Principled) -> PrincipledBsdf<'a, One, false> {
    Principled::at(One, materials, Directions::Bsdf, &local(material, true))
}

fn clear<'a>(materials: &'a Materials, material: &Principled, front: bool) -> PrincipledBsdf<'a, One, true> {
    PrincipledGlass::at(One, materials, Directions::Bsdf, &local(material, front))
}

fn glass(roughness: f64) -> Principled {
    Principled {
        base_color: Textured::grey(1.0),
        specular_roughness: number(roughness),
        transmission_weight: number(1.0),
        ..Principled::default()
    }
}

/// Mean weight of samples and its standard error, by the largest channel. What refraction does to radiance is taken out.
fn mean_weight(bsdf: &impl Bsdf<One>, index: f32, wo: V<One>, count: u32, rng: &mut SmallRng) -> (f64, f64) {
    let (mut sum, mut squares) = ([0.0; 3], [0.0; 3]);
    for _ in 0..count {
        let sample = bsdf.sample(wo, (F(rng.random()), F(rng.random())), F(rng.random()));
        let scale = if sample.wi.z.0 < 0.0 { f64::from(index).powi(2) } else { 1.0 };
        for (channel, weight) in sample.weight.lane(0).into_iter().enumerate() {
            let weight = f64::from(weight) * scale;
            assert!(weight.is_finite() && weight >= 0.0, "{weight}");
            sum[channel] += weight;
            squares[channel] += weight * weight;
        }
    }
    let count = f64::from(count);
    let of = |channel: usize| {
        let mean: f64 = sum[channel] / count;
        (mean, ((squares[channel] / count - mean * mean).max(0.0) / count).sqrt())
    };
    [of(0), of(1), of(2)].into_iter().max_by(|a, b| a.0.total_cmp(&b.0)).expect("three channels")
}

#[test]
fn a_base_without_reflecting_interface_is_lambertian() {
    let material = Principled { base_color: [0.8, 0.4, 0.1].into(), specular_weight: number(0.0), ..Principled::default() };
    let materials = compiled(&material);
    let bsdf = opaque(&materials, &material);
    for cos in COSINES {
        for toward in COSINES {
            let f = bsdf.eval(viewer(cos), viewer(toward)).0.lane(0);
            for (f, rho) in f.into_iter().zip([0.8f32, 0.4, 0.1]) {
                let expected = rho * toward * std::f32::consts::FRAC_1_PI;
                assert!((f - expected).abs() <= 1e-5 * expected, "{cos} {toward}: {f} {expected}");
            }
        }
    }
}

#[test]
fn a_metal_is_a_conductor_of_the_same_reflectance() {
    const F0: [f32; 3] = [0.9, 0.5, 0.1];
    let mut rng = SmallRng::seed_from_u64(31);
    for root in [0.2f64, 0.4, 0.7] {
        let material = Principled {
            base_color: F0.into(),
            base_metalness: number(1.0),
            specular_roughness: number(root),
            ..Principled::default()
        };
        let materials = compiled(&material);
        let metal = opaque(&materials, &material);
        let at = local(&material, true);
        let conductors = Materials::new(&[Conductor::new(Reflectance::Schlick(F0.into()), at.alpha.0, true).into()]);
        let conductor = Conductor::at(One, &conductors, Directions::Bsdf, &at);
        for cos in COSINES {
            let wo = viewer(cos);
            let [(ours, error), (theirs, other)] =
                [mean_weight(&metal, 1.0, wo, 20_000, &mut rng), mean_weight(&conductor, 1.0, wo, 20_000, &mut rng)];
            let tolerance = 0.02 + 4.0 * error.hypot(other);
            assert!((ours - theirs).abs() < tolerance, "{root} at {cos}: {ours} {theirs}");
            if root < 0.3 && cos > 0.5 {
                // Single scattering is the same.
                let mirror = V { x: -wo.x, y: -wo.y, z: wo.z };
                let [ours, theirs] = [metal.eval(wo, mirror).0.lane(0), conductor.eval(wo, mirror).0.lane(0)];
                for (ours, theirs) in ours.into_iter().zip(theirs) {
                    assert!((ours - theirs).abs() < 5e-3 * theirs, "{root} at {cos}: {ours} {theirs}");
                }
            }
        }
    }
}

#[test]
fn a_white_metal_loses_nothing() {
    let mut rng = SmallRng::seed_from_u64(32);
    for root in [0.0, 0.3, 0.6, 1.0] {
        let material = Principled {
            base_color: Textured::grey(1.0),
            base_metalness: number(1.0),
            specular_roughness: number(root),
            ..Principled::default()
        };
        let materials = compiled(&material);
        for cos in COSINES {
            let (mean, error) = mean_weight(&opaque(&materials, &material), 1.0, viewer(cos), 40_000, &mut rng);
            assert!((mean - 1.0).abs() < 2e-3 + 5.0 * error, "{root} at {cos}: {mean}");
        }
    }
}

#[test]
fn smooth_transmission_is_the_smooth_dielectric() {
    let material = glass(0.0);
    let materials = compiled(&material);
    for front in [true, false] {
        let (bsdf, eta) = (clear(&materials, &material, front), if front { 1.5f32 } else { 1.0 / 1.5 });
        let exact = DielectricBsdf { eta: F(eta) };
        for cos in [1.0, 0.9, 0.7, 0.3, 0.1] {
            let (wo, u) = (viewer(cos), (F(0.3), F(0.6)));
            let reflects = fresnel::dielectric(wo.z, F::<One>(eta)).0.0;
            for lobe in [0.5 * reflects, 0.499 + 0.5 * reflects] {
                let (ours, theirs) = (bsdf.sample(wo, u, F(lobe)), exact.sample(wo, u, F(lobe)));
                assert!(ours.delta.0);
                for (a, b) in ours.wi.lane(0).into_iter().zip(theirs.wi.lane(0)) {
                    assert!((a - b).abs() < 1e-5, "{front} {cos} {lobe}: {:?} {:?}", ours.wi.lane(0), theirs.wi.lane(0));
                }
                assert!((ours.weight.x.0 - theirs.weight.x.0).abs() < 1e-4, "{front} {cos} {lobe}: {}", ours.weight.x.0);
            }
        }
    }
}

#[test]
fn clear_glass_loses_nothing_and_its_pdf_is_that_of_its_samples() {
    let mut rng = SmallRng::seed_from_u64(33);
    for (root, thin_walled) in [(0.3, false), (0.6, false), (0.8, false), (0.5, true)] {
        let material = Principled { thin_walled, ..glass(root) };
        let materials = compiled(&material);
        for (front, cos) in [true, false].into_iter().flat_map(|front| [0.95, 0.5, 0.15].map(|cos| (front, cos))) {
            let bsdf = clear(&materials, &material, front);
            let index = match (thin_walled, front) {
                (true, _) => 1.0,
                (false, true) => 1.5,
                (false, false) => 1.0 / 1.5,
            };
            let wo = viewer(cos);
            let (mean, error) = mean_weight(&bsdf, index, wo, 40_000, &mut rng);
            assert!((mean - 1.0).abs() < 4e-3 + 5.0 * error, "{root} {thin_walled} {front} at {cos}: {mean}");
            let (mut exist, count) = (0, 20_000);
            for _ in 0..count {
                let sample = bsdf.sample(wo, (F(rng.random()), F(rng.random())), F(rng.random()));
                let (f, pdf) = bsdf.eval(wo, sample.wi);
                if sample.weight.x.0 > 0.0 {
                    exist += 1;
                    assert!((sample.weight.x.0 - f.x.0 / pdf.0).abs() <= 1e-4 * sample.weight.x.0 && !sample.delta.0);
                    assert!(sample.weight.x.0 * index * index < 6.0, "{}", sample.weight.x.0);
                }
            }
            let found = integral_of_pdf(&bsdf, wo);
            // Facets that send light to the wrong side have no sample, and are no part of the pdf.
            let share = f64::from(exist) / f64::from(count);
            assert!((found - share).abs() < 0.02, "{root} {thin_walled} {front} at {cos}: {found} {share}");
        }
    }
}

/// The pdf over the sphere by the midpoint rule.
fn integral_of_pdf(bsdf: &impl Bsdf<One>, wo: V<One>) -> f64 {
    const STEPS: u32 = 500;
    let mut sum = 0.0;
    for i in 0..STEPS * STEPS {
        let z = ((i / STEPS) as f32 + 0.5) / STEPS as f32 * 2.0 - 1.0;
        let (y, x) = (((i % STEPS) as f32 + 0.5) / STEPS as f32 * std::f32::consts::TAU).sin_cos();
        let across = ((1.0 - z) * (1.0 + z)).sqrt();
        sum += f64::from(bsdf.eval(wo, V::splat(One, [across * x, across * y, z])).1.0);
    }
    sum * 4.0 * std::f64::consts::PI / f64::from(STEPS * STEPS)
}

/// Random layers over white bases.
#[test]
fn no_layers_make_light() {
    let mut rng = SmallRng::seed_from_u64(34);
    for _ in 0..50 {
        let mut some = || number(if rng.random() { rng.random() } else { f64::from(u8::from(rng.random::<bool>())) });
        let material = Principled {
            base_color: Textured::grey(1.0),
            base_diffuse_roughness: some(),
            base_metalness: some(),
            specular_weight: some(),
            specular_roughness: some(),
            specular_roughness_anisotropy: some(),
            transmission_weight: some(),
            coat_weight: some(),
            coat_roughness: some(),
            coat_roughness_anisotropy: some(),
            coat_darkening: some(),
            fuzz_weight: some(),
            fuzz_roughness: some(),
            thin_film_weight: some(),
            thin_film_thickness: some(),
            thin_walled: rng.random(),
            ..Principled::default()
        };
        let materials = compiled(&material);
        for cos in [0.9, 0.4, 0.1] {
            for front in [true, false] {
                let index = match (material.thin_walled, front) {
                    (true, _) => 1.0,
                    (false, true) => 1.5,
                    (false, false) => 1.0 / 1.5,
                };
                let (wo, count) = (viewer(cos), 3000);
                let (mean, error) = match materials.stage(0) {
                    Stage::PrincipledGlass => mean_weight(&clear(&materials, &material, front), index, wo, count, &mut rng),
                    _ => mean_weight(&opaque(&materials, &material), 1.0, wo, count, &mut rng),
                };
                assert!(mean < 1.004 + 5.0 * error, "{material:?} {front} at {cos}: {mean} ± {error}");
            }
        }
    }
}

#[test]
fn a_lobe_is_called_as_the_direction_that_it_gives() {
    let mut rng = SmallRng::seed_from_u64(35);
    for (root, name) in [(0.0, "refraction"), (0.5, "microfacet refraction")] {
        let material = Principled { transmission_weight: number(0.7), coat_weight: number(0.5), ..glass(root) };
        let materials = compiled(&material);
        let bsdf = clear(&materials, &material, true);
        for _ in 0..500 {
            let (wo, u, lobe) = (viewer(0.6), (F(rng.random()), F(rng.random())), F(rng.random()));
            let (sample, chosen) = (bsdf.sample(wo, u, lobe), bsdf.chosen(wo, u, lobe));
            assert!((0.0..=1.0).contains(&chosen.probability));
            if sample.weight.x.0 > 0.0 {
                assert_eq!(sample.wi.z.0 < 0.0, chosen.name == name, "{chosen:?}");
            }
        }
    }
}

#[test]
fn a_sheet_lets_light_pass_straight() {
    let material = Principled { thin_walled: true, ..glass(0.0) };
    let materials = compiled(&material);
    let (bsdf, wo) = (clear(&materials, &material, true), viewer(0.5));
    let sample = bsdf.sample(wo, (F(0.3), F(0.6)), F(0.999));
    assert_eq!(sample.wi.lane(0), (-wo).lane(0));
    assert!((sample.weight.x.0 - 1.0).abs() < 1e-5 && sample.delta.0);
}
