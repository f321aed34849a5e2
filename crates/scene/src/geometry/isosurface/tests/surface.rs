//! Points, normals, and rays that leave.
use glam::DVec3;
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{SHAPES, exact, first_sampled_change, intersect, ray_into, shape, unit_vector, v, value};
use noisefall_base::math::One;

#[test]
fn normals_are_unit_gradients() {
    let mut rng = SmallRng::seed_from_u64(11);
    for (name, text, reach) in SHAPES {
        let shape = shape(text, reach);
        let f = |p: DVec3| value(&shape.expression, p);
        for _ in 0..2000 {
            let (o, d) = ray_into(&mut rng, f64::from(reach), 3.0);
            let Some(t) = intersect(&shape, o, d) else { continue };
            let at = shape.surface_point(One, o + d * t as f32);
            let (p, n) = (exact(at.p), exact(at.n_geometric));
            let h = 1e-6;
            let gradient = DVec3::AXES.map(|axis| (f(p + axis * h) - f(p - axis * h)) / (2.0 * h));
            let gradient = DVec3::from_array(gradient);
            assert!((n.length() - 1.0).abs() < 1e-6, "{name}");
            // Edges of the union have two.
            assert!(name == "union" || n.dot(gradient.normalize()) > 0.9999, "{name} at {p}: {n}, {gradient}");
            assert!(at.error.0 > 0.0 && at.error.0 < 1e-4, "{name} at {p}: error {:e}", at.error.0);
        }
    }
}

#[test]
fn rays_do_not_meet_the_surface_they_leave() {
    let mut rng = SmallRng::seed_from_u64(12);
    let mut left = 0;
    for (name, text, reach) in SHAPES {
        let shape = shape(text, reach);
        for i in 0..30_000 {
            let (o, d) = ray_into(&mut rng, f64::from(reach), 3.0);
            let Some(t) = intersect(&shape, o, d) else { continue };
            let at = shape.surface_point(One, o + d * t as f32);
            let side = if i % 2 == 0 { 1.0 } else { -1.0 };
            let start = at.p + at.n_geometric * (at.error * side);
            let n = exact(at.n_geometric) * f64::from(side);
            assert!(value(&shape.expression, exact(start)) * f64::from(side) > 0.0, "{name}: on the wrong side");
            // Half of them leave at grazing angles.
            let away = unit_vector(&mut rng);
            let away = if away.dot(n) < 0.0 { -away } else { away };
            let flat = (away - n * away.dot(n)).normalize() + n * 10f64.powf(rng.random_range(-6.0..-1.0));
            let d = v(if rng.random::<bool>() { away } else { flat.normalize() });
            left += 1;
            let Some(t) = intersect(&shape, start, d) else { continue };
            let (o, d) = (exact(start), exact(d));
            let f = |t: f64| value(&shape.expression, o + d * t);
            let truly = t > 1e-3 || first_sampled_change(f, 0.0, t * 1.5 + 1e-4, 1000).is_some();
            assert!(truly, "{name}: meets itself at {t:e}, error {:e}", at.error.0);
        }
    }
    assert!(left > 100_000, "{left}");
}

#[test]
fn coordinates_are_those_of_a_sphere() {
    let shape = shape(SHAPES[0].1, 1.5);
    let (found, _) = shape.coordinates(One, v(DVec3::new(0.0, 0.0, -2.0)));
    assert!((found.u.0 - 0.25).abs() < 1e-6 && (found.v.0 - 0.5).abs() < 1e-6, "{} {}", found.u.0, found.v.0);
}

#[test]
fn the_tip_of_a_cone_has_a_normal() {
    let cone = shape("x^2 + z^2 - y^2", 1.0);
    let at = cone.surface_point(One, v(DVec3::ZERO));
    assert_eq!(exact(at.n_geometric), DVec3::Y);
    assert_eq!(at.error.0, 0.0);
}
