//! Light from all directions.
use glam::{DAffine3, DVec3};

use super::{
    super::{colours::Role, context::Import, transforms::described, tree::Element},
    sun,
};
use crate::{
    light::background::{constant::Constant, image::Image, sky::Sky},
    scene::{
        SceneError,
        description::{BackgroundDescription, Textured},
    },
};

fn set(import: &mut Import, element: Element, background: impl Into<BackgroundDescription>) {
    if import.description.background.is_some() {
        import.remark(element, "this background alone", "the light of the first background is missing");
    }
    import.description.background = Some(background.into());
}

pub fn constant(import: &mut Import, element: Element) -> Result<(), SceneError> {
    element.ignore(&["to_world"]);
    let Textured::Constant(radiance) = import.colour(element, "radiance", 1.0, Role::Emission)? else {
        return Err(element.error("the radiance of a constant background cannot be a texture", "use an `envmap`"));
    };
    set(import, element, Constant { radiance });
    Ok(())
}

pub fn image(import: &mut Import, element: Element) -> Result<(), SceneError> {
    element.ignore(&["mis_compensation"]);
    let file = import.file(element, "filename")?;
    let path = import.files.folder.described(&file);
    let scale = element.number("scale", 1.0)?;
    if scale <= 0.0 {
        return Ok(());
    }
    let map = element.affine("to_world")?;
    // Translations do not matter. Mitsuba's images have their centre at +z, and their first and last row at the poles.
    let transform = described(&DAffine3 { translation: DVec3::ZERO, ..map });
    set(import, element, Image { path, rotate: 180.0, scale, pole_rows: true, transform });
    Ok(())
}

pub fn sky(import: &mut Import, element: Element) -> Result<(), SceneError> {
    element.ignore(&["complex_sun", "stretch", "resolution", "sun_radius_scale"]);
    let map = element.affine("to_world")?;
    let turbidity = element.number("turbidity", 3.0)?;
    let [sky_scale, sun_scale] = match element.kind() {
        "sky" => [element.number("scale", 1.0)?, 0.0],
        "sun" => [0.0, element.number("scale", 1.0)?],
        _ => [element.number("sky_scale", 1.0)?, element.number("sun_scale", 1.0)?],
    };
    let sun = match element.vector("sun_direction")? {
        Some(direction) => direction,
        None => map.transform_vector3(sun::direction(element)?),
    };
    let sun = sun.try_normalize().ok_or_else(|| element.error("the direction of the sun is zero", "such as 0, 0, 1"))?;
    if !(1.7..=10.0).contains(&turbidity) {
        import.remark_value(element, "turbidity", "the nearest one from 1.7 to 10", "the sky is less clear")?;
    }
    import.remark_value(element, "albedo", "the ground of our sky", "the horizon has another brightness")?;
    import.remark_value(element, "sun_aperture", "a sun of 0.53°", "shadows have other edges")?;
    // Mitsuba's zenith is z.
    let zenith = map.transform_vector3(DVec3::Z).normalize_or(DVec3::Z);
    if !zenith.abs_diff_eq(DVec3::Y, 1e-6) {
        import.remark(element, "a sky whose zenith is +y", "the horizon stands upright");
    }
    import.remark(element, "our sky", "another fit of the radiance and the color of the sky");
    set(import, element, Sky { sun, turbidity: turbidity.clamp(1.7, 10.0), sky_scale, sun_scale });
    Ok(())
}
