//! x_M: the first surface along a ray.
use glam::{DMat3, DVec3};
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{Case, cases, exact, lane, place, point, unit_vector, v};
use crate::geometry::{
    MISS, Nearest, Outline, Shape, Shapes,
    oracle::{intersections, point_at},
};
use noisefall_base::math::{F, M, One, U, V};

const ROUNDING: f64 = 32.0 * f32::EPSILON as f64;

fn closest(shapes: &Shapes, o: V<One>, d: V<One>) -> Option<f64> {
    let Nearest { t, primitive: U(primitive), .. } = shapes.closest(One, M(true), o, d, F(0.0));
    (primitive != MISS).then_some(lane(t))
}

#[test]
fn points_of_the_oracle_lie_at_their_angles() {
    let axes = DMat3::from_diagonal(DVec3::new(2.0, 3.0, 5.0));
    let quarter = |piece: &Shape| point_at(piece, [0.5, 0.25]);
    let near = |a: DVec3, b: DVec3| assert!(a.distance(b) < 1e-12, "{a} {b}");
    near(quarter(&Shape::sphere(DVec3::X, 3.0)), DVec3::new(1.0, 3.0, 0.0));
    near(quarter(&Shape::Ellipsoid { center: DVec3::X, axes }), DVec3::new(1.0, 3.0, 0.0));
    near(quarter(&Shape::Cylinder { base: DVec3::X, axes, capped: false }), DVec3::new(1.0, 3.0, 2.5));
    let edges = [axes.x_axis, axes.y_axis];
    let ellipse = Shape::Flat { outline: Outline::Ellipse, origin: DVec3::X, edges, mirrored: false };
    near(quarter(&ellipse), DVec3::new(1.0, 3.0 * 0.5f64.sqrt(), 0.0));
}

/// A ray must find the first intersection, unless that is an edge or a tangent within rounding, and no false one.
fn assert_agrees(case: &Case, shapes: &Shapes, o: V<One>, d: V<One>, what: &str) {
    let size = case.size();
    let found = closest(shapes, o, d);
    let (origin, direction) = (exact(o), exact(d));
    let center = case.shape.bounding_sphere().0;
    let away = origin.distance(center) + size;
    let blur = ROUNDING * (1.0 + (away + center.length()) / size) * 8.0;
    let all = intersections(&case.shape, origin, direction, blur);
    // Tables hold positions in f32.
    let known_to = away + center.length();
    let tolerance = |t: f64, cos: f64| ROUNDING * 8.0 * (known_to + t.abs()) / cos.max(blur.sqrt());
    if let Some(t) = found {
        let known = all.iter().any(|intersection| (intersection.t - t).abs() <= tolerance(intersection.t, intersection.cos));
        // At a tangent the exact ray may just miss.
        let near_all = intersections(&case.shape, origin, direction, f64::INFINITY);
        let grazes = near_all.is_empty() || near_all.iter().any(|intersection| intersection.cos < 20.0 * blur.sqrt());
        assert!(
            known || grazes || t < tolerance(0.0, 0.1),
            "{}, {what}: found {t:e}, there are {all:?}, o {origin} d {direction}",
            case.name
        );
    }
    for intersection in all {
        let sure = intersection.margin > blur
            && intersection.cos > 20.0 * blur.sqrt()
            && intersection.t > tolerance(intersection.t, intersection.cos);
        let missed = found.is_none_or(|t| t > intersection.t + tolerance(intersection.t, intersection.cos));
        assert!(!(sure && missed), "{}, {what}: found {found:?}, missed {intersection:?}, o {origin} d {direction}", case.name);
    }
}

#[test]
fn first_intersections_agree_with_the_oracle() {
    const RAYS: usize = 2_500;
    let mut rng = SmallRng::seed_from_u64(1);
    for case in cases() {
        let (shapes, pieces) = (case.shapes(), case.shape.pieces());
        let (center, size) = case.shape.bounding_sphere();
        for i in 0..RAYS {
            let target = point(&mut rng, &pieces[i % pieces.len()]);
            let far = 10f64.powf(rng.random_range(0.0..3.0));
            let outside = center + unit_vector(&mut rng) * size * far;
            let near = center + unit_vector(&mut rng) * size * rng.random_range(0.0..1.5);
            for (o, at, what) in [
                (outside, target, "at the shape"),
                (near, target, "from nearby"),
                (near, near + unit_vector(&mut rng), "from nearby, anywhere"),
                (outside, target + unit_vector(&mut rng) * size * 1e-4, "at its edges"),
                (near, near + DVec3::from_array([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]][i % 3]), "along an axis"),
                (target + unit_vector(&mut rng) * size, target, "grazing or not"),
                (target, target + unit_vector(&mut rng), "from the surface"),
                (target, point(&mut rng, &pieces[(i + 1) % pieces.len()]), "from one piece to another"),
            ] {
                let d = (at - exact(v(o))).try_normalize().unwrap_or(DVec3::Y);
                assert_agrees(&case, &shapes, v(o), v(d), what);
            }
        }
    }
}

#[test]
fn surface_points_lie_on_the_surface() {
    let mut rng = SmallRng::seed_from_u64(2);
    for case in cases() {
        let shapes = case.shapes();
        for (id, piece) in case.shape.pieces().iter().enumerate() {
            for _ in 0..500 {
                let on = point(&mut rng, piece);
                let beside = on + unit_vector(&mut rng) * case.size() * 1e-6;
                let found = shapes.surface_point(One, &place(id as u32), v(beside));
                let n = exact(found.n_geometric);
                assert!((n.length() - 1.0).abs() < 4e-7, "{}: {n}", case.name);
                // From the point moved off by its error outwards the surface is behind, nearer than a few times the error.
                let error = lane(found.error);
                let o = exact(found.p + found.n_geometric * found.error);
                let behind = intersections(piece, o, -n, 1.0);
                let t = behind.iter().map(|m| m.t).find(|t| *t > 0.0);
                let t = t.unwrap_or_else(|| panic!("{}: nothing behind {o}, {behind:?}", case.name));
                assert!(t < 4.0 * error && error < 1e-3 * case.size() + 1e-6 * o.length(), "{}: {t:e} of {error:e}", case.name);
            }
        }
    }
}

#[test]
fn rays_that_leave_a_surface_do_not_meet_it_at_once() {
    let mut rng = SmallRng::seed_from_u64(3);
    for case in cases() {
        let shapes = case.shapes();
        for (id, piece) in case.shape.pieces().iter().enumerate() {
            let alone = super::shapes(std::slice::from_ref(piece));
            for i in 0..4_000 {
                let on = point(&mut rng, piece);
                let found = shapes.surface_point(One, &place(id as u32), v(on));
                let side = if i % 2 == 0 { 1.0 } else { -1.0f32 };
                let n = exact(found.n_geometric) * f64::from(side);
                let grazing = 10f64.powf(rng.random_range(-6.0..0.0));
                let along = n.cross(unit_vector(&mut rng)).normalize();
                let d = (n * grazing + along * (1.0 - grazing * grazing).sqrt()).normalize();
                let o = found.p + found.n_geometric * (found.error * side);
                let Some(t) = closest(&alone, o, v(d)) else { continue };
                // The ray must meet another part of the piece, as far away as that really is.
                let there = intersections(piece, exact(o), exact(v(d)), 1e-3);
                let next = there.iter().map(|m| m.t).find(|next| *next > 0.0);
                let next = next.unwrap_or_else(|| panic!("{}: nothing at {t:e}", case.name));
                assert!(t > 0.5 * next, "{}: {t:e} of {next:e}", case.name);
                assert!(side < 0.0, "{}: the outside of a convex piece is met from outside at {t:e}", case.name);
            }
        }
    }
}

#[test]
fn rays_inside_closed_shapes_stay_inside() {
    let mut rng = SmallRng::seed_from_u64(4);
    for case in cases() {
        if !case.shape.contains(case.shape.bounding_sphere().0) {
            continue;
        }
        let (shapes, pieces) = (case.shapes(), case.shape.pieces());
        // Edges first: parameters at the ends of their range.
        let edge = |x: f64| if x < 0.5 { 1e-7 * x } else { 1.0 - 1e-7 * (1.0 - x) };
        for i in 0..40_000 {
            let id = i % pieces.len();
            let (a, b) = (rng.random_range(0.0..1.0), rng.random_range(0.0..1.0));
            let on = point_at(&pieces[id], if i % 3 == 0 { [a, b] } else { [edge(a), if i % 3 == 1 { b } else { edge(b) }] });
            let found = shapes.surface_point(One, &place(id as u32), v(on));
            let n = -exact(found.n_geometric);
            let grazing = 10f64.powf(rng.random_range(-5.0..0.0));
            let along = n.cross(unit_vector(&mut rng)).normalize();
            let d = (n * grazing + along * (1.0 - grazing * grazing).sqrt()).normalize();
            let o = found.p - found.n_geometric * found.error;
            let Nearest { t, primitive, .. } = shapes.closest(One, M(true), o, v(d), F(0.0));
            assert!(primitive.0 != MISS, "{}: a ray from {on} along {d} gets out", case.name);
            let there = shapes.surface_point(One, &place(primitive.0), o + v(d) * t);
            assert!(there.n_geometric.dot(v(d)).0 > -1e-5, "{}: a ray from {on} along {d} sees the outside", case.name);
        }
    }
}

#[test]
fn a_capped_cylinder_keeps_rays_along_its_axis() {
    let shape = [Shape::cylinder(DVec3::ZERO, DVec3::new(0.0, 2.0, 0.0), 0.5, true)];
    let shapes = super::shapes(&shape);
    for (x, inside) in [(0.0, true), (0.3, true), (0.4999, true), (0.6, false)] {
        for (y, d, t) in [(0.5, DVec3::Y, 1.5), (0.5, DVec3::NEG_Y, 0.5), (-1.0, DVec3::Y, 1.0), (3.0, DVec3::NEG_Y, 1.0)] {
            let found = closest(&shapes, v(DVec3::new(x, y, 0.0)), v(d));
            assert_eq!(found.map(|t| (t * 1e4).round() / 1e4), inside.then_some(t), "{x} {y} {d}");
        }
    }
}
