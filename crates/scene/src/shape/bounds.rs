//! Bounding boxes of shapes.
use glam::DVec3;

use noisefall_base::declare::{Declare, Parameter, Parameters, Problem};

/// An axis-aligned box, from the corner with the smallest coordinates to the one with the largest.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounds {
    pub min: DVec3,
    pub max: DVec3,
}

pub const BOUNDS: Parameter = Parameter::new("bounds", "Bounding box.").required().aliases("box bbox");

impl Default for Bounds {
    fn default() -> Self {
        Bounds { min: DVec3::NEG_ONE, max: DVec3::ONE }
    }
}

impl Declare for Bounds {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const MIN: Parameter = Parameter::new("min", "Corner with the smallest coordinates.").unit("m").required();
        const MAX: Parameter = Parameter::new("max", "Corner with the largest coordinates.").unit("m").required();
        p.point(&MIN, &mut self.min);
        p.point(&MAX, &mut self.max);
    }
}

impl Bounds {
    /// The size, if it is positive on every axis.
    pub fn size(&self) -> Result<DVec3, Problem> {
        let size = self.max - self.min;
        match (0..3).find(|axis| size[*axis] <= 0.0) {
            None => Ok(size),
            Some(axis) => {
                let (name, from, to) = (["x", "y", "z"][axis], self.min[axis], self.max[axis]);
                let message = format!("the bounds are inverted or empty in {name}: {from} to {to}");
                Err(Problem::at("max", message, "`max` must lie above `min` in every coordinate"))
            }
        }
    }
}
