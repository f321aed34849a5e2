//! A flat disk.
use glam::DVec3;

use super::{
    Build, CENTER, Changes, Placement, PointMap, RADII, RADIUS, ShapeBuilder, ShapeKind,
    fit::{Fit, number, vector},
};
use crate::geometry::Shape;
use noisefall_base::declare::{Declare, Kind, Parameter, Parameters, Problem};

/// A disk.
#[derive(Clone, Debug, PartialEq)]
pub struct Disk {
    /// Centre, metres.
    pub center: DVec3,
    /// Normal of the front, of any length.
    pub normal: DVec3,
    /// Radius, metres.
    pub radius: f64,
}

impl Default for Disk {
    fn default() -> Self {
        Disk { center: DVec3::ZERO, normal: DVec3::Y, radius: 1.0 }
    }
}

impl Kind for Disk {
    const KIND: Parameter = Parameter::new("disk", "A flat disk.").aliases("circle disc");
}

impl Declare for Disk {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const NORMAL: Parameter = Parameter::new("normal", "Normal of the front, of any length.").symbol("n").required();
        p.point(&CENTER, &mut self.center);
        p.point(&NORMAL, &mut self.normal);
        p.number(&RADIUS, &mut self.radius, RADII);
    }
}

impl Build for Disk {
    fn shapes(&self, _: &mut ShapeBuilder) -> Result<Vec<Shape>, Problem> {
        let normal = self.normal.try_normalize();
        let normal = normal.ok_or_else(|| Problem::at("normal", "the normal has no direction", "it must not be zero"))?;
        Ok(vec![Shape::disk(self.center, normal, self.radius)])
    }

    fn fitted(&self, fit: &Fit) -> Option<Changes> {
        let normal = vector("normal", self.normal, fit.normal());
        Some(vec![vector("center", self.center, fit.center()), normal, number("radius", self.radius, fit.radius())])
    }

    fn placed(&self, placement: &Placement) -> Option<ShapeKind> {
        Some(Disk { center: placement.above(), normal: placement.up(), radius: placement.half() }.into())
    }

    fn transformed(&self, by: &PointMap) -> Option<Changes> {
        Some(vec![("center", by.point(self.center)), ("radius", by.length(self.radius)?)])
    }
}
