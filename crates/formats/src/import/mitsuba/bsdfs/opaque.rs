//! Diffuse surfaces and plastics.
use super::{
    super::{colours::Role, context::Import, tree::Element},
    coat::internal_reflectance,
    indices, one_or_two_sided, roughness,
};
use noisefall_scene::{
    material::{Distribution, Lambertian, Plastic, RoughPlastic, Roughness},
    scene::{
        SceneError,
        description::{MaterialDescription, Textured},
    },
};

pub fn diffuse(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    // Mitsuba 0.6 has a second name.
    let name = if element.has("diffuse_reflectance") { "diffuse_reflectance" } else { "reflectance" };
    let albedo = import.colour(element, name, 0.5, Role::Reflectance)?;
    Ok(one_or_two_sided(Lambertian { albedo }, two_sided))
}

pub fn rough_diffuse(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    element.ignore(&["alpha", "use_fast_approx"]);
    import.remark(element, "smooth diffuse", "the surface is darker at grazing angles");
    diffuse(import, element, two_sided)
}

pub fn plastic(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    coated(import, element, two_sided, (Roughness::SMOOTH, Distribution::Ggx))
}

pub fn rough_plastic(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    let distribution = roughness::distribution(import, element)?;
    element.ignore(&["sample_visible"]);
    let alpha = import.fraction(element, "alpha", 0.1)?;
    coated(import, element, two_sided, (Roughness::Alpha(alpha), distribution))
}

pub fn polarized_plastic(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    import.remark(element, "rough plastic", "light is not polarized");
    rough_plastic(import, element, two_sided)
}

/// A diffuse base under a coat.
fn coated(
    import: &mut Import,
    element: Element,
    two_sided: bool,
    (roughness, distribution): (Roughness, Distribution),
) -> Result<MaterialDescription, SceneError> {
    let [inside, outside] = indices::interface(import, element, "polypropylene")?;
    let ior = inside / outside;
    if ior < 1.0 {
        import.remark(element, "a coat of index 1", "the surface has no highlight");
    }
    let ior = ior.clamp(1.0, 20.0);
    let internal_reflectance = match &roughness {
        Roughness::Alpha(Textured::Constant(alpha)) => internal_reflectance(ior, *alpha, distribution),
        // The value of a smooth coat.
        _ => 1.0,
    };
    let specular_reflectance = match import.colour(element, "specular_reflectance", 1.0, Role::Reflectance)? {
        Textured::Constant(colour) => colour.map(|x| x.clamp(0.0, 1.0)),
        Textured::Texture(_) => {
            import.remark_value(element, "specular_reflectance", "1, a clear coat", "the highlight is brighter, and white")?;
            [1.0; 3]
        }
    };
    let albedo = import.colour(element, "diffuse_reflectance", 0.5, Role::Reflectance)?;
    let nonlinear = element.flag("nonlinear", false)?;
    // The smooth one is ours.
    if nonlinear && roughness == Roughness::SMOOTH && specular_reflectance == [1.0; 3] {
        return Ok(one_or_two_sided(Plastic { albedo, ior, roughness }, two_sided));
    }
    let plastic = RoughPlastic { albedo, ior, roughness, distribution, specular_reflectance, internal_reflectance, nonlinear };
    Ok(one_or_two_sided(plastic, two_sided))
}
