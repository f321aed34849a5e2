//! The oracle itself: its distances from surfaces against points that were moved off them.
use rand::{SeedableRng, rngs::SmallRng};

use super::{cases, exact, place, point, v};
use crate::{
    geometry::oracle::{distance, meetings},
    math::One,
};

#[test]
fn points_moved_off_a_surface_are_as_far_from_it() {
    let mut rng = SmallRng::seed_from_u64(9);
    for case in cases() {
        let shapes = case.shapes();
        for (id, piece) in case.shape.pieces().iter().enumerate() {
            for i in 0..200 {
                let on = point(&mut rng, piece);
                assert!(distance(piece, on) < 1e-9 * (case.size() + on.length()), "{}", case.name);
                let n = exact(shapes.surface_point(One, &place(id as u32), v(on)).n_geometric);
                let h = case.size() * [1e-3, -1e-3][i % 2];
                let found = distance(piece, on + n * h);
                assert!((found / h.abs() - 1.0).abs() < 0.05, "{}: {found:e} of {h:e}", case.name);
            }
        }
    }
}

#[test]
fn meetings_lie_on_the_surface_and_have_the_clearance_that_they_say() {
    let mut rng = SmallRng::seed_from_u64(10);
    for case in cases() {
        for piece in case.shape.pieces() {
            for _ in 0..200 {
                let (at, aside) = (point(&mut rng, &piece), super::unit_vector(&mut rng));
                let o = at + super::unit_vector(&mut rng) * case.size() * 3.0;
                let d = (at - o).normalize();
                let moved = (aside - d * aside.dot(d)).normalize();
                for meeting in meetings(&piece, o, d, 0.0) {
                    assert!(distance(&piece, o + d * meeting.t) < 1e-7 * (o.length() + case.size()), "{}", case.name);
                    let still = meetings(&piece, o + moved * (meeting.clearance * 0.99), d, 0.0);
                    assert!(!still.is_empty() || meeting.clearance <= 0.0, "{}: {meeting:?}", case.name);
                }
            }
        }
    }
}
