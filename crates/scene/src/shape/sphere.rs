//! A sphere.
use glam::DVec3;

use super::{
    Build, CENTER, Changes, Placement, PointMap, RADII, RADIUS, ShapeBuilder, ShapeKind,
    fit::{Fit, number, vector},
};
use crate::geometry::Shape;
use noisefall_base::declare::{Declare, Kind, Parameter, Parameters, Problem};

/// A sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct Sphere {
    /// Centre, metres.
    pub center: DVec3,
    /// Radius, metres.
    pub radius: f64,
}

impl Default for Sphere {
    fn default() -> Self {
        Sphere { center: DVec3::ZERO, radius: 1.0 }
    }
}

impl Kind for Sphere {
    const KIND: Parameter = Parameter::new("sphere", "A sphere; non-uniform scaling makes an ellipsoid.").aliases("ball");
}

impl Declare for Sphere {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const OF_SPHERE: Parameter =
            RADIUS.advice("to look at a sphere from inside, keep the radius positive; `flip = true` turns its normal");
        p.point(&CENTER, &mut self.center);
        p.number(&OF_SPHERE, &mut self.radius, RADII);
    }
}

impl Build for Sphere {
    fn shapes(&self, _: &mut ShapeBuilder) -> Result<Vec<Shape>, Problem> {
        Ok(vec![Shape::sphere(self.center, self.radius)])
    }

    fn fitted(&self, fit: &Fit) -> Option<Changes> {
        Some(vec![vector("center", self.center, fit.center()), number("radius", self.radius, fit.half())])
    }

    fn placed(&self, placement: &Placement) -> Option<ShapeKind> {
        let radius = placement.half();
        Some(Sphere { center: placement.reached(radius), radius }.into())
    }

    fn transformed(&self, by: &PointMap) -> Option<Changes> {
        Some(vec![("center", by.point(self.center)), ("radius", by.length(self.radius)?)])
    }
}
