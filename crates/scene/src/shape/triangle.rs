//! A triangle.
use glam::DVec3;

use super::{
    Build, Changes, Placement, PointMap, ShapeBuilder, ShapeKind, are_parallel,
    fit::{Fit, vector},
};
use crate::geometry::{Outline, Shape};
use noisefall_base::declare::{Declare, Kind, Parameter, Parameters, Problem};

/// A single triangle.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangle {
    /// First corner, metres.
    pub a: DVec3,
    /// Second corner, metres.
    pub b: DVec3,
    /// Third corner, metres.
    pub c: DVec3,
}

impl Default for Triangle {
    fn default() -> Self {
        Triangle { a: DVec3::ZERO, b: DVec3::X, c: DVec3::Y }
    }
}

impl Kind for Triangle {
    const KIND: Parameter = Parameter::new("triangle", "A triangle, given by its corners.");
}

impl Declare for Triangle {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const A: Parameter = Parameter::new("a", "The corner where u = v = 0.").unit("m").required();
        const B: Parameter = Parameter::new("b", "The corner where u = 1.").unit("m").required();
        const C: Parameter = Parameter::new("c", "The corner where v = 1.").unit("m").required();
        p.point(&A, &mut self.a);
        p.point(&B, &mut self.b);
        p.point(&C, &mut self.c);
    }
}

impl Build for Triangle {
    fn shapes(&self, _: &mut ShapeBuilder) -> Result<Vec<Shape>, Problem> {
        let edges = [self.b - self.a, self.c - self.a];
        if are_parallel(edges) {
            return Err(Problem::at("c", "the triangle has no area", "its corners must not lie on a line"));
        }
        Ok(vec![Shape::Flat { outline: Outline::Triangle, origin: self.a, edges, mirrored: false }])
    }

    fn fitted(&self, fit: &Fit) -> Option<Changes> {
        let (a, [u, v]) = fit.square();
        Some(vec![vector("a", self.a, a), vector("b", self.b, a + u), vector("c", self.c, a + u / 2.0 + v)])
    }

    fn placed(&self, placement: &Placement) -> Option<ShapeKind> {
        let (a, [u, v]) = placement.square();
        Some(Triangle { a, b: a + u, c: placement.rounded(a + u / 2.0 + v) }.into())
    }

    fn transformed(&self, by: &PointMap) -> Option<Changes> {
        let corners = [("a", self.a), ("b", self.b), ("c", self.c)];
        (!by.mirrors()).then(|| corners.map(|(key, corner)| (key, by.point(corner))).into())
    }
}
