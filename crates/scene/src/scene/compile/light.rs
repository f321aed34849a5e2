//! Emitting surfaces.
use crate::{
    geometry::Shape,
    light::{Emission, Side},
    scene::{MaterialInstance, Object, description::EmissionDescription},
    texture::TextureCompiler,
};
use noisefall_base::declare::Problem;

/// Marks the emission of an object whose far side can be seen through its near side. Flat pieces have no far side.
pub fn see_through(object: &mut Object, materials: &[MaterialInstance]) {
    let is_curved = !matches!(object.shape, Shape::Flat { .. } | Shape::Cuboid { .. } | Shape::Mesh { .. });
    let passes = object.material.is_some_and(|number| materials[number as usize].properties.passes);
    if let Some(emission) = &mut object.emission {
        emission.translucent = is_curved && passes;
    }
}

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
