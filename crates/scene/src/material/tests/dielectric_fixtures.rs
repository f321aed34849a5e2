//! Interfaces and directions for the tests of dielectrics.
use std::{collections::HashMap, sync::LazyLock};

use super::super::{dielectric_albedo::uniform_rows, missing_energy::LossTable, rough_dielectric::RoughDielectricBsdf};
use noisefall_base::{
    declare::Precision,
    math::{F, M, One, U, V},
};

pub(super) type Direction = [f64; 3];

pub(super) const ETAS: [f32; 7] = [1.0 / 2.4, 1.0 / 1.5, 1.0 / 1.33, 1.0001, 1.33, 1.5, 2.4];
pub(super) const ROUGHNESSES: [f32; 6] = [0.001, 0.01, 0.1, 0.3, 0.6, 1.0];
pub(super) const COSINES: [f32; 5] = [1.0, 0.8, 0.4, 0.1, 0.02];

/// Interfaces that are not faint, at all of these roughnesses.
pub(super) fn interfaces(roughnesses: &[f32]) -> Vec<(f32, f32)> {
    let etas = ETAS.iter().filter(|&&eta| eta != 1.0001);
    etas.flat_map(|&eta| roughnesses.iter().map(move |&alpha| (eta, alpha))).collect()
}

/// Index of refraction in hundredths and bits of the roughness.
type Key = (u32, u32);

/// Rows of the materials of all tests; the denser side is inside.
static ROWS: LazyLock<HashMap<Key, Vec<[f32; 4]>>> = LazyLock::new(|| {
    let materials = ETAS.into_iter().filter(|&eta| eta > 1.0).flat_map(|eta| ROUGHNESSES.map(|alpha| (eta, alpha)));
    materials.map(|(eta, alpha)| (key(eta, alpha), uniform_rows(eta, alpha, Precision::Exact))).collect()
});

fn key(eta: f32, alpha: f32) -> Key {
    ((eta.max(1.0 / eta) * 100.0).round() as u32, alpha.to_bits())
}

pub(super) fn rows_of(eta: f32, alpha: f32) -> &'static [[f32; 4]] {
    &ROWS[&key(eta, alpha)]
}

/// The interface seen from its thinner side, outside, where `eta` > 1, from inside otherwise.
pub(super) fn rough(eta: f32, alpha: f32, rows: Option<&[[f32; 4]]>) -> RoughDielectricBsdf<'_, One> {
    let table = rows.map(|rows| LossTable { rows, offset: U(0), textured: M(false) });
    RoughDielectricBsdf::new(One, F(eta), F(alpha), M(eta > 1.0), table)
}

pub(super) fn view(cos: f32) -> V<One> {
    let sin = (1.0 - cos * cos).sqrt();
    V::splat(One, [0.6 * sin, 0.8 * sin, cos])
}

pub(super) fn wide(v: V<One>) -> Direction {
    [v.x.0.into(), v.y.0.into(), v.z.0.into()]
}

pub(super) fn dot(a: Direction, b: Direction) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn combine(a: Direction, by_a: f64, b: Direction, by_b: f64) -> Direction {
    std::array::from_fn(|i| a[i] * by_a + b[i] * by_b)
}
