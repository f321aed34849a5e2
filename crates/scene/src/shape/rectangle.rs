//! A rectangle, or any parallelogram.
use glam::DVec3;

use super::{
    Build, Changes, Placement, PointMap, ShapeBuilder, ShapeKind, are_parallel,
    fit::{Fit, vector},
};
use crate::geometry::{Outline, Shape};
use noisefall_base::declare::{Declare, Kind, Parameter, Parameters, Problem};

/// A parallelogram.
#[derive(Clone, Debug, PartialEq)]
pub struct Rectangle {
    /// The corner where u = v = 0, metres.
    pub origin: DVec3,
    /// The edge from there to the corner where u = 1, metres.
    pub edge_u: DVec3,
    /// The edge from there to the corner where v = 1, metres. The front is on the side of u × v.
    pub edge_v: DVec3,
}

impl Default for Rectangle {
    fn default() -> Self {
        Rectangle { origin: DVec3::ZERO, edge_u: DVec3::X, edge_v: DVec3::Y }
    }
}

impl Kind for Rectangle {
    const KIND: Parameter = Parameter::new("rectangle", "A parallelogram, given by a corner and two edges.")
        .aliases("quad plane square parallelogram");
}

impl Declare for Rectangle {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const ORIGIN: Parameter =
            Parameter::new("origin", "The corner where u = v = 0.").unit("m").required().aliases("corner position");
        const EDGE_U: Parameter =
            Parameter::new("edge_u", "Edge from that corner to the corner where u = 1.").unit("m").required().aliases("u");
        const EDGE_V: Parameter =
            Parameter::new("edge_v", "Edge from that corner to the corner where v = 1. The front is the side of u × v.")
                .unit("m")
                .required()
                .aliases("v");
        p.point(&ORIGIN, &mut self.origin);
        p.point(&EDGE_U, &mut self.edge_u);
        p.point(&EDGE_V, &mut self.edge_v);
    }
}

impl Build for Rectangle {
    fn shapes(&self, _: &mut ShapeBuilder) -> Result<Vec<Shape>, Problem> {
        let edges = [self.edge_u, self.edge_v];
        if are_parallel(edges) {
            let label = "`edge_u` and `edge_v` must not be zero or parallel";
            return Err(Problem::at("edge_v", "the rectangle has no area", label));
        }
        Ok(vec![Shape::Flat { outline: Outline::Parallelogram, origin: self.origin, edges, mirrored: false }])
    }

    fn fitted(&self, fit: &Fit) -> Option<Changes> {
        let (origin, [u, v]) = fit.square();
        Some(vec![vector("origin", self.origin, origin), vector("edge_u", self.edge_u, u), vector("edge_v", self.edge_v, v)])
    }

    fn placed(&self, placement: &Placement) -> Option<ShapeKind> {
        let (origin, [edge_u, edge_v]) = placement.square();
        Some(Rectangle { origin, edge_u, edge_v }.into())
    }

    fn transformed(&self, by: &PointMap) -> Option<Changes> {
        let [u, v] = [self.edge_u, self.edge_v].map(|edge| by.edge(edge));
        (!by.mirrors()).then(|| vec![("origin", by.point(self.origin)), ("edge_u", u), ("edge_v", v)])
    }
}
