//! x_M on spheres with radii from 10⁻⁶ to 10⁶, against a reference in f64.
use glam::DVec3;
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{Sphere, surface_point};
use crate::geometry::{fraction::Fraction, surface_point::SurfacePoint};
use noisefall_base::math::{F, One, V};

const RADII: [f64; 13] = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6];

fn v(a: DVec3) -> V<One> {
    V::splat(One, a.as_vec3().to_array())
}

fn exact(v: V<One>) -> DVec3 {
    DVec3::new(v.x.0.into(), v.y.0.into(), v.z.0.into())
}

fn unit_vector(rng: &mut SmallRng) -> DVec3 {
    loop {
        let p = DVec3::new(rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0));
        if (0.01..1.0).contains(&p.length()) {
            return p.normalize();
        }
    }
}

/// The nearest positive root by the textbook formula in f64 on the very numbers that the f32 code has, and cos² of the angle of
/// incidence (negative for a miss).
fn oracle(sphere: &Sphere, o: V<One>, d: V<One>) -> (Option<f64>, f64) {
    let curvature = f64::from(sphere.curvature);
    let anchor = DVec3::from_array(sphere.anchor.map(f64::from));
    let normal = DVec3::from_array(sphere.normal.map(f64::from));
    let (o, d) = (exact(o), exact(d));
    let from_anchor = o - anchor;
    let a = curvature * d.length_squared();
    let b = (from_anchor * curvature + normal).dot(d);
    let c = curvature * from_anchor.length_squared() + 2.0 * from_anchor.dot(normal);
    let discriminant = b * b - a * c;
    if discriminant < 0.0 {
        return (None, discriminant);
    }
    let q = -(b + discriminant.sqrt().copysign(b));
    let mut roots = [q / a, c / q];
    roots.sort_by(f64::total_cmp);
    (roots.into_iter().find(|t| *t > 0.0), discriminant)
}

fn intersect(sphere: &Sphere, o: V<One>, d: V<One>) -> Option<f64> {
    let intersection = sphere.intersect(o, d)?;
    intersection.less(&Fraction::infinite(One)).0.then_some(f64::from(intersection.value().0))
}

fn point_on(sphere: &Sphere, p: V<One>) -> SurfacePoint<One> {
    let [anchor, normal] = sphere.rows();
    surface_point(anchor.map(F), normal.map(F), p)
}

/// A ray must agree with the reference within the precision of f32: an error of the discriminant of a few roundings of the
/// distance in radii shifts the hit by that over 2 cos θ.
fn assert_agrees(sphere: &Sphere, o: V<One>, d: V<One>, what: &str) {
    let radius = 1.0 / f64::from(sphere.curvature);
    let distance = (exact(o) - DVec3::from_array(sphere.anchor.map(f64::from))).length();
    let rounding = 16.0 * f64::from(f32::EPSILON);
    let blur = rounding * (1.0 + distance / radius);
    let (expected, discriminant) = oracle(sphere, o, d);
    let found = intersect(sphere, o, d);
    match (expected, found) {
        (Some(expected), Some(found)) => {
            let cos = discriminant.sqrt().max(blur.sqrt());
            let tolerance = rounding * (distance + expected) / cos;
            assert!(
                (expected - found).abs() <= tolerance,
                "{what}, R = {radius:e}: {found:e}, exactly {expected:e} ± {tolerance:e}"
            );
        }
        (None, None) => {}
        // Within rounding of the tangent, or of starting on the surface, either answer is right.
        _ => {
            let grazes = discriminant.abs() < blur;
            let starts_on_surface =
                expected.or(found).is_some_and(|t| t < rounding * distance / discriminant.abs().sqrt().max(1e-3));
            assert!(
                grazes || starts_on_surface,
                "{what}, R = {radius:e}: {found:?}, exactly {expected:?}, cos² {discriminant:e}"
            );
        }
    }
}

/// A sphere of this radius whose surface passes near the origin, as walls and balls of a scene do.
fn sphere_near_origin(rng: &mut SmallRng, radius: f64) -> (Sphere, DVec3) {
    let near = unit_vector(rng) * rng.random_range(0.0..1.0) * radius.min(1.0);
    let center = near - unit_vector(rng) * radius;
    (Sphere::new(center, radius, near), center)
}

#[test]
fn rays_from_outside_and_inside_agree_with_the_oracle() {
    let mut rng = SmallRng::seed_from_u64(1);
    for radius in RADII {
        for _ in 0..20_000 {
            let (sphere, center) = sphere_near_origin(&mut rng, radius);
            let target = center + unit_vector(&mut rng) * radius * rng.random_range(0.0..1.2);
            let outside = center + unit_vector(&mut rng) * radius * (1.0 + 10f64.powf(rng.random_range(-3.0..3.0)));
            assert_agrees(&sphere, v(outside), v((target - outside).normalize()), "from outside");
            let inside = center + unit_vector(&mut rng) * radius * rng.random_range(0.0..0.99);
            assert_agrees(&sphere, v(inside), v(unit_vector(&mut rng)), "from inside");
            assert!(intersect(&sphere, v(inside), v(unit_vector(&mut rng))).is_some(), "a ray from inside must hit");
        }
    }
}

#[test]
fn rays_in_a_room_between_large_spheres_agree_with_the_oracle() {
    let mut rng = SmallRng::seed_from_u64(2);
    for radius in RADII.into_iter().filter(|radius| *radius >= 10.0) {
        for _ in 0..20_000 {
            let (sphere, _) = sphere_near_origin(&mut rng, radius);
            let o = unit_vector(&mut rng) * rng.random_range(0.0..3.0);
            assert_agrees(&sphere, v(o), v(unit_vector(&mut rng)), "in a room");
        }
    }
}

#[test]
fn a_tiny_ball_is_hit_from_far_away() {
    let mut rng = SmallRng::seed_from_u64(3);
    for _ in 0..20_000 {
        let sphere = Sphere::new(DVec3::ZERO, 1e-6, DVec3::ZERO);
        let o = v(unit_vector(&mut rng) * 1e-2);
        // The direction is rounded to f32, so it is aimed at the middle tenth.
        let target = unit_vector(&mut rng) * 1e-7;
        let d = v((target - exact(o)).normalize());
        let t = intersect(&sphere, o, d).expect("it is aimed at");
        assert!((t - 1e-2).abs() < 2e-6, "{t}");
    }
}

#[test]
fn tangents_agree_with_the_oracle() {
    let mut rng = SmallRng::seed_from_u64(4);
    for radius in RADII {
        for _ in 0..5_000 {
            let (sphere, center) = sphere_near_origin(&mut rng, radius);
            let n = unit_vector(&mut rng);
            let along = n.cross(unit_vector(&mut rng)).normalize();
            let beside = 1.0 + rng.random_range(-1e-5..1e-5);
            let o = center + n * radius * beside - along * radius * rng.random_range(0.1..10.0);
            assert_agrees(&sphere, v(o), v(along), "tangent");
        }
    }
}

/// The next ray of a path at a surface: from the point moved off by its error, into a hemisphere, grazing ones included.
fn leave(point: &SurfacePoint<One>, side: f32, rng: &mut SmallRng) -> (V<One>, V<One>) {
    let n = exact(point.n_geometric) * f64::from(side);
    let grazing = 10f64.powf(rng.random_range(-7.0..0.0));
    let along = n.cross(unit_vector(rng)).normalize();
    let d = (n * grazing + along * (1.0 - grazing * grazing).max(0.0).sqrt()).normalize();
    (point.p + point.n_geometric * (point.error * side), v(d))
}

#[test]
fn rays_that_leave_a_sphere_never_meet_it_again() {
    let mut rng = SmallRng::seed_from_u64(5);
    for radius in RADII {
        let (sphere, center) = sphere_near_origin(&mut rng, radius);
        for _ in 0..100_000 {
            let near = center + unit_vector(&mut rng) * radius;
            let point = point_on(&sphere, v(near));
            let (o, d) = leave(&point, 1.0, &mut rng);
            assert_eq!(intersect(&sphere, o, d), None, "R = {radius:e} at {near}");
        }
    }
}

#[test]
fn a_million_bounces_inside_a_sphere_of_a_hundred_kilometres_never_hit_where_they_start() {
    let mut rng = SmallRng::seed_from_u64(6);
    for radius in [1e-6, 1.0, 1e5] {
        let sphere = Sphere::new(DVec3::new(0.0, radius, 0.0), radius, DVec3::ZERO);
        let mut point = point_on(&sphere, v(DVec3::new(0.0, 0.0, 0.0)));
        for _ in 0..1_000_000 {
            let (o, d) = leave(&point, -1.0, &mut rng);
            let t = intersect(&sphere, o, d).expect("a ray inside a closed sphere meets it");
            let (expected, _) = oracle(&sphere, o, d);
            let expected = expected.expect("the oracle agrees");
            // A chord is 2 R cos θ; a self-hit would be shorter by orders of magnitude.
            assert!(t > 0.5 * expected && t < 2.0 * expected, "R = {radius:e}: {t:e}, exactly {expected:e}");
            point = point_on(&sphere, o + d * F(t as f32));
        }
    }
}

#[test]
fn surface_points_lie_on_the_sphere_with_its_normal() {
    let mut rng = SmallRng::seed_from_u64(7);
    for radius in RADII {
        for _ in 0..10_000 {
            let (sphere, center) = sphere_near_origin(&mut rng, radius);
            let n = unit_vector(&mut rng);
            let point = point_on(&sphere, v(center + n * radius * (1.0 + rng.random_range(-1e-4..1e-4))));
            let (o, d) = (point.p, point.n_geometric);
            assert!((exact(d).length() - 1.0).abs() < 4e-7);
            // From the point moved off by its error outwards the surface is behind, at the distance of the error at most thrice.
            let outside = o + d * point.error;
            let (t, _) = oracle(&sphere, outside, -d);
            let t = t.expect("the surface is behind");
            assert!(t <= 3.0 * f64::from(point.error.0), "R = {radius:e}: {t:e} of {:e}", point.error.0);
        }
    }
}
