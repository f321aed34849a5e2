//! A clear sky with a sun.
use glam::DVec3;

use super::{Surrounding, image::ImageBackground};
use crate::declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Resources, Value};

/// A clear sky with a sun, in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct Sky {
    /// Direction towards the sun, of any length.
    pub sun: DVec3,
    /// Haze: 2 is very clear, 10 is hazy.
    pub turbidity: f64,
    /// Factor of the radiance of the sky.
    pub sky_scale: f64,
    /// Factor of the radiance of the sun; 0 shows the sky alone.
    pub sun_scale: f64,
}

impl Default for Sky {
    fn default() -> Self {
        Sky { sun: DVec3::new(1.0, 1.0, 1.0), turbidity: 3.0, sky_scale: 1.0, sun_scale: 1.0 }
    }
}

impl Kind for Sky {
    const KIND: Parameter = Parameter::new("sky", "A clear sky with a sun.").aliases("sunsky preetham hosek");
}

impl Declare for Sky {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const SUN: Parameter = Parameter::new("sun", "Direction towards the sun, of any length.");
        const TURBIDITY: Parameter = Parameter::new("turbidity", "Haze: 2 is very clear, 10 is hazy.").symbol("T");
        const SKY_SCALE: Parameter = Parameter::new("sky_scale", "Factor of the radiance of the sky.");
        const SUN_SCALE: Parameter = Parameter::new("sun_scale", "Factor of the radiance of the sun; 0 shows the sky alone.");
        p.value(&SUN, Value::Vector(&mut self.sun));
        p.number(&TURBIDITY, &mut self.turbidity, Range::linear(1.7, 10.0));
        p.number(&SKY_SCALE, &mut self.sky_scale, Range::log(0.0, 1e12));
        p.number(&SUN_SCALE, &mut self.sun_scale, Range::log(0.0, 1e12));
    }
}

impl Surrounding for Sky {
    type Radiant = ImageBackground;

    fn compile(&self, _: &Resources) -> Result<Option<ImageBackground>, Problem> {
        Err(Problem::at("", "not built yet", "not built yet"))
    }
}
