//! Smooth and rough dielectrics: optics, energy and reciprocity.
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::super::{
    bsdf::{Bsdf, Lobes},
    dielectric::DielectricBsdf,
    dielectric_albedo::textured_rows,
    fresnel, microfacets,
    missing_energy::LossTable,
    rough_dielectric::RoughDielectricBsdf,
    tests::dielectric_fixtures::{COSINES, ETAS, ROUGHNESSES, combine, dot, interfaces, rough, rows_of, view, wide},
};
use noisefall_base::{
    declare::Precision,
    math::{F, Lanes, M, One, Pick, SimdLevel, U, V, in_lanes},
};

#[test]
fn smooth_refraction_obeys_snell_and_loses_nothing() {
    for eta in ETAS {
        for step in 1..=1000 {
            let wo = view(step as f32 / 1000.0);
            let glass = DielectricBsdf { eta: F(eta) };
            for lobe in [0.0, 0.999_999_94] {
                let sample = glass.sample(wo, (F(0.5), F(0.5)), F(lobe));
                let [wo, wi] = [wide(wo), wide(sample.wi)];
                let index = if wi[2] < 0.0 { f64::from(eta) } else { 1.0 };
                assert!(sample.delta.0 && (dot(wi, wi) - 1.0).abs() < 1e-6);
                assert!((wi[0] * index + wo[0]).abs() < 1e-6 && (wi[1] * index + wo[1]).abs() < 1e-6);
                assert!((f64::from(sample.weight.x.0) * index * index - 1.0).abs() < 1e-6);
            }
        }
    }
}

#[test]
fn a_lobe_is_called_as_the_direction_that_it_gives() {
    for eta in ETAS {
        let (glass, wo, u) = (DielectricBsdf { eta: F(eta) }, view(0.3), (F(0.5), F(0.5)));
        let reflects = fresnel::dielectric(wo.z, F::<One>(eta)).0.0;
        for step in 0..100 {
            let lobe = F((step as f32 + 0.5) / 100.0);
            let (passes, chosen) = (glass.sample(wo, u, lobe).wi.z.0 < 0.0, glass.chosen(wo, u, lobe));
            let expected = if passes { ("refraction", 1.0 - reflects) } else { ("mirror reflection", reflects) };
            assert_eq!((chosen.name, chosen.probability), expected, "{eta} {step}");
        }
    }
}

#[test]
fn total_reflection_begins_at_the_critical_angle() {
    for eta in ETAS.into_iter().filter(|&eta| eta < 1.0) {
        let critical = (1.0 - f64::from(eta) * f64::from(eta)).sqrt();
        let passes =
            |cos: f64| DielectricBsdf { eta: F(eta) }.sample(view(cos as f32), (F(0.5), F(0.5)), F(0.999_999_9)).wi.z.0 < 0.0;
        assert!(passes(critical + 1e-6) && !passes(critical - 1e-6), "{eta}");
        assert!((1..100).all(|step| !passes(critical * f64::from(step) / 100.0)), "{eta}");
    }
}

#[test]
fn equal_indices_let_everything_pass_straight() {
    for cos in COSINES {
        let (wo, u) = (view(cos), (F(0.3), F(0.7)));
        for sample in [DielectricBsdf { eta: F(1.0) }.sample(wo, u, F(1e-9)), rough(1.0, 0.5, None).sample(wo, u, F(1e-9))] {
            let off = combine(wide(sample.wi), 1.0, wide(wo), 1.0);
            assert!(dot(off, off) < 1e-12 && sample.weight.x.0 == 1.0 && sample.delta.0);
        }
    }
}

/// Mean weight of samples, the scale of radiance taken out: over `u` on a lattice, over `lobe` exactly.
fn albedo(bsdf: &RoughDielectricBsdf<'_, One>, eta: f32, wo: V<One>, [count, step]: [u32; 2]) -> f64 {
    let ease = |t: f64| (t * t * (3.0 - 2.0 * t)) as f32;
    let slope = |t: f64| 6.0 * t * (1.0 - t);
    let point = |i: u32| {
        let [x, y] = [i, i * step % count].map(|k| (f64::from(k) + 0.5) / f64::from(count));
        let at = |lobe: f64| {
            let sample = bsdf.sample(wo, (F(ease(x)), F(ease(y))), F(lobe as f32));
            let index = if sample.wi.z.0 < 0.0 { f64::from(eta) } else { 1.0 };
            (sample.wi.lane(0), f64::from(sample.weight.x.0) * index * index)
        };
        slope(x) * slope(y) * mean_of_steps(&at, [0.0, 1.0], [at(0.0), at(0.999_999_94)])
    };
    (0..count).map(point).sum::<f64>() / f64::from(count)
}

/// Integrates a weight that changes only with the direction, by bisection.
fn mean_of_steps(at: &impl Fn(f64) -> ([f32; 3], f64), [from, to]: [f64; 2], [low, high]: [([f32; 3], f64); 2]) -> f64 {
    if low.0 == high.0 || to - from < 1e-4 {
        return (to - from) * 0.5 * (low.1 + high.1);
    }
    let half = 0.5 * (from + to);
    let middle = at(half);
    mean_of_steps(at, [from, half], [low, middle]) + mean_of_steps(at, [half, to], [middle, high])
}

#[test]
fn compensated_surfaces_lose_nothing() {
    let mut worst = (0.0, String::new());
    for (eta, alpha) in ETAS.into_iter().flat_map(|eta| ROUGHNESSES.map(|alpha| (eta, alpha))) {
        let rows = rows_of(eta, alpha);
        // The loss has a bump at the critical angle, the hardest place of the tables.
        let critical = (1.0 - eta * eta).max(0.0).sqrt();
        for cos in [critical, 0.9, 0.4, 0.1, 0.02].into_iter().filter(|&cos| cos > 0.0) {
            let error = (albedo(&rough(eta, alpha, Some(rows)), eta, view(cos), [2584, 1597]) - 1.0).abs();
            if error > worst.0 {
                worst = (error, format!("{eta} {alpha} {cos}"));
            }
        }
    }
    assert!(worst.0 < 1e-3, "{worst:?}");
}

#[test]
fn single_scattering_gains_nothing_and_a_smooth_surface_loses_nothing() {
    for (eta, alpha) in ETAS.into_iter().flat_map(|eta| ROUGHNESSES.map(|alpha| (eta, alpha))) {
        for cos in COSINES {
            let albedo = albedo(&rough(eta, alpha, None), eta, view(cos), [987, 610]);
            assert!(albedo < 1.0 + 1e-3, "{eta} {alpha} {cos}: {albedo}");
            assert!(alpha > 0.001 || cos < 0.1 || albedo > 1.0 - 1e-3, "{eta} {alpha} {cos}: {albedo}");
        }
    }
}

#[test]
fn textured_roughness_loses_nothing() {
    let mut worst = (0.0, String::new());
    for inside in [1.0 / 1.5, 1.5] {
        let rows = textured_rows(inside, Precision::Exact);
        for alpha in [0.001, 0.02, 0.15, 0.35, 0.8] {
            for (cos, outside) in COSINES.into_iter().flat_map(|cos| [(cos, true), (cos, false)]) {
                let eta = if outside { inside } else { 1.0 / inside };
                let table = LossTable { rows: &rows, offset: U(0), textured: M(true) };
                let bsdf = RoughDielectricBsdf::new(One, F(eta), F(alpha), M(outside), Some(table));
                let error = (albedo(&bsdf, eta, view(cos), [6765, 4181]) - 1.0).abs();
                if error > worst.0 {
                    worst = (error, format!("{eta} {alpha} {cos}"));
                }
            }
        }
    }
    assert!(worst.0 < 1e-3, "{worst:?}");
}

#[test]
fn weights_are_eval_over_pdf() {
    let mut rng = SmallRng::seed_from_u64(1);
    for (eta, alpha) in interfaces(&ROUGHNESSES) {
        let rows = rows_of(eta, alpha);
        for (cos, energy) in COSINES.into_iter().flat_map(|cos| [(cos, None), (cos, Some(rows))]) {
            let bsdf = rough(eta, alpha, energy);
            for _ in 0..100 {
                let wo = view(cos);
                let sample = bsdf.sample(wo, (F(rng.random()), F(rng.random())), F(rng.random()));
                let (f, pdf) = bsdf.eval(wo, sample.wi);
                assert_eq!(pdf.0, sample.pdf.0);
                let weight = sample.weight.x.0;
                assert!(weight == 0.0 || (weight * pdf.0 - f.x.0).abs() <= 1e-6 * f.x.0, "{eta} {alpha} {cos}");
                let masked = microfacets::g1(F(alpha), sample.wi).0;
                let scale = if sample.wi.z.0 < 0.0 { eta * eta } else { 1.0 };
                assert!(energy.is_some() || weight == 0.0 || (weight * scale - masked).abs() < 1e-5, "{eta} {alpha} {cos}");
            }
        }
    }
}

#[test]
fn rough_surfaces_are_reciprocal() {
    let mut rng = SmallRng::seed_from_u64(2);
    for (eta, alpha) in interfaces(&ROUGHNESSES) {
        let rows = rows_of(eta, alpha);
        for (cos, energy) in COSINES.into_iter().flat_map(|cos| [(cos, None), (cos, Some(rows))]) {
            let (wo, near) = (view(cos), rough(eta, alpha, energy));
            for _ in 0..100 {
                let sample = near.sample(wo, (F(rng.random()), F(rng.random())), F(rng.random()));
                let (wi, side) = (sample.wi, if sample.wi.z.0 < 0.0 { -1.0 } else { 1.0 });
                let back = if side < 0.0 { rough(1.0 / eta, alpha, energy) } else { near };
                let flipped = |v: V<One>| V { z: v.z * side, ..v };
                let scale = if side < 0.0 { eta * eta } else { 1.0 };
                let there = near.eval(wo, wi).0.x.0 / wi.z.0.abs() * scale;
                let again = back.eval(flipped(wi), flipped(wo)).0.x.0 / wo.z.0;
                // Reflectance rises infinitely fast towards total reflection: a rounding of the cosine counts as its root.
                let tolerance = 5e-4 + 2e-6 / alpha;
                assert!(sample.weight.x.0 == 0.0 || (there - again).abs() <= tolerance * there, "{eta} {alpha}: {there} {again}");
            }
        }
    }
}

/// Bits of sixteen samples, with a different material in each lane.
fn sample_bits<L: Lanes>(l: L, rows: &[[f32; 4]]) -> Vec<u32> {
    let spread = |from: usize, phase: usize| -> F<L> {
        let values: Vec<f32> = (from..from + L::N).map(|i| ((i * 7 + phase * 5) % 16) as f32 / 16.0 + 0.03).collect();
        l.load(&values)
    };
    let mut all = vec![0; 7 * 16];
    for from in (0..16).step_by(L::N) {
        let outside = spread(from, 1).above(0.5);
        let eta: F<L> = outside.pick(l.f(1.5), l.f(1.0 / 1.5));
        let table = LossTable { rows, offset: l.u(0), textured: outside };
        let bsdf = RoughDielectricBsdf::new(l, eta, spread(from, 2), outside, Some(table));
        let z = spread(from, 3).min(l.f(1.0));
        let wo = V { x: (1.0 - z * z).sqrt(), y: l.f(0.0), z };
        let sample = bsdf.sample(wo, (spread(from, 4), spread(from, 5)), spread(from, 6));
        let (f, pdf) = bsdf.eval(wo, sample.wi);
        let numbers = [sample.wi.x, sample.wi.y, sample.wi.z, sample.weight.x, sample.pdf, f.x, pdf];
        for (k, number) in numbers.iter().enumerate() {
            all[k * 16 + from..k * 16 + from + L::N].copy_from_slice(&number.bits().to_array()[..L::N]);
        }
    }
    all
}

#[test]
fn all_lane_widths_give_the_same_bits() {
    let rows = textured_rows(1.5, Precision::Exact);
    let one = sample_bits(One, &rows);
    for level in SimdLevel::available() {
        assert_eq!(in_lanes!(level, l => sample_bits(l, &rows)), one, "{level:?}");
    }
}
