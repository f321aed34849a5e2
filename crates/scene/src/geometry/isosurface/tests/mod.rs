//! The isosurface against references in f64.
mod affine_form;
mod exact;
mod functions;
mod images;
mod march;
mod parse;
mod random;
mod surface;

use glam::DVec3;
use rand::{Rng, rngs::SmallRng};

use super::{
    Expression, Isosurface,
    tape::{REGISTERS, run},
};
use exact::Exact;
use noisefall_base::math::{F, One, V};

/// Expressions with the half-width of a box around them.
const SHAPES: [(&str, &str, f32); 8] = [
    ("sphere", "x^2 + y^2 + z^2 - 1", 1.5),
    ("torus", "(sqrt(x^2 + z^2) - 1)^2 + y^2 - 0.16", 1.5),
    ("gyroid", "sin(4*x)*cos(4*y) + sin(4*y)*cos(4*z) + sin(4*z)*cos(4*x)", 1.0),
    ("heart", "(x^2 + 9/4*z^2 + y^2 - 1)^3 - x^2*y^3 - 9/80*z^2*y^3", 1.5),
    ("shell", "abs(x^2 + y^2 + z^2 - 1) - 1e-3", 1.5),
    ("union", "min(sqrt(x^2 + y^2 + z^2) - 0.8, max(abs(x), abs(y), abs(z)) - 0.6)", 1.0),
    ("ripples", "y - 0.1*sin(40*x)*sin(40*z)", 1.0),
    ("blobs", "0.5 - exp(-4*(x^2 + y^2 + z^2)) - exp(-4*((x - 0.8)^2 + y^2 + z^2))", 1.5),
];

fn shape(text: &str, reach: f32) -> Isosurface {
    Isosurface::new(Expression::parse(text).expect("an expression"), [-reach; 3], [reach; 3])
}

fn v(a: DVec3) -> V<One> {
    V::splat(One, a.as_vec3().to_array())
}

fn exact(v: V<One>) -> DVec3 {
    DVec3::new(v.x.0.into(), v.y.0.into(), v.z.0.into())
}

/// f in f64, with the constants of the tape.
fn value(expression: &Expression, p: DVec3) -> f64 {
    let mut registers = [Exact(0.0); REGISTERS];
    registers[..3].copy_from_slice(&p.to_array().map(Exact));
    run(One, &expression.tape, &mut registers).0
}

fn intersect(shape: &Isosurface, o: V<One>, d: V<One>) -> Option<f64> {
    let t = shape.intersect(One, o, d, F(f32::INFINITY)).0;
    (!t.is_nan()).then_some(f64::from(t))
}

fn unit_vector(rng: &mut SmallRng) -> DVec3 {
    loop {
        let p = DVec3::new(rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0));
        if (0.01..1.0).contains(&p.length()) {
            return p.normalize();
        }
    }
}

/// A ray from `distance` away to somewhere in a box of this half-width.
fn ray_into(rng: &mut SmallRng, reach: f64, distance: f64) -> (V<One>, V<One>) {
    let target = unit_vector(rng) * rng.random_range(0.0..reach);
    let o = v(unit_vector(rng) * distance);
    (o, v((target - exact(o)).normalize()))
}

/// Where a ray is in a box of this half-width.
fn inside_box(o: DVec3, d: DVec3, reach: f64) -> Option<(f64, f64)> {
    let (a, b) = ((DVec3::splat(-reach) - o) / d, (DVec3::splat(reach) - o) / d);
    let (enter, leave) = (a.min(b).max_element().max(0.0), a.max(b).min_element());
    (enter < leave).then_some((enter, leave))
}

/// The first change of sign among `samples` places along a ray, halved to the end. What is below
/// 10⁻¹² has no sign.
fn first_sampled_change(f: impl Fn(f64) -> f64, from: f64, to: f64, samples: usize) -> Option<f64> {
    let place = |i: usize| from + (to - from) * i as f64 / samples as f64;
    let start = (0..=samples).map(|i| f(place(i))).find(|value| value.abs() > 1e-12)?;
    let changed = |t: f64| f(t) * start.signum() < -1e-12;
    let i = (1..=samples).find(|i| changed(place(*i)))?;
    let (mut before, mut after) = (place(i - 1), place(i));
    for _ in 0..60 {
        let middle = 0.5 * (before + after);
        if changed(middle) { after = middle } else { before = middle }
    }
    Some(after)
}
