//! Parameters that backgrounds, lamps and truths share.
use crate::declare::Parameter;

/// Of lamps, backgrounds and truths.
pub const RADIANCE: Parameter = Parameter::new("radiance", "Radiance of each channel.")
    .symbol("L_e")
    .unit("W/(m² sr)")
    .required()
    .aliases("power intensity flux strength brightness watts le Le L_e color colour rgb")
    .advice("radiance is in W/(m² sr): a flat lamp of area A with the power Φ has Φ/(π A)");

/// A picture of all directions, or of a truth.
pub const IMAGE: Parameter = Parameter::new("image", "An equirectangular picture, such as EXR or HDR; its middle is towards −z.")
    .required()
    .aliases("file filename src path");
