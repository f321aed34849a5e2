//! Surface coordinates and their tangents.
use glam::{DAffine3, DMat3, DVec3};
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{cases, exact, lane, place, point, v};
use crate::geometry::{Coordinates, Motion, PrimitiveRef, Shape, Shapes, TransformStep, Turns};
use noisefall_base::math::{F, One};

#[test]
fn coordinates_lie_in_the_unit_square_and_tangents_are_their_derivatives() {
    const STEP: f64 = 2e-3;
    let mut rng = SmallRng::seed_from_u64(1);
    for case in cases() {
        let (shapes, size) = (case.shapes(), case.size());
        for (id, piece) in case.shape.pieces().iter().enumerate() {
            let id = &place(id as u32);
            for _ in 0..300 {
                let at = shapes.surface_point(One, id, v(point(&mut rng, piece)));
                let Coordinates { u, v: down } = shapes.coordinates(One, id, &at);
                let (u, down) = (lane(u), lane(down));
                let slack = 1e-5 + 1e-6 * exact(at.p).length() / size;
                let range = -slack..=1.0 + slack;
                assert!(range.contains(&u) && range.contains(&down), "{}: {u} {down}", case.name);
                let (along_u, along_v) = shapes.tangents(One, id, &at);
                let across = exact(along_u).cross(exact(along_v)).normalize();
                let n = exact(at.n_geometric);
                assert!(
                    (across.dot(n).abs() - 1.0).abs() < 1e-3 || exact(along_u).length() < 1e-2 * size,
                    "{}: {across} {n}",
                    case.name
                );
                // Moved along a tangent, a point has the other coordinate; poles and the seam are left out.
                let (du, dv) = (rng.random_range(-STEP..STEP), rng.random_range(-STEP..STEP));
                let moved = exact(at.p) + exact(along_u) * du + exact(along_v) * dv;
                let there = shapes.surface_point(One, id, v(moved));
                let found = shapes.coordinates(One, id, &there);
                let (found_u, found_v) = (lane(found.u) - u, lane(found.v) - down);
                // Points of closed shapes are kept within their pieces.
                let flat = matches!(piece, Shape::Flat { .. });
                let beyond = !(1e-4..1.0 - 1e-4).contains(&(down + dv));
                let kept = beyond || flat && exact(there.p).distance(moved) > 1e-5 * size;
                let pole = exact(along_u).length() < 0.3 * exact(along_v).length();
                if kept || pole || found_u.abs() > 0.5 {
                    continue;
                }
                let near = (found_u - du).abs() < 0.05 * STEP + slack && (found_v - dv).abs() < 0.05 * STEP + slack;
                assert!(near, "{}: {du} {dv} become {found_u} {found_v}", case.name);
            }
        }
    }
}

/// The coordinates and the tangents at the point of a ball in the direction `n`, which is as large at time 0 and at time 1.
fn at_direction(ball: &Shape, motion: &Motion, n: DVec3, time: f32) -> ([f64; 2], [DVec3; 2]) {
    let (center, radius) = ball.bounding_sphere();
    let shapes = Shapes::new([(ball, motion)].into_iter(), DVec3::ZERO);
    let id = PrimitiveRef { time: F(time), ..place(0) };
    let at = shapes.surface_point(One, &id, v(center + n * radius));
    let Coordinates { u, v: down } = shapes.coordinates(One, &id, &at);
    let (along_u, along_v) = shapes.tangents(One, &id, &at);
    ([lane(u), lane(down)], [exact(along_u), exact(along_v)])
}

#[test]
fn the_texture_of_a_ball_turns_with_it_and_scaling_leaves_a_ball_as_it_is() {
    let ball = Shape::sphere(DVec3::ZERO, 2.0);
    let turn = DAffine3::from_axis_angle(DVec3::new(1.0, -2.0, 0.5).normalize(), 0.9);
    let [again, mirror] = [DAffine3::from_rotation_y(-0.4), DAffine3::from_scale(DVec3::new(1.0, 1.0, -1.0))];
    let still = Motion::default();
    for map in [turn, DAffine3::from_translation(DVec3::X) * again * turn, mirror * turn, mirror] {
        // An ellipsoid carries its coordinates too, and is all but a ball.
        let stretched = ball.transformed(&DAffine3::from_scale(DVec3::new(1.0, 1.0 + 1e-8, 1.0)));
        let (turned, other) = (ball.transformed(&map), stretched.transformed(&map));
        assert!(matches!((&turned, &other), (Shape::Sphere { turn: Some(_), .. }, Shape::Ellipsoid { .. })));
        for n in [DVec3::new(0.3, 0.2, 0.9), DVec3::new(-0.6, 0.5, -0.2), DVec3::new(0.1, -0.9, 0.3)].map(DVec3::normalize) {
            let (found, tangents) = at_direction(&turned, &still, n, 0.0);
            let (expected, others) = at_direction(&other, &still, n, 0.0);
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5), "{found:?} {expected:?}");
            assert!(tangents.iter().zip(others).all(|(a, b)| a.distance(b) < 1e-3), "{tangents:?} {others:?}");
            // In the frame of the ball they are those of the ball at rest.
            let local = map.matrix3.inverse() * n;
            let (at_rest, _) = at_direction(&ball, &still, local, 0.0);
            assert!(found.iter().zip(at_rest).all(|(a, b)| (a - b).abs() < 1e-5), "{found:?} {at_rest:?}");
        }
    }
    for map in [DAffine3::from_scale(DVec3::splat(0.3)), DAffine3::from_translation(DVec3::ONE)] {
        assert!(matches!(ball.transformed(&map), Shape::Sphere { turn: None, .. }), "its kernels read no turn");
    }
    let stretched = ball.transformed(&turn).transformed(&DAffine3::from_scale(DVec3::new(1.0, 2.0, 1.0)));
    let axes = DMat3::from_diagonal(DVec3::new(1.0, 2.0, 1.0)) * turn.matrix3 * 2.0;
    assert!(matches!(stretched, Shape::Ellipsoid { axes: found, .. } if found.abs_diff_eq(axes, 1e-12)));
}

#[test]
fn turned_balls_lie_beside_others_and_turn_as_they_move() {
    let turn = |degrees: f64| DAffine3::from_rotation_y(degrees.to_radians());
    let ball = Shape::sphere(DVec3::ZERO, 1.0);
    let shapes = [ball.clone(), ball.transformed(&turn(90.0)), ball.clone(), ball.transformed(&turn(-45.0))];
    let still = Motion::default();
    let all = Shapes::new(shapes.iter().map(|shape| (shape, &still)), DVec3::ZERO);
    for (id, shape) in shapes.iter().enumerate() {
        let n = DVec3::new(0.6, 0.48, 0.64);
        let at = all.surface_point(One, &place(id as u32), v(n));
        let found = all.coordinates(One, &place(id as u32), &at);
        assert_eq!([lane(found.u), lane(found.v)], at_direction(shape, &still, n, 0.0).0, "as if it were alone");
    }
    let spin = Motion(vec![TransformStep::Rotate { axis: DVec3::Y, turns: Turns::from_degrees(60.0) }]);
    let n = DVec3::new(0.8, 0.0, 0.6);
    let (moved, _) = at_direction(&ball.transformed(&turn(30.0)), &spin, n, 1.0);
    let (turned, _) = at_direction(&ball.transformed(&turn(90.0)), &still, n, 0.0);
    assert!((moved[0] - turned[0]).abs() < 1e-5, "{moved:?} {turned:?}");
}
