//! Lists of transforms over time.
use glam::DAffine3;

use super::{
    step::TransformStep,
    transform::{LaneTransform, StaticTransform},
};
use noisefall_base::math::{F, Lanes, V};

/// A list of transforms, applied first to last, that is complete at time 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion(pub Vec<TransformStep>);

impl Motion {
    /// The map at a time from 0 to 1.
    pub fn at(&self, time: f64) -> DAffine3 {
        self.0.iter().fold(DAffine3::IDENTITY, |before, step| step.at(time) * before)
    }

    /// Transforms a ray o + td to `time`, with d of unit length.
    #[inline(always)]
    pub fn carry<L: Lanes>(&self, l: L, o: V<L>, d: V<L>, time: F<L>) -> (V<L>, V<L>) {
        let transform = LaneTransform::new(l, &StaticTransform::IDENTITY, &self.0, time);
        (transform.point_to_world(o), transform.vector_to_world(d).normalized())
    }

    /// The point at time 0 that is moved to `p`.
    #[inline(always)]
    pub fn carry_back<L: Lanes>(&self, l: L, p: V<L>, time: F<L>) -> V<L> {
        LaneTransform::new(l, &StaticTransform::IDENTITY, &self.0, time).point_to_local(p)
    }

    /// Transforms a vector to `time`, and returns how many times smaller areas across it become.
    #[inline(always)]
    pub fn carry_vector<L: Lanes>(&self, l: L, v: V<L>, time: F<L>) -> (V<L>, F<L>) {
        let transform = LaneTransform::new(l, &StaticTransform::IDENTITY, &self.0, time);
        let moved = transform.vector_to_world(v);
        let [a, b, c] = transform.axes;
        let longer = (moved.length_squared() / v.length_squared()).sqrt();
        (moved, longer / a.dot(b.cross(c)).abs())
    }

    /// Whether the transform is invertible at all times; tests many of them.
    pub fn is_invertible(&self) -> bool {
        const TIMES: u32 = 256;
        let determinant = |i: u32| self.at(f64::from(i) / f64::from(TIMES)).matrix3.determinant();
        (0..=TIMES).all(|i| determinant(i) > 1e-9 && determinant(i).is_finite())
    }
}
