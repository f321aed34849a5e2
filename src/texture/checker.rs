//! Checker: alternating squares of two textures. The square at u = v = 0 is even.
use crate::math::{F, Lanes, M, round::floor};

/// Whether (u, v) lies on an even square, with `scale` squares per unit.
#[inline(always)]
pub fn is_even<L: Lanes>(u: F<L>, v: F<L>, scale: f32) -> M<L> {
    let (_, column) = floor(u * scale);
    let (_, row) = floor(v * scale);
    ((column ^ row) & 1).is(0)
}

/// The area of the even squares in the unit square.
pub fn even_share(scale: f32) -> f32 {
    let scale = f64::from(scale);
    let whole = scale.floor();
    let rest = scale - whole;
    let even_stripes = (whole / 2.0).ceil() + if whole % 2.0 == 0.0 { rest } else { 0.0 };
    let e = even_stripes / scale;
    (e * e + (1.0 - e) * (1.0 - e)) as f32
}

/// Step of finite differences, 1/32 of a square. A checker as a height field consists of cliffs, which become slopes of that
/// width.
pub fn step(scale: f32) -> f32 {
    1.0 / (32.0 * scale)
}
