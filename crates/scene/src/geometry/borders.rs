//! Which flat shapes border on each other: walls that are objects of their own.
use std::collections::HashSet;

use glam::DVec3;

use super::{Outline, Shape};

/// Two corners are one if they are nearer than this part of the extent of all.
const SAME_CORNER: f64 = 1e-6;

/// Whether flat shapes with straight edges share corners.
pub(super) fn any_borders<'a>(shapes: impl Iterator<Item = &'a Shape> + Clone) -> bool {
    let corners = shapes.flat_map(corners);
    let extent = corners.clone().map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
    let mut cells = HashSet::new();
    // Corners in neighbouring cells of one grid are in one cell of the other.
    let cell = |corner: DVec3, shift: f64| (corner / (extent * SAME_CORNER) + shift).floor().as_i64vec3();
    corners.into_iter().any(|corner| {
        let [here, there] = [0.0, 0.5].map(|shift| (shift > 0.0, cell(corner, shift)));
        !cells.insert(here) | !cells.insert(there)
    })
}

/// The corners of a flat shape with straight edges; none of another one.
fn corners(shape: &Shape) -> impl Iterator<Item = DVec3> + Clone {
    let found = match shape {
        Shape::Flat { outline: Outline::Parallelogram, origin: o, edges: [a, b], .. } => vec![*o, *o + *a, *o + *b, *o + *a + *b],
        Shape::Flat { outline: Outline::Triangle, origin: o, edges: [a, b], .. } => vec![*o, *o + *a, *o + *b],
        _ => Vec::new(),
    };
    found.into_iter()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wall(origin: [f64; 3], edges: [[f64; 3]; 2]) -> Shape {
        let [origin, a, b] = [origin, edges[0], edges[1]].map(DVec3::from);
        Shape::Flat { outline: Outline::Parallelogram, origin, edges: [a, b], mirrored: false }
    }

    #[test]
    fn walls_with_common_corners_border_on_each_other() {
        let floor = wall([0.0; 3], [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
        let beside = wall([1.0 + 1e-9, 0.0, 0.0], [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]);
        let apart = wall([2.0, 0.0, 0.0], [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]);
        let ball = Shape::sphere(DVec3::ZERO, 1.0);
        assert!(any_borders([&floor, &ball, &beside].into_iter()));
        assert!(!any_borders([&floor, &ball, &apart].into_iter()) && !any_borders([&ball, &ball].into_iter()));
    }
}
