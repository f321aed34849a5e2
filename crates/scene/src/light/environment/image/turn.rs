//! Rotations and mirrorings of an image of all directions.
use glam::{DMat3, DVec3};

use crate::shape::{Transform, product};
use noisefall_base::{
    declare::{Path, Problem},
    math::{Lanes, V},
};

/// An orthogonal matrix: the images of the axes.
pub struct Turn {
    axes: [[f32; 3]; 3],
}

/// Largest difference of the lengths of the axes, relative to their length, and of their cosines. Other programs write matrices in
/// single precision.
const ROUNDING: f64 = 1e-4;

impl Turn {
    /// The rotation or mirroring of a list of transforms; `None` if the list is empty. Translations and a common scale do not matter to
    /// directions.
    pub fn of(list: &[Transform]) -> Result<Option<Turn>, Problem> {
        if list.is_empty() {
            return Ok(None);
        }
        let matrix = product(list).map_err(|problem| problem.within(&Path::of("transform")))?.matrix3;
        let no_turn = || Problem::at("transform", "the transform distorts directions", "expected rotations and mirrorings");
        Turn::of_matrix(&matrix).ok_or_else(no_turn).map(Some)
    }

    /// The orthogonal matrix that is a matrix up to scale and rounding.
    pub fn of_matrix(matrix: &DMat3) -> Option<Turn> {
        let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
        let length = columns[0].length();
        let axes = columns.map(|axis| axis / length);
        let is_unit = |axis: &DVec3| (axis.length() - 1.0).abs() < ROUNDING;
        let is_right = [(0, 1), (1, 2), (2, 0)].into_iter().all(|(a, b)| axes[a].dot(axes[b]).abs() < ROUNDING);
        if !(axes.iter().all(is_unit) && is_right) {
            return None;
        }
        let x = axes[0].normalize();
        let y = (axes[1] - x * axes[1].dot(x)).normalize();
        let z = x.cross(y) * axes[2].dot(x.cross(y)).signum();
        Some(Turn { axes: [x, y, z].map(|axis| axis.as_vec3().to_array()) })
    }

    /// Whether both have the same bits.
    pub fn is_same(&self, other: &Turn) -> bool {
        let bits = |turn: &Turn| turn.axes.map(|axis| axis.map(f32::to_bits));
        bits(self) == bits(other)
    }

    /// A direction of the image, in the world.
    #[inline(always)]
    pub fn to_world<L: Lanes>(&self, l: L, d: V<L>) -> V<L> {
        let [a, b, c] = &self.axes;
        V::splat(l, *a) * d.x + (V::splat(l, *b) * d.y + V::splat(l, *c) * d.z)
    }

    /// A direction of the world, in the image: the inverse of an orthogonal matrix is its transpose.
    #[inline(always)]
    pub fn to_image<L: Lanes>(&self, l: L, d: V<L>) -> V<L> {
        let [a, b, c] = &self.axes;
        V { x: d.dot(V::splat(l, *a)), y: d.dot(V::splat(l, *b)), z: d.dot(V::splat(l, *c)) }
    }
}
