//! The white furnace: how much light comes back in all.
use super::{
    super::{Bsdf, Material},
    cases::{Any, COSINES, cases},
    lattice, viewer,
};
use crate::{
    material::{
        albedo::{Albedo, LOSS},
        ggx,
    },
    math::{F, One, U},
};

/// Directional albedo in red, by a lattice of samples of each lobe.
fn albedo(bsdf: &Any<'_>, cos: f32) -> f64 {
    const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;
    let mean = |lobe: f32| {
        let weights = lattice(10_946, 6765).map(|u| f64::from(bsdf.sample(viewer(cos), u, F(lobe)).weight.x.0));
        weights.sum::<f64>() / 10_946.0
    };
    let chance = f64::from(first_lobe(bsdf, cos));
    chance * mean(1e-9) + if chance < 1.0 { (1.0 - chance) * mean(BELOW_ONE) } else { 0.0 }
}

/// Probability of the lobe that is chosen by small numbers, by bisection.
fn first_lobe(bsdf: &Any<'_>, cos: f32) -> f32 {
    let direction = |lobe: f32| bsdf.sample(viewer(cos), (F(0.3), F(0.6)), F(lobe)).wi.lane(0);
    let first = direction(1e-9);
    if direction(1.0) == first {
        return 1.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if direction(middle) == first { low = middle } else { high = middle }
    }
    high
}

#[test]
fn no_light_is_made_and_what_is_lossless_loses_none() {
    for case in &cases() {
        for cos in COSINES {
            let albedo = albedo(&case.bsdf(), cos);
            if std::env::var("SHOW").is_ok() && case.lossless {
                println!("{:+.5} {cos} {}", albedo - 1.0, case.name);
            }
            assert!(albedo < 1.001, "{} at {cos}: {albedo}", case.name);
            assert!(!case.lossless || albedo > 0.999, "{} at {cos}: {albedo}", case.name);
        }
    }
}

#[test]
fn a_mirror_is_exact() {
    for case in &cases() {
        if let Material::Mirror { reflectance } = case.material {
            for cos in COSINES {
                let sample = case.bsdf().sample(viewer(cos), (F(0.3), F(0.6)), F(0.5));
                assert_eq!(sample.weight.lane(0), reflectance);
                assert!(sample.delta.0);
            }
        }
    }
}

#[test]
fn the_table_of_lost_light_is_interpolated_within_three_ten_thousandths() {
    for (alpha, cos) in lattice(144, 89) {
        let alpha = F(0.001 + 0.999 * alpha.0 * alpha.0 * alpha.0);
        let wo = viewer(cos.0 * cos.0 * cos.0);
        let table = Albedo::at(&LOSS, U(0), alpha).value(One, wo.z);
        let mut loss = 0.0;
        for u in lattice(28_657, 17_711) {
            let wi = ggx::sample_reflection(alpha, wo, u);
            loss += 1.0 - if wi.z.0 > 0.0 { f64::from(ggx::g1(alpha, wi).0) } else { 0.0 };
        }
        let loss = loss / 28_657.0;
        assert!((f64::from(table.0) - loss).abs() < 3e-4, "{} {}: {} {loss}", alpha.0, wo.z.0, table.0);
    }
}
