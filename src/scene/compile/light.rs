//! Emitting surfaces.
use crate::{
    declare::Problem,
    light::{Emission, Side},
    scene::description::EmissionDescription,
    texture::TextureCompiler,
};

/// Emission of a surface.
pub fn emission(described: &EmissionDescription, flip: bool, textures: &TextureCompiler) -> Result<Emission, Problem> {
    let side = match (described.two_sided, flip) {
        (true, _) => Side::Both,
        (false, false) => Side::Front,
        (false, true) => Side::Back,
    };
    let emission = described.source.kind().compile(described.scale as f32, side, textures)?;
    if emission.mean == [0.0; 3] {
        let help = "remove `emission`, or give it a radiance above 0";
        return Err(Problem::at("", "a light of zero power", "it emits nothing").help(help));
    }
    Ok(emission)
}
