//! Transforms of the parameters of a shape.
use glam::{DAffine3, DVec3};

use super::Transform;
use crate::declare::OwnedValue;

/// Parameters of a shape and their new values.
pub type Changes = Vec<(&'static str, OwnedValue)>;

/// A transform and the map of points that it is about its pivot.
pub struct PointMap<'a> {
    /// The transform.
    pub change: &'a Transform,
    /// The map, in world space.
    pub map: &'a DAffine3,
}

impl PointMap<'_> {
    pub(super) fn point(&self, p: DVec3) -> OwnedValue {
        OwnedValue::Vector(self.map.transform_point3(p))
    }

    pub(super) fn edge(&self, v: DVec3) -> OwnedValue {
        OwnedValue::Vector(self.map.transform_vector3(v))
    }

    /// A length, if all lengths change by the same factor in every direction.
    pub(super) fn length(&self, x: f64) -> Option<OwnedValue> {
        let factor = match self.change {
            Transform::Translate(_) => 1.0,
            Transform::Scale(factors) if factors.x == factors.y && factors.y == factors.z && factors.x > 0.0 => factors.x,
            _ => return None,
        };
        Some(OwnedValue::Number(x * factor))
    }

    pub(super) fn only_translates(&self) -> bool {
        matches!(self.change, Transform::Translate(_))
    }

    /// Whether a box along the axes remains one, and none of its sides trade places.
    pub(super) fn keeps_axes(&self) -> bool {
        match self.change {
            Transform::Scale(factors) => factors.min_element() > 0.0,
            _ => self.only_translates(),
        }
    }

    pub(super) fn mirrors(&self) -> bool {
        self.map.matrix3.determinant() < 0.0
    }
}
