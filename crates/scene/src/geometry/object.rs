//! The objects of a scene before they are sorted into lists and a tree.
use super::{Shape, bounds::Bounds};

/// An object to find, with its bounds.
pub(super) struct Object<'a> {
    pub bounds: Bounds,
    pub kind: ObjectKind<'a>,
}

#[derive(Clone, Copy)]
pub(super) enum ObjectKind<'a> {
    /// An analytic shape, whose first piece is primitive `first`.
    Analytic { first: u32, shape: &'a Shape },
    /// Index among the instances.
    Instance(u32),
}

impl ObjectKind<'_> {
    /// The cost of a test of all lanes, relative to a flat shape.
    pub fn cost(self) -> f32 {
        match self {
            ObjectKind::Analytic { shape: Shape::Cylinder { capped: true, .. }, .. } => 4.0,
            ObjectKind::Analytic { shape: Shape::Cuboid { .. } | Shape::Cylinder { .. } | Shape::Ellipsoid { .. }, .. } => 2.0,
            // In a cluster, which most registers of rays miss: a tree over 256 spheres takes as long.
            ObjectKind::Analytic { shape: Shape::Sphere { .. }, .. } => 0.25,
            // For an instance, the cost of testing whether any lane comes near.
            ObjectKind::Analytic { .. } | ObjectKind::Instance(_) => 1.0,
        }
    }
}
