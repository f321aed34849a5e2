//! Surface coordinates and their tangents.
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{cases, exact, lane, place, point, v};
use crate::{
    geometry::{Coordinates, Shape},
    math::One,
};

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
