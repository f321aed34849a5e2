//! Single transforms, and their interpolation from time 0 to 1.
use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::turns::Turns;

/// One transform of a list. In motion, translation, angle, scale factor − 1 and matrix − identity grow linearly with time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TransformStep {
    /// Translation in metres.
    Translate(DVec3),
    /// Rotation about the unit axis, counter-clockwise seen from its tip. Full turns count in motion.
    Rotate {
        /// Unit axis through the origin.
        axis: DVec3,
        /// Angle in turns.
        turns: Turns,
    },
    /// Scaling by a factor per axis.
    Scale(DVec3),
    /// Any affine transform.
    Matrix(DAffine3),
}

impl TransformStep {
    /// The transform at a time from 0, where it is the identity, to 1, where it is complete.
    pub fn at(&self, time: f64) -> DAffine3 {
        match *self {
            // As steps from 1, small factors would lose their digits.
            TransformStep::Scale(factors) if time == 1.0 => DAffine3::from_scale(factors),
            TransformStep::Matrix(map) if time == 1.0 => map,
            TransformStep::Translate(way) => DAffine3::from_translation(way * time),
            TransformStep::Rotate { axis, turns } => DAffine3::from_quat(DQuat::from_axis_angle(axis, turns.radians_at(time))),
            TransformStep::Scale(factors) => DAffine3::from_scale(DVec3::ONE + (factors - DVec3::ONE) * time),
            TransformStep::Matrix(map) => DAffine3 {
                matrix3: DMat3::IDENTITY + (map.matrix3 - DMat3::IDENTITY) * time,
                translation: map.translation * time,
            },
        }
    }
}
