//! A cylinder, closed by disks or open.
use glam::DVec3;

use super::{
    Build, Changes, Placement, PointMap, RADII, RADIUS, ShapeBuilder, ShapeKind,
    fit::{Fit, number, vector},
};
use crate::geometry::Shape;
use noisefall_base::declare::{Declare, Kind, Parameter, Parameters, Problem};

/// A cylinder between two points.
#[derive(Clone, Debug, PartialEq)]
pub struct Cylinder {
    /// Centre of one end, metres.
    pub base: DVec3,
    /// Centre of the other end, metres.
    pub top: DVec3,
    /// Radius, metres.
    pub radius: f64,
    /// Whether disks close the ends.
    pub capped: bool,
}

impl Default for Cylinder {
    fn default() -> Self {
        Cylinder { base: DVec3::ZERO, top: DVec3::Y, radius: 0.5, capped: true }
    }
}

impl Kind for Cylinder {
    const KIND: Parameter = Parameter::new("cylinder", "A circular cylinder between two points.").aliases("tube pipe");
}

impl Declare for Cylinder {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const BASE: Parameter =
            Parameter::new("base", "Centre of one end.").unit("m").required().aliases("position origin from pos location p0");
        const TOP: Parameter = Parameter::new("top", "Centre of the other end.").unit("m").required().aliases("to p1");
        const CAPPED: Parameter = Parameter::new("capped", "Whether disks close the ends.");
        p.point(&BASE, &mut self.base);
        p.point(&TOP, &mut self.top);
        p.number(&RADIUS, &mut self.radius, RADII);
        p.flag(&CAPPED, &mut self.capped);
    }
}

impl Build for Cylinder {
    fn shapes(&self, _: &mut ShapeBuilder) -> Result<Vec<Shape>, Problem> {
        if (self.top - self.base).try_normalize().is_none() {
            return Err(Problem::at("top", "the cylinder has no height", "`top` must differ from `base`"));
        }
        Ok(vec![Shape::cylinder(self.base, self.top, self.radius, self.capped)])
    }

    fn fitted(&self, fit: &Fit) -> Option<Changes> {
        let ([base, top], radius) = fit.cylinder();
        Some(vec![vector("base", self.base, base), vector("top", self.top, top), number("radius", self.radius, radius)])
    }

    fn placed(&self, placement: &Placement) -> Option<ShapeKind> {
        let (base, top) = (placement.reached(0.0), placement.reached(placement.size()));
        Some(Cylinder { base, top, radius: placement.half() / 2.0, ..self.clone() }.into())
    }

    fn transformed(&self, by: &PointMap) -> Option<Changes> {
        Some(vec![("base", by.point(self.base)), ("top", by.point(self.top)), ("radius", by.length(self.radius)?)])
    }
}
