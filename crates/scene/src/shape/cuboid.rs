//! An axis-aligned box; transforms can rotate and shear it.
use glam::DMat3;

use super::{
    Build, Changes, Placement, PointMap, ShapeBuilder, ShapeKind,
    bounds::Bounds,
    fit::{Fit, corners},
};
use crate::geometry::Shape;
use noisefall_base::declare::{Declare, Kind, Parameter, Parameters, Problem};

/// An axis-aligned box between two opposite corners.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cuboid(pub Bounds);

impl Kind for Cuboid {
    const KIND: Parameter = Parameter::new("cuboid", "A box with edges along the axes.").aliases("box cube aabb");
}

impl Declare for Cuboid {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        self.0.parameters(p);
    }
}

impl Build for Cuboid {
    fn shapes(&self, _: &mut ShapeBuilder) -> Result<Vec<Shape>, Problem> {
        Ok(vec![Shape::Cuboid { origin: self.0.min, edges: DMat3::from_diagonal(self.0.size()?) }])
    }

    fn fitted(&self, fit: &Fit) -> Option<Changes> {
        Some(corners(["min", "max"], [self.0.min, self.0.max], fit))
    }

    fn placed(&self, placement: &Placement) -> Option<ShapeKind> {
        Some(Cuboid(placement.cube()).into())
    }

    fn transformed(&self, by: &PointMap) -> Option<Changes> {
        by.keeps_axes().then(|| vec![("min", by.point(self.0.min)), ("max", by.point(self.0.max))])
    }
}
