//! Checker: squares of two textures in turn. The square at u = v = 0 is even.
use crate::math::{F, Lanes, M, round::floor};

/// Whether (u, v) lies on an even square, `scale` squares to the unit.
#[inline(always)]
pub fn is_even<L: Lanes>(u: F<L>, v: F<L>, scale: f32) -> M<L> {
    let (_, column) = floor(u * scale);
    let (_, row) = floor(v * scale);
    ((column ^ row) & 1).is(0)
}

/// The part of the unit square that is even.
pub fn even_share(scale: f32) -> f32 {
    let scale = f64::from(scale);
    let whole = scale.floor();
    let rest = scale - whole;
    let even_stripes = (whole / 2.0).ceil() + if whole % 2.0 == 0.0 { rest } else { 0.0 };
    let e = even_stripes / scale;
    (e * e + (1.0 - e) * (1.0 - e)) as f32
}

/// As a height a checker is all cliffs: in finite differences over 1/32 of a square they become slopes of that width.
pub fn step(scale: f32) -> f32 {
    1.0 / (32.0 * scale)
}
