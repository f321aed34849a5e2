//! The first change of sign along rays.
use glam::DVec3;
use rand::{SeedableRng, rngs::SmallRng};

use super::{
    super::{
        affine_form::AffineForm,
        tape::{Quantity, REGISTERS, run},
    },
    Expression, Isosurface, SHAPES, exact, first_sampled_change, inside_box, intersect, ray_into, shape, unit_vector, v, value,
};
use noisefall_base::math::{F, Lanes, One, SimdLevel, V, in_lanes};

/// Tolerance of f at a hit: some hundred roundings of numbers around 1.
const ZERO: f64 = 1e-5;

/// The bound on the rounding of f in f32.
fn rounding(shape: &Isosurface, p: DVec3) -> f64 {
    let mut registers = [AffineForm::constant(One, 0.0); REGISTERS];
    let at = v(p);
    let still = |x| AffineForm::along(x, F(1.0), F(0.0), F(0.0));
    registers[..3].copy_from_slice(&[still(at.x), still(at.y), still(at.z)]);
    run(One, &shape.expression.tape, &mut registers).r.0.into()
}

/// A hit must be a change of sign, with none before it.
fn assert_agrees(shape: &Isosurface, reach: f32, o: V<One>, d: V<One>, what: &str) {
    let found = intersect(shape, o, d);
    let (o, d) = (exact(o), exact(d));
    let f = |t: f64| value(&shape.expression, o + d * t);
    let Some((enter, leave)) = inside_box(o, d, f64::from(reach)) else {
        assert_eq!(found, None, "{what}: outside the box");
        return;
    };
    // Values that rounding hides at the start have no sign.
    let start =
        (0..100).map(|i| enter + (leave - enter) * 0.01 * f64::from(i)).find(|t| f(*t).abs() > rounding(shape, o + d * *t));
    let expected = start.and_then(|start| first_sampled_change(f, start, leave, 2000));
    let blur = 1e-6 * (1.0 + leave);
    match (expected, found) {
        (_, Some(t)) if expected.is_none_or(|expected| t < expected + blur) => {
            // Perhaps earlier than what was sampled: then it must be a change of sign by itself.
            let near = [1.0, 4.0, 16.0, 64.0, 256.0].into_iter().any(|k| f(t - blur * k) * f(t + blur * k) <= 0.0);
            let graze = f(t).abs() < ZERO;
            assert!(near || graze, "{what}: no change of sign at {t}, where f = {:e}; expected {expected:?}", f(t));
        }
        (Some(expected), found) => {
            // Missed, or found late: right only if |f| stays below what f32 can tell in between, or at the ends of the box.
            let next = found.or_else(|| first_sampled_change(f, expected + blur, leave, 20_000)).unwrap_or(leave);
            let highest = (0..200).map(|i| f(expected + (next - expected) * f64::from(i) / 200.0).abs()).fold(0.0, f64::max);
            let at_edge = expected - enter < 4.0 * blur || leave - expected < 4.0 * blur;
            let rounding = rounding(shape, o + d * expected).max(rounding(shape, o + d * next));
            assert!(
                at_edge || highest < ZERO.max(8.0 * rounding),
                "{what}: {found:?}, expected {expected} of {enter} to {leave}, {highest:e} after it"
            );
        }
        (None, _) => {}
    }
}

#[test]
fn a_sphere_agrees_with_the_analytic_one() {
    let mut rng = SmallRng::seed_from_u64(5);
    let sphere = shape(SHAPES[0].1, 1.5);
    let mut worst = 0.0f64;
    for i in 0..100_000 {
        let distance = [0.0, 0.5, 0.9, 1.1, 2.0, 1000.0][i % 6];
        let (o, d) = ray_into(&mut rng, 1.4, distance);
        let found = intersect(&sphere, o, d);
        let (o, d) = (exact(o), exact(d));
        let (b, c) = (o.dot(d), o.length_squared() - 1.0);
        let discriminant = b * b - c * d.length_squared();
        let expected = (discriminant > 0.0)
            .then(|| [-b - discriminant.sqrt(), -b + discriminant.sqrt()].map(|t| t / d.length_squared()))
            .and_then(|roots| roots.into_iter().find(|t| *t > 0.0));
        // The place of a ray from afar is only as exact as its distance.
        let blur = 1.0 + distance;
        if discriminant.abs() < 2e-6 * blur {
            continue;
        }
        assert_eq!(expected.is_some(), found.is_some(), "{expected:?} {found:?} {discriminant:e}");
        if let (Some(expected), Some(found)) = (expected, found) {
            worst = worst.max((expected - found).abs() * discriminant.sqrt().min(1.0) / blur);
        }
    }
    assert!(worst < 2e-6, "{worst:e}");
}

#[test]
fn shapes_agree_with_dense_sampling() {
    let mut rng = SmallRng::seed_from_u64(6);
    for (name, text, reach) in SHAPES {
        let shape = shape(text, reach);
        for i in 0..1000 {
            let distance = [0.0, 0.3, 0.7, 3.0, 30.0][i % 5];
            let (o, d) = ray_into(&mut rng, f64::from(reach), distance);
            assert_agrees(&shape, reach, o, d, name);
        }
    }
}

#[test]
fn random_expressions_agree_with_dense_sampling() {
    let mut rng = SmallRng::seed_from_u64(7);
    let mut tried = 0;
    while tried < 3000 {
        let text = super::random::tree(&mut rng, 3).to_string();
        // Poles with steep sides are not sampled well enough to be compared.
        if text.contains(['/', 't']) || text.contains("^-") || text.contains("exp") {
            continue;
        }
        let Ok(expression) = Expression::parse(&text) else { continue };
        tried += 1;
        let shape = Isosurface::new(expression, [-1.0; 3], [1.0; 3]);
        let (o, d) = ray_into(&mut rng, 1.0, 2.0);
        assert_agrees(&shape, 1.0, o, d, &text);
    }
}

#[test]
fn a_touch_is_no_hit_and_a_dip_is_one() {
    let towards =
        |text: &str, o: [f64; 3], d: [f64; 3]| intersect(&shape(text, 1.0), v(DVec3::from_array(o)), v(DVec3::from_array(d)));
    // A plane met along itself, a parabola that touches, one that misses and one that dips in.
    assert_eq!(towards("y", [-3.0, 0.0, 0.0], [1.0, 0.0, 0.0]), None);
    assert_eq!(towards("y + x^2", [-3.0, 0.0, 0.0], [1.0, 0.0, 0.0]), None);
    assert_eq!(towards("y + x^2", [-3.0, 1e-6, 0.0], [1.0, 0.0, 0.0]), None);
    let dip = towards("y + x^2", [-3.0, -1e-6, 0.0], [1.0, 0.0, 0.0]).expect("a hit");
    assert!((dip - 2.999).abs() < 1e-5, "{dip}");
    // A pole is one, for inside and outside meet there.
    let pole = towards("1/x", [-3.0, 0.1, 0.2], [1.0, 0.0, 0.0]).expect("a hit");
    assert!((pole - 3.0).abs() < 1e-5, "{pole}");
    // Hundreds of roots, of which the first counts.
    let first = towards("sin(400*x) - 0.999", [-0.0001, 0.0, 0.0], [1.0, 0.0, 0.0]).expect("a hit");
    assert!((first - (0.999f64.asin() / 400.0 + 0.0001)).abs() < 1e-6, "{first}");
    // A shell of 10⁻⁵ is met at its outside.
    let shell = towards("abs(x) - 1e-5", [-0.7, 0.1, 0.2], [1.0, 0.0, 0.0]).expect("a hit");
    assert!((shell - 0.69999).abs() < 1e-7, "{shell}");
}

#[test]
fn no_expression_hangs() {
    let texts = [
        "sin(1e6*x) - y",
        "x - x*1.0000001",
        "1/(x*y*z)",
        "sqrt(-1 - x^2) + y*0",
        "exp(exp(exp(x)))*1e30*y",
        "log(-1 - x^2) + x - x + y*1e-30",
        "sin(1/x)*x",
        "x^64 - y^64",
        "tan(300*x)*tan(300*y)",
        "1e-38*x*y",
        "abs(x) - abs(x)*1 + y*0 + min(x, y) - min(x, y)*0.9999999",
        "max(x, x*x) - x",
    ];
    let mut rng = SmallRng::seed_from_u64(8);
    for text in texts {
        let Ok(expression) = Expression::parse(text) else { continue };
        let shape = Isosurface::new(expression, [-1.0; 3], [1.0; 3]);
        for _ in 0..300 {
            let (o, d) = ray_into(&mut rng, 1.0, 2.0);
            intersect(&shape, o, d);
        }
        for axis in 0..3 {
            for o in [0.0, f64::NAN, f64::INFINITY, 1e30] {
                intersect(&shape, v(DVec3::splat(o)), v(DVec3::AXES[axis]));
                intersect(&shape, v(DVec3::ZERO), v(DVec3::splat(o)));
            }
        }
    }
}

/// The bits of t, a coordinate, the normal and the error of sixteen rays.
fn bits_of<L: Lanes>(l: L, shape: &Isosurface, rays: &[[[f32; 16]; 3]; 2]) -> [[u32; 16]; 4] {
    let load = |v: &[[f32; 16]; 3], at: usize| V { x: l.load(&v[0][at..]), y: l.load(&v[1][at..]), z: l.load(&v[2][at..]) };
    let mut bits = [[0; 16]; 4];
    for at in (0..16).step_by(L::N) {
        let (o, d) = (load(&rays[0], at), load(&rays[1], at));
        let t = shape.intersect(l, o, d, l.f(f32::INFINITY));
        let point = shape.surface_point(l, o + d * t);
        for (row, x) in bits.iter_mut().zip([t, point.p.x, point.n_geometric.y, point.error]) {
            for lane in (0..L::N).filter(|lane| t.above(0.0).bits() >> lane & 1 == 1) {
                row[at + lane] = x.to_array()[lane].to_bits();
            }
        }
    }
    bits
}

#[test]
fn every_level_gives_the_same_bits() {
    let mut rng = SmallRng::seed_from_u64(9);
    for (name, text, reach) in SHAPES {
        let shape = shape(text, reach);
        for _ in 0..100 {
            let mut rays = [[[0.0; 16]; 3]; 2];
            for lane in 0..16 {
                let (o, d) = ray_into(&mut rng, f64::from(reach), 2.0);
                for (ray, v) in rays.iter_mut().zip([o, d]) {
                    (ray[0][lane], ray[1][lane], ray[2][lane]) = (v.x.0, v.y.0, v.z.0);
                }
            }
            let expected = bits_of(One, &shape, &rays);
            for level in SimdLevel::available() {
                assert_eq!(in_lanes!(level, l => bits_of(l, &shape, &rays)), expected, "{name} {level:?}");
            }
        }
    }
}

#[test]
fn a_limit_ends_the_ray() {
    let sphere = shape(SHAPES[0].1, 1.5);
    let mut rng = SmallRng::seed_from_u64(10);
    for _ in 0..1000 {
        let d = v(unit_vector(&mut rng));
        let o = d * -3.0;
        assert!(sphere.intersect(One, o, d, F(1.99)).0.is_nan());
        assert!((sphere.intersect(One, o, d, F(2.01)).0 - 2.0).abs() < 1e-5);
    }
}
