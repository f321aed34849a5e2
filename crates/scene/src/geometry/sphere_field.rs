//! Procedural fields of spheres, for scenes, tests and benchmarks.
use glam::{DVec3, UVec3};

use super::Shape;
use crate::sampling::hash::{GOLDEN, hash_one};

/// Cells per sphere, so that no rows are visible.
const CELLS: f64 = 2.0;
/// Minimum radius, as a fraction of the largest that fits into a cell.
const LEAST_RADIUS: f64 = 0.4;
const MOST_RADIUS: f64 = 0.95;

/// Generates `count` disjoint spheres in the box that starts at `min`. Each has its own cell of a grid; its number and `seed`
/// determine its radius and its position there.
pub fn sphere_field(count: u32, min: DVec3, size: DVec3, seed: u32) -> Vec<Shape> {
    let grid = grid(count, size);
    let cell = size / grid.as_dvec3();
    let cells = u128::from(grid.x) * u128::from(grid.y) * u128::from(grid.z);
    let sphere = |number: u32| {
        let mut word = hash_one(seed ^ hash_one(number));
        let mut uniform = || {
            word = hash_one(word.wrapping_add(GOLDEN));
            f64::from(word) / f64::from(u32::MAX)
        };
        // One of the cells that are for this sphere.
        let [first, next] = [number, number + 1].map(|n| (u128::from(n) * cells).div_ceil(u128::from(count)));
        let at = (first + (uniform() * (next - first) as f64) as u128).min(next - 1);
        let (column, row) = (at % u128::from(grid.x), at / u128::from(grid.x));
        let (row, layer) = (row % u128::from(grid.y), row / u128::from(grid.y));
        let corner = min + cell * DVec3::new(column as f64, row as f64, layer as f64);
        let radius = cell.min_element() / 2.0 * (LEAST_RADIUS + (MOST_RADIUS - LEAST_RADIUS) * uniform());
        let room = cell - 2.0 * radius;
        Shape::sphere(corner + radius + room * DVec3::new(uniform(), uniform(), uniform()), radius)
    };
    (0..count).map(sphere).collect()
}

/// A grid of at least [`CELLS`] times `count` cells, which are roughly cubes.
fn grid(count: u32, size: DVec3) -> UVec3 {
    let count = f64::from(count) * CELLS;
    let mut edge = (size.element_product() / count).cbrt();
    loop {
        let cells = (size / edge).floor().max(DVec3::ONE);
        if cells.element_product() >= count {
            return cells.as_uvec3();
        }
        edge *= 0.99;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cell that is rounded up in every direction would be half as wide across a rod as along it.
    #[test]
    fn the_cells_of_a_rod_are_a_row() {
        assert_eq!(grid(68, DVec3::new(100.0, 1.0, 1.0)), UVec3::new(136, 1, 1));
    }

    #[test]
    fn spheres_lie_in_the_box_and_apart() {
        for (count, size) in [
            (1, DVec3::ONE),
            (300, DVec3::new(3.0, 0.2, 1.0)),
            (13, DVec3::ONE),
            (1000, DVec3::new(1.0, 1.0, 1e-3)),
            (20, DVec3::new(1e6, 1e6, 1e-9)),
        ] {
            let spheres: Vec<_> = sphere_field(count, DVec3::ONE, size, 7).iter().map(Shape::bounding_sphere).collect();
            assert_eq!(spheres.len(), count as usize);
            for (i, (center, radius)) in spheres.iter().enumerate() {
                let place = *center - DVec3::ONE;
                assert!((place - *radius).min_element() >= -1e-9 && (size - place - *radius).min_element() >= -1e-9);
                assert!(spheres[..i].iter().all(|(other, r)| other.distance(*center) > r + radius));
            }
        }
    }
}
