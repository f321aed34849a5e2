//! What emits: backgrounds and emitting surfaces.
use crate::{
    declare::{Problem, Resources},
    image::{Encoding, read_light},
    light::{Background, Emission, ImageBackground, Side},
    scene::description::{BackgroundDescription, EmissionDescription, EmissionSource},
    texture::TextureCompiler,
};

/// `None` where the background is black.
pub fn background(described: &BackgroundDescription, resources: &Resources) -> Result<Option<Background>, Problem> {
    match described {
        BackgroundDescription::Radiance(radiance) => {
            let radiance = radiance.map(|x| x as f32);
            Ok((radiance != [0.0; 3]).then_some(Background::Constant(radiance)))
        }
        BackgroundDescription::Image { path, rotate, scale } => {
            let picture = read_light(&resources.path(path), Encoding::Srgb)
                .map_err(|error| Problem::at("image", error.to_string(), "this picture cannot be used"))?;
            let bytes = ImageBackground::bytes([picture.width, picture.height]);
            resources.reserve("image", "the texels and cells of a sky", bytes)?;
            let background = ImageBackground::new(picture, *rotate, *scale as f32);
            if background.mean_luminance() == 0.0 {
                return Err(Problem::at("image", "a background of zero power: the picture is black", "it emits nothing"));
            }
            Ok(Some(Background::Image(background)))
        }
    }
}

pub fn emission(described: &EmissionDescription, flip: bool, textures: &TextureCompiler) -> Result<Emission, Problem> {
    let side = match (described.two_sided, flip) {
        (true, _) => Side::Both,
        (false, false) => Side::Front,
        (false, true) => Side::Back,
    };
    let scale = described.scale as f32;
    let emission = match &described.source {
        EmissionSource::Radiance(radiance) => {
            let radiance = radiance.map(|x| x as f32 * scale);
            Emission { radiance, mean: radiance, texture: None, side }
        }
        EmissionSource::Texture(name) => {
            let id = textures.id("texture", name)?;
            Emission { radiance: [scale; 3], mean: textures.textures.mean(id).map(|x| x * scale), texture: Some(id), side }
        }
    };
    if emission.mean == [0.0; 3] {
        let help = "remove `emission`, or give it a radiance above 0";
        return Err(Problem::at("", "a light of zero power", "it emits nothing").help(help));
    }
    Ok(emission)
}
