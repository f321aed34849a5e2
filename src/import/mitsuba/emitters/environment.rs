//! Light from all directions.
use glam::{DAffine3, DVec3};

use super::{
    super::{colours::Role, context::Import, tree::Element},
    sun,
};
use crate::{
    light::background::{
        constant::Constant,
        image::Image,
        sky::{Sky, SkyModel},
    },
    scene::{
        SceneError,
        description::{BackgroundDescription, Textured},
    },
    shape::Transform,
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
    let transform = Transform::list_of(&DAffine3 { translation: DVec3::ZERO, ..map });
    set(import, element, Image { path, rotate: 180.0, scale, pole_rows: true, transform });
    Ok(())
}

pub fn sky(import: &mut Import, element: Element) -> Result<(), SceneError> {
    const MODEL: [f64; 2] = [1.0, 10.0];
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
    let ground_albedo = match import.colour(element, "albedo", 0.3, Role::Reflectance)? {
        Textured::Constant(albedo) => albedo,
        Textured::Texture(_) => return Err(element.error("the albedo of the ground cannot be a texture", "use `<rgb>`")),
    };
    let known_turbidity = turbidity.clamp(MODEL[0], MODEL[1]);
    if known_turbidity != turbidity {
        import.remark_value(element, "turbidity", "the nearest one from 1 to 10", "the sky has another haze")?;
    }
    let sun_diameter = element.optional_number("sun_aperture")?;
    let known_diameter = sun_diameter.map(|degrees| degrees.clamp(0.05, 90.0));
    if known_diameter != sun_diameter {
        import.remark_value(element, "sun_aperture", "the nearest one from 0.05° to 90°", "shadows have other edges")?;
    }
    if element.flag("complex_sun", false)? {
        import.remark_value(element, "complex_sun", "a sun of equal radiance", "the sun's limb is brighter")?;
    }
    if sun_scale > 0.0 {
        import.remark(element, "a sun whose edge is blurred over 0.2°", "shadows have slightly softer edges");
    }
    let background = Sky {
        sun,
        turbidity: known_turbidity,
        sky_scale: sky_scale.clamp(0.0, 1e12),
        sun_scale: sun_scale.clamp(0.0, 1e12),
        model: SkyModel::Hosek,
        ground_albedo,
        sun_diameter: known_diameter,
        // Mitsuba's zenith is z.
        zenith: map.transform_vector3(DVec3::Z).normalize_or(DVec3::Z),
    };
    set(import, element, background);
    Ok(())
}
