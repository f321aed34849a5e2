//! Transforms, and how they change while the shutter is open.
use std::f64::consts::TAU;

use glam::{DAffine3, DMat3, DQuat, DVec3};

use crate::math::{F, Lanes, V, round::floor, trig::sin_cos_turns};

/// One transform of a list. In motion, a part of it is done at a part of the time: of a way, of an angle, of what a factor
/// exceeds 1 by, of the difference of a matrix from the identity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    Translate(DVec3),
    /// About the unit axis, counter-clockwise seen from its tip; full turns are turned.
    Rotate {
        axis: DVec3,
        turns: f64,
    },
    Scale(DVec3),
    Matrix(DAffine3),
}

impl Step {
    /// The transform at the time from 0, where it is the identity, to 1, where it is complete.
    pub fn at(&self, time: f64) -> DAffine3 {
        match *self {
            Step::Translate(way) => DAffine3::from_translation(way * time),
            Step::Rotate { axis, turns } => DAffine3::from_quat(DQuat::from_axis_angle(axis, turns * TAU * time)),
            Step::Scale(factors) => DAffine3::from_scale(DVec3::ONE + (factors - DVec3::ONE) * time),
            Step::Matrix(map) => DAffine3 {
                matrix3: DMat3::IDENTITY + (map.matrix3 - DMat3::IDENTITY) * time,
                translation: map.translation * time,
            },
        }
    }
}

/// A list of transforms, the first one applied first, that is reached at the end of the shutter's time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion(pub Vec<Step>);

impl Motion {
    pub fn at(&self, time: f64) -> DAffine3 {
        self.0.iter().fold(DAffine3::IDENTITY, |before, step| step.at(time) * before)
    }

    /// A ray o + td carried to `time`, with d of unit length.
    #[inline(always)]
    pub fn carry<L: Lanes>(&self, l: L, o: V<L>, d: V<L>, time: F<L>) -> (V<L>, V<L>) {
        let pose = Pose::new(l, &DAffine3::IDENTITY, &self.0, time);
        (pose.point_to_world(o), pose.vector_to_world(d).normalized())
    }

    /// Whether it can be inverted at all times, at many of which it is tried.
    pub fn is_invertible(&self) -> bool {
        const TIMES: u32 = 256;
        let determinant = |i: u32| self.at(f64::from(i) / f64::from(TIMES)).matrix3.determinant();
        (0..=TIMES).all(|i| determinant(i) > 1e-9 && determinant(i).is_finite())
    }
}

/// An affine map in lanes and its inverse.
pub(super) struct Pose<L: Lanes> {
    /// Images of the axes, and of the origin.
    pub axes: [V<L>; 3],
    origin: V<L>,
    /// Rows of the inverse of `axes`.
    pub rows: [V<L>; 3],
}

impl<L: Lanes> Pose<L> {
    /// `still`, and then the motion up to `time`.
    #[inline(always)]
    pub fn new(l: L, still: &DAffine3, motion: &[Step], time: F<L>) -> Self {
        let mut axes = columns(l, &still.matrix3);
        let mut origin = splat(l, still.translation);
        for step in motion {
            let partial = Partial::new(l, step, time);
            axes = [partial.turn(axes[0]), partial.turn(axes[1]), partial.turn(axes[2])];
            origin = partial.turn(origin) + partial.way;
        }
        let [a, b, c] = axes;
        let (bc, ca, ab) = (b.cross(c), c.cross(a), a.cross(b));
        let scale = 1.0 / a.dot(bc);
        Pose { axes, origin, rows: [bc * scale, ca * scale, ab * scale] }
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

    /// The image of a covector, as a normal is: of another length.
    #[inline(always)]
    pub fn normal_to_world(&self, n: V<L>) -> V<L> {
        self.rows[0] * n.x + (self.rows[1] * n.y + self.rows[2] * n.z)
    }

    /// How far [`Pose::point_to_local`] may be off at `p`, in the local space: the sum over its coordinates.
    #[inline(always)]
    pub fn rounding(&self, p: V<L>) -> F<L> {
        // Each coordinate is rounded as the differences to the origin, the products and two sums.
        const ROUNDINGS: f32 = 3.0 * f32::EPSILON;
        let [a, b, c] = self.rows;
        let size = p.max_abs() + self.origin.max_abs();
        (sum_of_sizes(a) + (sum_of_sizes(b) + sum_of_sizes(c))) * size * ROUNDINGS
    }
}

/// A part of a [`Step`] in lanes.
struct Partial<L: Lanes> {
    axes: [V<L>; 3],
    way: V<L>,
}

impl<L: Lanes> Partial<L> {
    #[inline(always)]
    fn new(l: L, step: &Step, time: F<L>) -> Self {
        let mut axes = columns(l, &DMat3::IDENTITY);
        let mut way = splat(l, DVec3::ZERO);
        match step {
            Step::Translate(by) => way = splat(l, *by) * time,
            Step::Rotate { axis, turns } => {
                let angle = time * *turns as f32;
                let (sin, cos) = sin_cos_turns(angle - floor(angle).0);
                let axis = splat(l, *axis);
                // O. Rodrigues, 1840: v cos + (k × v) sin + k (k·v)(1 − cos).
                for e in &mut axes {
                    *e = *e * cos + (axis.cross(*e) * sin + axis * (axis.dot(*e) * (1.0 - cos)));
                }
            }
            Step::Scale(factors) => {
                let [x, y, z] = (*factors - DVec3::ONE).as_vec3().to_array();
                axes[0].x = time * x + 1.0;
                axes[1].y = time * y + 1.0;
                axes[2].z = time * z + 1.0;
            }
            Step::Matrix(map) => {
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
