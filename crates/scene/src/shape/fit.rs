//! Gives a shape of another kind the place and the size of the one before.
use glam::DVec3;

use super::{Changes, Transform, tidied};
use crate::geometry::Shape;
use noisefall_base::declare::OwnedValue;

/// Least extent along an axis, relative to the largest one: closed shapes have some height.
const THINNEST: f64 = 0.01;
/// Largest coordinate of a unit normal across an axis that counts as along it.
const ALONG: f64 = 1e-9;

/// The box around a shape, and what it faces if it is flat.
#[derive(Clone, Copy, Debug)]
pub struct Fit {
    min: DVec3,
    max: DVec3,
    /// The unit normal of the front of a flat shape.
    facing: Option<DVec3>,
}

impl Fit {
    /// The box around shapes. `None` if there are none, or if they are a point.
    pub fn around(shapes: &[Shape]) -> Option<Fit> {
        let [min, max] = shapes.iter().map(Shape::corners).reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])?;
        let facing = match shapes {
            [Shape::Flat { edges: [u, v], mirrored, .. }] => u.cross(*v).try_normalize().map(|n| if *mirrored { -n } else { n }),
            _ => None,
        };
        ((max - min).max_element() > 0.0 && min.is_finite() && max.is_finite()).then_some(Fit { min, max, facing })
    }

    pub(super) fn center(&self) -> DVec3 {
        (self.min + self.max) / 2.0
    }

    /// Half of the largest extent.
    pub(super) fn half(&self) -> f64 {
        (self.max - self.min).max_element() / 2.0
    }

    /// Half of the extents, none of which is nothing.
    fn halves(&self) -> DVec3 {
        ((self.max - self.min) / 2.0).max(DVec3::splat(THINNEST * self.half()))
    }

    /// The corners of the box.
    pub(super) fn corners(&self) -> [DVec3; 2] {
        [self.center() - self.halves(), self.center() + self.halves()]
    }

    /// The transforms that take the cube from −1 to 1 to the middle of the box, as large as its largest extent.
    pub fn transforms(&self) -> Vec<Transform> {
        vec![
            Transform::Scale(tidied(DVec3::ONE, DVec3::splat(self.half()))),
            Transform::Translate(tidied(DVec3::ZERO, self.center())),
        ]
    }

    /// The centers of the lower and the upper end of an upright cylinder, and its radius.
    pub(super) fn cylinder(&self) -> ([DVec3; 2], f64) {
        let half = self.halves();
        ([-1.0, 1.0].map(|sign| self.center() + DVec3::Y * (sign * half.y)), half.x.max(half.z))
    }

    /// The normal of a flat shape: that of the one before, or else upwards, or along the thinnest axis of a thin box.
    pub(super) fn normal(&self) -> DVec3 {
        let size = self.max - self.min;
        let thin = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().find(|axis| size.dot(*axis) <= 0.5 * THINNEST * size.max_element());
        self.facing.or(thin).unwrap_or(DVec3::Y)
    }

    /// The largest distance from the center within the plane of a flat shape, along an axis.
    pub(super) fn radius(&self) -> f64 {
        self.square().1.map(|edge| edge.length() / 2.0).into_iter().fold(0.0, f64::max)
    }

    /// A rectangle in the middle of the box, with the [normal](Fit::normal) u × v: its first corner and its edges.
    pub(super) fn square(&self) -> (DVec3, [DVec3; 2]) {
        let n = self.normal();
        let side = if n.y.abs() > 0.7 { DVec3::Z.cross(n) } else { DVec3::Y.cross(n) }.normalize();
        let along = [side, n.cross(side)];
        let is_along_axis = (n.abs() - DVec3::splat(n.abs().max_element())).min_element() <= ALONG - 1.0;
        let size = self.max - self.min;
        let length = |direction: DVec3| if is_along_axis { size.dot(direction.abs()) } else { 2.0 * self.half() };
        let edges = along.map(|direction| direction * length(direction).max(2.0 * THINNEST * self.half()));
        (self.center() - (edges[0] + edges[1]) / 2.0, edges)
    }
}

/// A new value of a vector without the digits of rounding.
pub(super) fn vector(key: &'static str, before: DVec3, after: DVec3) -> (&'static str, OwnedValue) {
    (key, OwnedValue::Vector(tidied(before, after)))
}

/// A new value of a number without the digits of rounding.
pub(super) fn number(key: &'static str, before: f64, after: f64) -> (&'static str, OwnedValue) {
    (key, OwnedValue::Number(tidied(DVec3::splat(before), DVec3::splat(after)).x))
}

/// New corners of a box, whose keys begin with `min` and `max`.
pub(super) fn corners(keys: [&'static str; 2], before: [DVec3; 2], fit: &Fit) -> Changes {
    let after = fit.corners();
    [0, 1].map(|end| vector(keys[end], before[end], after[end])).into()
}
