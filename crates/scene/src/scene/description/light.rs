//! Emission and truths of scene files.

use crate::light::{
    emission::EmissionSource,
    parameters::{IMAGE, RADIANCE},
};
use noisefall_base::declare::{Declare, OneOf, Parameter, Parameters, Range, Value};

/// Emission of an object of a scene file.
#[derive(Clone, Debug, PartialEq)]
pub struct EmissionDescription {
    /// The radiance, constant or textured.
    pub source: EmissionSource,
    /// Whether the back emits too.
    pub two_sided: bool,
    /// Factor of the radiance.
    pub scale: f64,
}

impl Default for EmissionDescription {
    fn default() -> Self {
        EmissionDescription { source: EmissionSource::default(), two_sided: false, scale: 1.0 }
    }
}

const TRUTH_IMAGE: Parameter = Parameter { doc: "Reference image, of the resolution of the camera.", ..IMAGE };

impl Declare for EmissionDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const TWO_SIDED: Parameter = Parameter::new("two_sided", "Whether the back emits too.").aliases("twosided double_sided");
        const SCALE: Parameter = Parameter::new("scale", "Factor that multiplies the radiance.");
        p.one_of(&mut self.source);
        p.flag(&TWO_SIDED, &mut self.two_sided);
        p.number(&SCALE, &mut self.scale, Range::log(0.0, 1e12));
    }
}

/// The reference that the image converges to.
#[derive(Clone, Debug, PartialEq)]
pub enum ReferenceDescription {
    /// A constant radiance for every pixel, W·sr⁻¹·m⁻².
    Radiance([f64; 3]),
    /// An image file of the resolution of the camera.
    Image(String),
}

impl Default for ReferenceDescription {
    fn default() -> Self {
        ReferenceDescription::Radiance([1.0; 3])
    }
}

impl Declare for ReferenceDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.one_of(self);
    }
}

impl OneOf for ReferenceDescription {
    const WHAT: &'static str = "reference";

    fn alternatives() -> Vec<Self> {
        vec![Self::default(), ReferenceDescription::Image(String::new())]
    }

    fn place(&self) -> usize {
        usize::from(matches!(self, ReferenceDescription::Image(_)))
    }

    fn name(&self) -> &'static str {
        if self.place() == 0 { RADIANCE.key } else { IMAGE.key }
    }

    fn chosen(&mut self, p: &mut dyn Parameters) {
        match self {
            ReferenceDescription::Radiance(radiance) => p.colour(&RADIANCE, radiance, Range::RADIANCE),
            ReferenceDescription::Image(path) => p.value(&TRUTH_IMAGE, Value::File(path)),
        }
    }
}
