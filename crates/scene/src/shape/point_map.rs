//! Transforms of the parameters of a shape.
use glam::{DAffine3, DVec3};

use super::Transform;
use noisefall_base::declare::OwnedValue;

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
        OwnedValue::Vector(tidied(p, self.map.transform_point3(p)))
    }

    pub(super) fn edge(&self, v: DVec3) -> OwnedValue {
        OwnedValue::Vector(tidied(v, self.map.transform_vector3(v)))
    }

    /// A length, if all lengths change by the same factor in every direction.
    pub(super) fn length(&self, x: f64) -> Option<OwnedValue> {
        let factor = match self.change {
            Transform::Translate(_) => 1.0,
            Transform::Scale(factors) if factors.x == factors.y && factors.y == factors.z && factors.x > 0.0 => factors.x,
            _ => return None,
        };
        Some(OwnedValue::Number(tidied(DVec3::splat(x), DVec3::splat(x * factor)).x))
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

/// A changed vector without the digits that come from rounding: 0.57 in place of 0.5700000000000001. Relative to the largest coordinate
/// it moves by less than 1e-13; coordinates that have not changed stay as they are.
pub fn tidied(before: DVec3, after: DVec3) -> DVec3 {
    /// Significant digits of the largest coordinate.
    const DIGITS: f64 = 14.0;
    let largest = before.abs().max_element().max(after.abs().max_element());
    if largest == 0.0 || !largest.is_finite() {
        return after;
    }
    let decimals = (DIGITS - 1.0 - largest.log10().floor()).clamp(0.0, 300.0) as usize;
    let tidy = |x: f64| format!("{x:.decimals$}").parse().unwrap_or(x) + 0.0;
    let coordinate = |axis: usize| if after[axis] == before[axis] { before[axis] } else { tidy(after[axis]) };
    DVec3::from_array([0, 1, 2].map(coordinate))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sum_has_no_digits_of_rounding_and_unchanged_numbers_keep_theirs() {
        let odd = 0.123_456_789_012_345_67;
        let (before, by) = (DVec3::new(0.44, odd, 1000.1), DVec3::new(0.13, 0.0, -1000.0));
        assert_ne!((before + by).x, 0.57);
        assert_eq!(tidied(before, before + by), DVec3::new(0.57, odd, 0.1));
        assert_eq!(tidied(DVec3::X, DVec3::new(6e-17, 1.0, 0.0)), DVec3::Y, "a quarter turn");
        assert_eq!(tidied(DVec3::ZERO, DVec3::ZERO), DVec3::ZERO);
    }
}
