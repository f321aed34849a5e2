//! What emits: backgrounds and emitting surfaces.
use toml::Spanned;

use crate::{
    image::{Encoding, read_light},
    light::{Background, Emission, ImageBackground, Side},
    scene::{
        check::Checker,
        desc::{BackgroundDesc, EmissionDesc},
        diagnostic::SceneError,
        textures::NamedTextures,
    },
};

/// Factors of light may be this large.
const MOST_SCALE: f64 = 1e12;

/// `None` where the background is black.
pub fn background(check: &Checker, desc: &Spanned<BackgroundDesc>) -> Result<Option<Background>, SceneError> {
    let b = desc.as_ref();
    match (&b.radiance, &b.image) {
        (Some(radiance), None) => {
            if let Some(only_image) = b.rotate.as_ref().or(b.scale.as_ref()) {
                return Err(check.0.error(
                    only_image.span(),
                    "a constant background cannot be turned or scaled",
                    "only an image can",
                ));
            }
            let radiance = check.radiance(radiance)?;
            Ok((radiance != [0.0; 3]).then_some(Background::Constant(radiance)))
        }
        (None, Some(image)) => {
            let rotate = b.rotate.as_ref().map_or(Ok(0.0), |rotate| check.degrees("rotate", rotate))?;
            let scale = b.scale.as_ref().map_or(Ok(1.0), |scale| check.within("scale", scale, 1e-12, MOST_SCALE))?;
            let picture = read_light(&check.path(image), Encoding::Srgb)
                .map_err(|error| check.0.error(image.span(), error.to_string(), "this picture cannot be used"))?;
            let bytes = ImageBackground::bytes([picture.width, picture.height]);
            check.reserve(image.span(), "the texels and cells of a sky", bytes)?;
            let background = ImageBackground::new(picture, rotate, scale);
            if background.mean_luminance() == 0.0 {
                return Err(check.0.error(image.span(), "a background of zero power: the picture is black", "it emits nothing"));
            }
            Ok(Some(Background::Image(background)))
        }
        _ => Err(check.0.error(
            desc.span(),
            "`background` must say either `radiance` or `image`",
            "exactly one of them must be given here",
        )),
    }
}

pub fn emission(
    check: &Checker,
    desc: &Spanned<EmissionDesc>,
    flip: bool,
    textures: &NamedTextures,
) -> Result<Emission, SceneError> {
    let e = desc.as_ref();
    let side = match (e.two_sided, flip) {
        (true, _) => Side::Both,
        (false, false) => Side::Front,
        (false, true) => Side::Back,
    };
    let scale = e.scale.as_ref().map_or(Ok(1.0), |scale| check.within("scale", scale, 0.0, MOST_SCALE))?;
    let emission = match (&e.radiance, &e.texture) {
        (Some(radiance), None) => {
            let radiance = check.radiance(radiance)?.map(|x| x * scale);
            Emission { radiance, mean: radiance, texture: None, side }
        }
        (None, Some(name)) => {
            let id = textures.id(check, name)?;
            Emission { radiance: [scale; 3], mean: textures.textures.mean(id).map(|x| x * scale), texture: Some(id), side }
        }
        (None, None) => {
            let message = "missing key `radiance` or `texture`";
            return Err(check.0.error(desc.span(), message, "one of them must be given here"));
        }
        (Some(_), Some(texture)) => {
            return Err(check.0.error(texture.span(), "`emission` must say either `radiance` or `texture`", "one of them"));
        }
    };
    if emission.mean == [0.0; 3] {
        let error = check.0.error(desc.span(), "a light of zero power", "it emits nothing");
        return Err(error.with_help("remove `emission`, or give it a radiance above 0"));
    }
    Ok(emission)
}
