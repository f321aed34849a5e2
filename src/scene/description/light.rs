//! What emits, and what the picture must be: backgrounds, emission, truth.
use crate::declare::{Declare, Family, OneOf, Parameter, Parameters, Range, Value};

/// Of lamps, backgrounds and truths.
const RADIANCE: Parameter = Parameter::new("radiance", "Radiance of each channel.")
    .symbol("L_e")
    .unit("W/(m² sr)")
    .required()
    .aliases("power intensity flux strength brightness watts le Le L_e color colour rgb")
    .advice("radiance is in W/(m² sr): a flat lamp of area A with the power Φ has Φ/(π A)");

const IMAGE: Parameter = Parameter::new("image", "An equirectangular picture, such as EXR or HDR; its middle is towards −z.")
    .required()
    .aliases("file filename src path");

pub(super) const TEXTURE: Parameter = Parameter::new("texture", "The name of a texture.");

/// The background of a scene file.
#[derive(Clone, Debug, PartialEq)]
pub enum BackgroundDescription {
    /// The same radiance from all directions, W/(m² sr).
    Radiance([f64; 3]),
    /// An equirectangular image file; its centre is at −z.
    Image {
        /// The file, relative to the scene.
        path: String,
        /// Rotation about the vertical, degrees.
        rotate: f64,
        /// Factor of the radiance.
        scale: f64,
    },
}

impl Default for BackgroundDescription {
    fn default() -> Self {
        BackgroundDescription::Radiance([1.0; 3])
    }
}

impl Declare for BackgroundDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.one_of(self);
    }
}

impl OneOf for BackgroundDescription {
    const WHAT: &'static str = "background";

    fn alternatives() -> Vec<Self> {
        vec![Self::default(), BackgroundDescription::Image { path: String::new(), rotate: 0.0, scale: 1.0 }]
    }

    fn place(&self) -> usize {
        usize::from(matches!(self, BackgroundDescription::Image { .. }))
    }

    fn name(&self) -> &'static str {
        if self.place() == 0 { RADIANCE.key } else { IMAGE.key }
    }

    fn chosen(&mut self, p: &mut dyn Parameters) {
        const ROTATE: Parameter =
            Parameter::new("rotate", "Turns the picture counter-clockwise, seen from above.").unit("degrees");
        const SCALE: Parameter = Parameter::new("scale", "Factor of its radiance.");
        match self {
            BackgroundDescription::Radiance(radiance) => p.colour(&RADIANCE, radiance, Range::RADIANCE),
            BackgroundDescription::Image { path, rotate, scale } => {
                p.value(&IMAGE, Value::File(path));
                p.number(&ROTATE, rotate, Range::FINITE);
                p.number(&SCALE, scale, Range::log(1e-12, 1e12));
            }
        }
    }
}

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

/// What an emission varies by.
#[derive(Clone, Debug, PartialEq)]
pub enum EmissionSource {
    /// A constant radiance, W/(m² sr).
    Radiance([f64; 3]),
    /// The name of a texture.
    Texture(String),
}

impl Default for EmissionDescription {
    fn default() -> Self {
        EmissionDescription { source: EmissionSource::Radiance([1.0; 3]), two_sided: false, scale: 1.0 }
    }
}

impl Declare for EmissionDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const TWO_SIDED: Parameter =
            Parameter::new("two_sided", "Whether it emits from behind too.").aliases("twosided double_sided");
        const SCALE: Parameter = Parameter::new("scale", "Factor of the radiance.");
        p.one_of(&mut self.source);
        p.flag(&TWO_SIDED, &mut self.two_sided);
        p.number(&SCALE, &mut self.scale, Range::log(0.0, 1e12));
    }
}

impl OneOf for EmissionSource {
    const WHAT: &'static str = "emission";

    fn alternatives() -> Vec<Self> {
        vec![EmissionSource::Radiance([1.0; 3]), EmissionSource::Texture(String::new())]
    }

    fn place(&self) -> usize {
        usize::from(matches!(self, EmissionSource::Texture(_)))
    }

    fn name(&self) -> &'static str {
        if self.place() == 0 { RADIANCE.key } else { TEXTURE.key }
    }

    fn chosen(&mut self, p: &mut dyn Parameters) {
        match self {
            EmissionSource::Radiance(radiance) => p.colour(&RADIANCE, radiance, Range::RADIANCE),
            EmissionSource::Texture(name) => p.value(&TEXTURE.required(), Value::Name(name, Family::Texture)),
        }
    }
}

/// What the picture of a scene file must converge to.
#[derive(Clone, Debug, PartialEq)]
pub enum TruthDescription {
    /// The same radiance at every pixel, W/(m² sr).
    Radiance([f64; 3]),
    /// An image file of the resolution of the camera.
    Image(String),
}

impl Default for TruthDescription {
    fn default() -> Self {
        TruthDescription::Radiance([1.0; 3])
    }
}

impl Declare for TruthDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.one_of(self);
    }
}

impl OneOf for TruthDescription {
    const WHAT: &'static str = "truth";

    fn alternatives() -> Vec<Self> {
        vec![Self::default(), TruthDescription::Image(String::new())]
    }

    fn place(&self) -> usize {
        usize::from(matches!(self, TruthDescription::Image(_)))
    }

    fn name(&self) -> &'static str {
        if self.place() == 0 { RADIANCE.key } else { IMAGE.key }
    }

    fn chosen(&mut self, p: &mut dyn Parameters) {
        match self {
            TruthDescription::Radiance(radiance) => p.colour(&RADIANCE, radiance, Range::RADIANCE),
            TruthDescription::Image(path) => p.value(&IMAGE, Value::File(path)),
        }
    }
}
