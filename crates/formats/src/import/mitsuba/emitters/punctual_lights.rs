//! Punctual lights.
use std::f64::consts::PI;

use glam::{DAffine3, DVec3};

use super::{
    super::{bitmaps::is_placed, colours::Role, context::Import, fov, picture, tree::Element},
    dark,
};
use noisefall_scene::{
    image::Encoding,
    light::punctual_light::{
        PunctualLightKind,
        directional::Directional,
        point::Point,
        projector::Projector,
        spot::{Falloff, Spot},
    },
    scene::{
        SceneError,
        description::{PunctualLightDescription, Textured},
    },
    texture::image::Image,
};

pub fn point(import: &mut Import, element: Element) -> Result<(), SceneError> {
    let map = element.affine("to_world")?;
    let position = element.vector("position")?.unwrap_or(map.translation);
    let Some(intensity) = light(import, element, "intensity")? else { return Ok(()) };
    add(import, element, Point { position, intensity })
}

pub fn directional(import: &mut Import, element: Element) -> Result<(), SceneError> {
    let map = element.affine("to_world")?;
    let direction = match element.vector("direction")? {
        Some(direction) if element.has("to_world") => map.transform_vector3(direction),
        Some(direction) => direction,
        None => map.transform_vector3(DVec3::Z),
    };
    let direction = direction.try_normalize();
    let direction = direction.ok_or_else(|| element.error("the direction is zero", "such as value=\"0, 0, -1\""))?;
    let Some(irradiance) = light(import, element, "irradiance")? else { return Ok(()) };
    add(import, element, Directional { direction, irradiance })
}

pub fn spot(import: &mut Import, element: Element) -> Result<(), SceneError> {
    let map = element.affine("to_world")?;
    let Some(intensity) = light(import, element, "intensity")? else { return Ok(()) };
    let angle = element.number("cutoff_angle", 20.0)?.clamp(0.01, 180.0);
    let inner = element.number("beam_width", 0.75 * angle)?.clamp(0.0, angle);
    if let Some(texture) = element.property("texture")? {
        if texture.kind() == "bitmap" && angle < 89.0 {
            let image = import.bitmap(texture)?;
            if is_placed(&image) {
                import.remark(texture, "the image without `to_uv`", "the image lies elsewhere");
            }
            return add(import, element, of_picture(&map, image, intensity, [inner, angle]));
        }
        import.remark(texture, "white", "the light has no image");
    }
    let [position, target] = [map.translation, map.transform_point3(DVec3::Z)];
    add(import, element, Spot { position, target, intensity, angle, inner, falloff: Falloff::Linear })
}

/// A spot with an image is a projector with a cone. The image is a square, with its first row at −y.
fn of_picture(map: &DAffine3, image: Image, intensity: [f64; 3], [inner, angle]: [f64; 2]) -> Projector {
    let [position, target, up] = axes(map);
    let scale = intensity.into_iter().fold(0.0, f64::max);
    let tint = if scale > 0.0 { intensity.map(|x| x / scale) } else { [1.0; 3] };
    Projector {
        position,
        target,
        up: -up,
        image: image.path,
        encoding: image.encoding,
        wrap: image.wrap_u,
        filter: image.filter,
        fov: 2.0 * angle,
        aspect: 1.0,
        scale,
        tint,
        flat: false,
        angle,
        inner,
    }
}

pub fn projector(import: &mut Import, element: Element) -> Result<(), SceneError> {
    let map = element.affine("to_world")?;
    let scale = PI * element.number("scale", 1.0)?.max(0.0);
    let missing = || element.error("a projector needs its `irradiance`", "add `<texture name=\"irradiance\" type=\"bitmap\">`");
    let irradiance = element.property("irradiance")?.ok_or_else(missing)?;
    let colour = import.constant(irradiance, Role::Emission)?;
    let shown = match colour {
        None if irradiance.kind() == "bitmap" => Some(import.bitmap(irradiance)?),
        _ => None,
    };
    let is_black = colour == Some([0.0; 3]) || shown.as_ref().is_some_and(|image| picture::is_black(import, image));
    if scale == 0.0 || is_black {
        dark::leave_out(import, element);
        return Ok(());
    }
    let (image, aspect) = match (colour, shown) {
        (Some(colour), _) => {
            let bytes = picture::plain(colour).ok_or_else(|| irradiance.error("the image cannot be made", ""))?;
            let path = import.new_files.add_image(element.label(), "exr", bytes);
            (Image { path, encoding: Encoding::Linear, ..Image::default() }, 1.0)
        }
        (None, Some(image)) => {
            let aspect =
                picture::aspect(import, &image).ok_or_else(|| irradiance.error("the image cannot be read", "check the file"))?;
            if is_placed(&image) {
                import.remark(irradiance, "the image without `to_uv`", "the image lies elsewhere");
            }
            (image, aspect)
        }
        (None, None) => return Err(irradiance.error("a projector shows images only", "use a `bitmap`")),
    };
    let fov = fov::across_width(element, aspect)?.clamp(0.01, 179.0);
    let [position, target, up] = axes(&map);
    add(
        import,
        element,
        Projector {
            position,
            target,
            up,
            image: image.path,
            encoding: image.encoding,
            wrap: image.wrap_u,
            filter: image.filter,
            fov,
            scale,
            flat: true,
            ..Projector::default()
        },
    )
}

/// Position, a point ahead, and the direction upwards.
fn axes(map: &DAffine3) -> [DVec3; 3] {
    [map.translation, map.transform_point3(DVec3::Z), map.transform_vector3(DVec3::Y)]
}

/// The constant intensity of a light; `None` if it is black, and the light is left out.
fn light(import: &mut Import, element: Element, name: &str) -> Result<Option<[f64; 3]>, SceneError> {
    match import.colour(element, name, 1.0, Role::Emission)? {
        Textured::Constant([0.0, 0.0, 0.0]) => {
            dark::leave_out(import, element);
            Ok(None)
        }
        Textured::Constant(colour) => Ok(Some(colour)),
        Textured::Texture(_) => Err(element.error(format!("`{name}` cannot be a texture"), "use `<rgb>` or `<spectrum>`")),
    }
}

fn add(import: &mut Import, element: Element, kind: impl Into<PunctualLightKind>) -> Result<(), SceneError> {
    let name = element.label().to_owned();
    import.description.punctual_lights.push(PunctualLightDescription { name, kind: kind.into(), transform: Vec::new() });
    Ok(())
}
