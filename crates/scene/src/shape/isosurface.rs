//! The surface where an expression of x, y and z is zero.
use glam::DAffine3;

use super::{
    Build, ShapeBuilder,
    bounds::{BOUNDS, Bounds},
};
use crate::geometry::{self, Expression, Shape};
use noisefall_base::declare::{Declare, Kind, Parameter, Parameters, Path, Problem, Value};

/// The surface where an expression is zero. The expression is negative inside.
#[derive(Clone, Debug, PartialEq)]
pub struct Isosurface {
    /// An expression in x, y and z, in metres.
    pub expression: String,
    /// The bounding box, which clips the surface.
    pub bounds: Bounds,
}

impl Default for Isosurface {
    fn default() -> Self {
        Isosurface { expression: "x^2 + y^2 + z^2 - 1".to_owned(), bounds: Bounds::default() }
    }
}

impl Kind for Isosurface {
    const KIND: Parameter =
        Parameter::new("isosurface", "The surface where an expression is zero. The expression is negative inside.")
            .aliases("implicit sdf");
}

impl Declare for Isosurface {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const EXPRESSION: Parameter = Parameter::new("expression", "Expression in x, y and z, in metres.")
            .symbol("f")
            .required()
            .aliases("formula function");
        p.value(&EXPRESSION, Value::Text(&mut self.expression));
        p.table(&BOUNDS, &mut self.bounds);
    }
}

impl Build for Isosurface {
    fn shapes(&self, builder: &mut ShapeBuilder) -> Result<Vec<Shape>, Problem> {
        let size = self.bounds.size().map_err(|problem| problem.within(&Path::of(BOUNDS.key)))?;
        let [min, max] = [self.bounds.min, self.bounds.min + size].map(|corner| corner.as_vec3().to_array());
        let key = format!("isosurface {:?} {:?} {}", min.map(f32::to_bits), max.map(f32::to_bits), self.expression);
        let surface = builder.resources.once("isosurfaces", key, || {
            let expression = Expression::parse(&self.expression)
                .map_err(|error| Problem { part: Some(error.at), ..Problem::at("expression", error.message, error.label) })?;
            Ok(geometry::Isosurface::new(expression, min, max))
        })?;
        Ok(vec![Shape::Isosurface { surface, map: DAffine3::IDENTITY }])
    }
}
