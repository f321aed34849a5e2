//! Light from all directions.
use glam::{DAffine3, DMat3, DVec3};

use super::{
    super::{colours::Role, context::Import, picture, tree::Element},
    dark, distorted, sun,
};
use crate::import::pictures;
use noisefall_scene::{
    image::{self, Encoding, Picture},
    light::environment::{
        constant::Constant,
        image::Image,
        sky::{Sky, SkyModel},
    },
    scene::{
        SceneError,
        description::{EnvironmentDescription, Textured},
    },
    shape::Transform,
};

fn set(import: &mut Import, element: Element, environment: impl Into<EnvironmentDescription>) {
    if import.description.environment.is_some() {
        import.remark(element, "this environment alone", "the light of the first environment is missing");
    }
    import.description.environment = Some(environment.into());
}

pub fn constant(import: &mut Import, element: Element) -> Result<(), SceneError> {
    element.ignore(&["to_world"]);
    let Textured::Constant(radiance) = import.colour(element, "radiance", 1.0, Role::Emission)? else {
        return Err(element.error("the radiance of a constant environment cannot be a texture", "use an `envmap`"));
    };
    if radiance == [0.0; 3] {
        dark::leave_out(import, element);
        return Ok(());
    }
    set(import, element, Constant { radiance });
    Ok(())
}

pub fn image(import: &mut Import, element: Element) -> Result<(), SceneError> {
    element.ignore(&["mis_compensation"]);
    let file = import.file(element, "filename")?;
    let path = import.files.folder.described(&file);
    let scale = element.number("scale", 1.0)?;
    if scale <= 0.0 || picture::is_black_file(&file) {
        dark::leave_out(import, element);
        return Ok(());
    }
    // Translations do not matter. Mitsuba's images have their centre at +z, and their first and last row at the poles.
    let map = DAffine3 { translation: DVec3::ZERO, ..element.affine("to_world")? };
    let image = Image { path, rotate: 180.0, scale, pole_rows: true, transform: Transform::list_of(&map) };
    if turns(&map.matrix3) {
        set(import, element, image);
        return Ok(());
    }
    import.remark_value(element, "to_world", "the image resampled without transform", "its texels are averaged a little")?;
    let wrong = |message: String| element.error(message, "this image cannot be used");
    let picture = image::read(&file, Encoding::Srgb).map_err(|error| wrong(error.to_string()))?;
    let Picture { width, height, radiance } = distorted::resampled(&picture, &map.matrix3);
    let bytes = pictures::exr(width, height, &radiance).ok_or_else(|| wrong("the sky cannot be encoded".to_owned()))?;
    let path = import.new_files.add_image("sky", "exr", bytes);
    set(import, element, Image { path, transform: Vec::new(), ..image });
    Ok(())
}

/// Whether a map turns or mirrors directions, up to a scale.
fn turns(map: &DMat3) -> bool {
    const ROUNDING: f64 = 5e-5;
    let unit = *map * (1.0 / map.determinant().abs().cbrt());
    (unit * unit.transpose()).abs_diff_eq(DMat3::IDENTITY, ROUNDING)
}

/// A sky by place and time. Its zenith is z, and in version 0.6 it is y.
pub fn sky(import: &mut Import, element: Element) -> Result<(), SceneError> {
    const MODEL: [f64; 2] = [1.0, 10.0];
    /// Degrees, of Mitsuba.
    const SUN_DIAMETER: f64 = 0.5358;
    let map = element.affine("to_world")?;
    let turbidity = element.number("turbidity", 3.0)?;
    let scale = element.number("scale", 1.0)?;
    let [sky_scale, sun_scale] = match element.kind() {
        "sky" => [scale, 0.0],
        "sun" => [0.0, scale],
        _ => [element.number("sky_scale", scale)?, element.number("sun_scale", scale)?],
    };
    let is_old = element.is_old();
    if sky_scale <= 0.0 && sun_scale <= 0.0 {
        dark::leave_out(import, element);
        return Ok(());
    }
    let sun = match element.vector("sun_direction")? {
        Some(direction) => direction,
        None => map.transform_vector3(sun::direction(element, is_old)?),
    };
    let sun = sun.try_normalize().ok_or_else(|| element.error("the direction of the sun is zero", "such as 0, 0, 1"))?;
    let ground_albedo = match import.colour(element, "albedo", if is_old { 0.2 } else { 0.3 }, Role::Reflectance)? {
        Textured::Constant(albedo) => albedo,
        Textured::Texture(_) => return Err(element.error("the albedo of the ground cannot be a texture", "use `<rgb>`")),
    };
    let known_turbidity = turbidity.clamp(MODEL[0], MODEL[1]);
    if known_turbidity != turbidity {
        import.remark_value(element, "turbidity", "the nearest one from 1 to 10", "the sky has another haze")?;
    }
    let sun_diameter = match element.optional_number("sun_radius_scale")? {
        Some(factor) => Some(SUN_DIAMETER * factor),
        None => element.optional_number("sun_aperture")?,
    };
    element.ignore(&["resolution"]);
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
    let environment = Sky {
        sun,
        turbidity: known_turbidity,
        sky_scale: sky_scale.clamp(0.0, 1e12),
        sun_scale: sun_scale.clamp(0.0, 1e12),
        model: SkyModel::Hosek,
        ground_albedo,
        sun_diameter: known_diameter,
        zenith: map.transform_vector3(if is_old { DVec3::Y } else { DVec3::Z }).normalize_or(DVec3::Z),
    };
    set(import, element, environment);
    Ok(())
}
