//! Transforms between local and world space, in lanes, each at its own time.
use glam::{DAffine3, DMat3, DVec3};

use super::TransformStep;
use noisefall_base::math::{F, Lanes, V, trig::sin_cos_turns};

/// The transform at time 0: an affine map and its inverse, rounded.
pub(super) struct StaticTransform {
    axes: [[f32; 3]; 3],
    origin: [f32; 3],
    rows: [[f32; 3]; 3],
}

impl StaticTransform {
    pub const IDENTITY: StaticTransform = {
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        StaticTransform { axes, origin: [0.0; 3], rows: axes }
    };

    pub fn new(map: &DAffine3) -> StaticTransform {
        let columns = |matrix: &DMat3| [0, 1, 2].map(|axis| matrix.col(axis).as_vec3().to_array());
        let rows = columns(&map.matrix3.inverse().transpose());
        StaticTransform { axes: columns(&map.matrix3), origin: map.translation.as_vec3().to_array(), rows }
    }
}

/// An affine map in lanes and its inverse.
pub(super) struct LaneTransform<L: Lanes> {
    /// Images of the axes, and of the origin.
    pub axes: [V<L>; 3],
    origin: V<L>,
    /// Rows of the inverse of `axes`.
    pub rows: [V<L>; 3],
}

impl<L: Lanes> LaneTransform<L> {
    /// The transform at `time`.
    #[inline(always)]
    pub fn new(l: L, at_rest: &StaticTransform, motion: &[TransformStep], time: F<L>) -> Self {
        let mut axes = three(l, &at_rest.axes);
        let mut origin = V::splat(l, at_rest.origin);
        if motion.is_empty() {
            return LaneTransform { axes, origin, rows: three(l, &at_rest.rows) };
        }
        for step in motion {
            let partial = Partial::new(l, step, time);
            axes = [partial.turn(axes[0]), partial.turn(axes[1]), partial.turn(axes[2])];
            origin = partial.turn(origin) + partial.way;
        }
        let [a, b, c] = axes;
        let (bc, ca, ab) = (b.cross(c), c.cross(a), a.cross(b));
        let scale = 1.0 / a.dot(bc);
        LaneTransform { axes, origin, rows: [bc * scale, ca * scale, ab * scale] }
    }

    #[inline(always)]
    pub fn vector_to_local(&self, v: V<L>) -> V<L> {
        V { x: self.rows[0].dot(v), y: self.rows[1].dot(v), z: self.rows[2].dot(v) }
    }

    #[inline(always)]
    pub fn point_to_local(&self, p: V<L>) -> V<L> {
        self.vector_to_local(p - self.origin)
    }

    #[inline(always)]
    pub fn vector_to_world(&self, v: V<L>) -> V<L> {
        self.axes[0] * v.x + (self.axes[1] * v.y + self.axes[2] * v.z)
    }

    #[inline(always)]
    pub fn point_to_world(&self, p: V<L>) -> V<L> {
        self.vector_to_world(p) + self.origin
    }

    /// The image of a covector such as a normal, not normalised.
    #[inline(always)]
    pub fn normal_to_world(&self, n: V<L>) -> V<L> {
        self.rows[0] * n.x + (self.rows[1] * n.y + self.rows[2] * n.z)
    }

    /// Upper bound of the error of [`LaneTransform::point_to_local`] at `p`, summed over the local coordinates.
    #[inline(always)]
    pub fn rounding(&self, p: V<L>) -> F<L> {
        // Each coordinate is rounded as the differences to the origin, the products and two sums.
        const ROUNDINGS: f32 = 3.0 * f32::EPSILON;
        let [a, b, c] = self.rows;
        let size = p.max_abs() + self.origin.max_abs();
        (sum_of_sizes(a) + (sum_of_sizes(b) + sum_of_sizes(c))) * size * ROUNDINGS
    }
}

/// A fraction of a [`TransformStep`] in lanes.
struct Partial<L: Lanes> {
    axes: [V<L>; 3],
    way: V<L>,
}

impl<L: Lanes> Partial<L> {
    #[inline(always)]
    fn new(l: L, step: &TransformStep, time: F<L>) -> Self {
        let mut axes = columns(l, &DMat3::IDENTITY);
        let mut way = splat(l, DVec3::ZERO);
        match step {
            TransformStep::Translate(by) => way = splat(l, *by) * time,
            TransformStep::Rotate { axis, turns } => {
                let (sin, cos) = sin_cos_turns(turns.at(time));
                let axis = splat(l, *axis);
                // O. Rodrigues, 1840: v cos + (k × v) sin + k (k·v)(1 − cos).
                for e in &mut axes {
                    *e = *e * cos + (axis.cross(*e) * sin + axis * (axis.dot(*e) * (1.0 - cos)));
                }
            }
            TransformStep::Scale(factors) => {
                let [x, y, z] = (*factors - DVec3::ONE).as_vec3().to_array();
                axes[0].x = time * x + 1.0;
                axes[1].y = time * y + 1.0;
                axes[2].z = time * z + 1.0;
            }
            TransformStep::Matrix(map) => {
                for (e, goal) in axes.iter_mut().zip(columns(l, &map.matrix3)) {
                    *e = *e + (goal - *e) * time;
                }
                way = splat(l, map.translation) * time;
            }
        }
        Partial { axes, way }
    }

    #[inline(always)]
    fn turn(&self, v: V<L>) -> V<L> {
        self.axes[0] * v.x + (self.axes[1] * v.y + self.axes[2] * v.z)
    }
}

#[inline(always)]
fn splat<L: Lanes>(l: L, v: DVec3) -> V<L> {
    V::splat(l, v.as_vec3().to_array())
}

#[inline(always)]
fn columns<L: Lanes>(l: L, matrix: &DMat3) -> [V<L>; 3] {
    [splat(l, matrix.x_axis), splat(l, matrix.y_axis), splat(l, matrix.z_axis)]
}

#[inline(always)]
fn sum_of_sizes<L: Lanes>(v: V<L>) -> F<L> {
    v.x.abs() + (v.y.abs() + v.z.abs())
}

#[inline(always)]
fn three<L: Lanes>(l: L, vectors: &[[f32; 3]; 3]) -> [V<L>; 3] {
    [V::splat(l, vectors[0]), V::splat(l, vectors[1]), V::splat(l, vectors[2])]
}
