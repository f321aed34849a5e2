//! Parameters of environments, lights and truths.
use noisefall_base::declare::Parameter;

/// The radiance of a light, environment or reference.
pub const RADIANCE: Parameter = Parameter::new("radiance", "Radiance of each channel.")
    .symbol("L_e")
    .unit("W·sr⁻¹·m⁻²")
    .required()
    .aliases("power intensity flux strength brightness watts le Le L_e color colour rgb")
    .advice("radiance is in W·sr⁻¹·m⁻²: a flat light of area A and power Φ has Φ/(π A)");

/// The image of an environment.
pub const IMAGE: Parameter = Parameter::new("image", "Equirectangular image, such as EXR or HDR; its centre is towards −z.")
    .required()
    .aliases("file filename src path");
