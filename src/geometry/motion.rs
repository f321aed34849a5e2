//! Transforms, and their interpolation from time 0 to 1.
use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::{
    pose::{Pose, Rest},
    turns::Turns,
};
use crate::math::{F, Lanes, V};

/// One transform of a list. In motion, translation, angle, scale factor − 1 and matrix − identity grow linearly with time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    Translate(DVec3),
    /// Rotation about the unit axis, counter-clockwise seen from its tip. Full turns count in motion.
    Rotate {
        axis: DVec3,
        turns: Turns,
    },
    Scale(DVec3),
    Matrix(DAffine3),
}

impl Step {
    /// The transform at a time from 0, where it is the identity, to 1, where it is complete.
    pub fn at(&self, time: f64) -> DAffine3 {
        match *self {
            // As steps from 1, small factors would lose their digits.
            Step::Scale(factors) if time == 1.0 => DAffine3::from_scale(factors),
            Step::Matrix(map) if time == 1.0 => map,
            Step::Translate(way) => DAffine3::from_translation(way * time),
            Step::Rotate { axis, turns } => DAffine3::from_quat(DQuat::from_axis_angle(axis, turns.radians_at(time))),
            Step::Scale(factors) => DAffine3::from_scale(DVec3::ONE + (factors - DVec3::ONE) * time),
            Step::Matrix(map) => DAffine3 {
                matrix3: DMat3::IDENTITY + (map.matrix3 - DMat3::IDENTITY) * time,
                translation: map.translation * time,
            },
        }
    }
}

/// A list of transforms, applied first to last, that is complete at time 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion(pub Vec<Step>);

impl Motion {
    pub fn at(&self, time: f64) -> DAffine3 {
        self.0.iter().fold(DAffine3::IDENTITY, |before, step| step.at(time) * before)
    }

    /// Transforms a ray o + td to `time`, with d of unit length.
    #[inline(always)]
    pub fn carry<L: Lanes>(&self, l: L, o: V<L>, d: V<L>, time: F<L>) -> (V<L>, V<L>) {
        let pose = Pose::new(l, &Rest::IDENTITY, &self.0, time);
        (pose.point_to_world(o), pose.vector_to_world(d).normalized())
    }

    /// Whether the transform is invertible at all times; tests many of them.
    pub fn is_invertible(&self) -> bool {
        const TIMES: u32 = 256;
        let determinant = |i: u32| self.at(f64::from(i) / f64::from(TIMES)).matrix3.determinant();
        (0..=TIMES).all(|i| determinant(i) > 1e-9 && determinant(i).is_finite())
    }
}
