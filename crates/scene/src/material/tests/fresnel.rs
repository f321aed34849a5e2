//! Fresnel's equations in f32 against f64 and known values.
use super::{super::fresnel, cases::gold};
use crate::material::{Conductor, Materials, Reflectance, conductor_fresnel::ConductorFresnel};
use noisefall_base::math::{F, One, U, V};

/// The textbook form, in f64.
fn dielectric(cos: f64, eta: f64) -> f64 {
    let g2 = eta * eta - 1.0 + cos * cos;
    if g2 <= 0.0 {
        return 1.0;
    }
    let cos_t = g2.sqrt() / eta;
    let s = (cos - eta * cos_t) / (cos + eta * cos_t);
    let p = (eta * cos - cos_t) / (eta * cos + cos_t);
    0.5 * (s * s + p * p)
}

#[test]
fn dielectrics_agree_with_the_textbook() {
    for eta in [0.4, 0.66, 0.9, 0.999, 1.0001, 1.1, 1.5, 2.4, 10.0] {
        for i in 1..=1000 {
            let cos = (f64::from(i) / 1000.0).powi(3) as f32;
            let exact = dielectric(f64::from(cos), f64::from(eta as f32));
            let (reflectance, cos_t) = fresnel::dielectric(F::<One>(cos), F(eta as f32));
            assert!((f64::from(reflectance.0) - exact).abs() <= 1e-5 * exact + 1e-9, "{eta} {cos}: {} {exact}", reflectance.0);
            let sin_t = (1.0 - f64::from(cos).powi(2)).sqrt() / f64::from(eta as f32);
            let expected = (1.0 - sin_t * sin_t).max(0.0).sqrt();
            assert!((f64::from(cos_t.0) - expected).abs() < 1e-5 || expected < 0.01, "{eta} {cos}: {} {expected}", cos_t.0);
        }
    }
}

#[test]
fn dielectrics_at_the_ends() {
    let at = |cos, eta| fresnel::dielectric(F::<One>(cos), F(eta)).0.0;
    assert!((at(1.0, 1.5) - 0.04).abs() < 1e-8);
    assert_eq!([at(0.0, 1.5), at(0.0, 0.7), at(0.3, 0.7)], [1.0; 3]);
    assert_eq!([at(1.0, 1.0), at(1e-6, 1.0)], [0.0; 2]);
    assert_eq!(fresnel::dielectric(F::<One>(0.3), F(0.7)).1.0, 0.0);
}

/// (η + ik)² − sin² θ = (a + ib)², in f64 with complex arithmetic.
fn metal(cos: f64, eta: f64, k: f64) -> f64 {
    let mul = |(a, b): (f64, f64), (c, d): (f64, f64)| (a * c - b * d, a * d + b * c);
    let ratio = |(a, b): (f64, f64), (c, d): (f64, f64)| (a * a + b * b) / (c * c + d * d);
    let n2 = mul((eta, k), (eta, k));
    let (re, im) = (n2.0 - 1.0 + cos * cos, n2.1);
    let size = re.hypot(im);
    let root = ((0.5 * (size + re)).sqrt(), (0.5 * (size - re)).sqrt());
    let n2cos = (n2.0 * cos, n2.1 * cos);
    let s = ratio((cos - root.0, -root.1), (cos + root.0, root.1));
    let p = ratio((n2cos.0 - root.0, n2cos.1 - root.1), (n2cos.0 + root.0, n2cos.1 + root.1));
    0.5 * (s + p)
}

fn read(reflectance: &Reflectance, colour: [f32; 3]) -> ConductorFresnel<One> {
    let materials = Materials::new(&[Conductor::new(reflectance.clone(), 0.0, false).into()]);
    ConductorFresnel::read(One, &materials, U(0), V::splat(One, colour))
}

#[test]
fn metals_agree_with_complex_arithmetic() {
    let Reflectance::Index { eta, k, .. } = gold() else { unreachable!() };
    let gold = read(&gold(), [1.0; 3]);
    let mut average = [0.0; 3];
    for i in 0..1000 {
        let cos = (i as f32 + 0.5) / 1000.0;
        let reflectance = gold.reflectance(F(cos)).lane(0);
        for c in 0..3 {
            let exact = metal(f64::from(cos), f64::from(eta[c] as f32), f64::from(k[c] as f32));
            assert!((f64::from(reflectance[c]) - exact).abs() < 3e-6, "{c} {cos}: {} {exact}", reflectance[c]);
            average[c] += exact * 2.0 * f64::from(cos) / 1000.0;
        }
    }
    for (ours, exact) in gold.average().lane(0).into_iter().zip(average) {
        assert!((f64::from(ours) - exact).abs() < 1e-5);
    }
}

#[test]
fn averages_are_integrals() {
    // Egan and Hilgeman 1979: glass reflects 0.0918 of diffuse light from outside, 0.5964 from inside.
    assert!((fresnel::dielectric_average(1.5) - 0.0918).abs() < 1e-4);
    assert!((fresnel::dielectric_average(1.0 / 1.5) - 0.5964).abs() < 2e-4);
    let f0 = [0.9, 0.5, 0.04];
    let schlick = read(&Reflectance::Schlick(f0.into()), f0);
    let constant = read(&Reflectance::Constant(f0.into()), f0);
    let mut sum = V::splat(One, [0.0; 3]);
    for i in 0..1000 {
        let cos = (i as f32 + 0.5) / 1000.0;
        assert_eq!(constant.reflectance(F(cos)).lane(0), f0);
        sum = sum + schlick.reflectance(F(cos)) * (2.0 * cos / 1000.0);
    }
    assert_eq!(constant.average().lane(0), f0);
    for (ours, exact) in schlick.average().lane(0).into_iter().zip(sum.lane(0)) {
        assert!((ours - exact).abs() < 1e-5);
    }
}
