//! Diffuse surfaces and plastics.
use super::{
    super::{colours::Role, context::Import, tree::Element},
    coat::Coat,
    indices, one_or_two_sided, roughness,
};
use crate::{
    material::{Lambertian, Plastic, Roughness},
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
    coated(import, element, two_sided, Roughness::SMOOTH, Some(0.0))
}

pub fn rough_plastic(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    roughness::distribution(import, element)?;
    element.ignore(&["sample_visible"]);
    let alpha = import.fraction(element, "alpha", 0.1)?;
    let constant = if let Textured::Constant(alpha) = alpha { Some(alpha) } else { None };
    coated(import, element, two_sided, Roughness::Alpha(alpha), constant)
}

pub fn polarized_plastic(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    import.remark(element, "rough plastic", "light is not polarized");
    rough_plastic(import, element, two_sided)
}

/// A diffuse base under a coat. `alpha` is its width if it is the same everywhere.
fn coated(
    import: &mut Import,
    element: Element,
    two_sided: bool,
    roughness: Roughness,
    alpha: Option<f64>,
) -> Result<MaterialDescription, SceneError> {
    let [inside, outside] = indices::interface(import, element, "polypropylene")?;
    let ior = inside / outside;
    if ior < 1.0 {
        import.remark(element, "a coat of index 1", "the surface has no highlight");
    }
    let ior = ior.clamp(1.0, 20.0);
    let nonlinear = element.flag("nonlinear", false)?;
    let colour = import.colour(element, "diffuse_reflectance", 0.5, Role::Reflectance)?;
    let coat = Coat::new(ior, alpha.unwrap_or(0.1));
    let ours = |x: f64| if nonlinear { coat.of_nonlinear(x) } else { coat.of_linear(x) };
    let is_ours = nonlinear && alpha == Some(0.0);
    let albedo = if is_ours { Some(colour.clone()) } else { import.recoloured(&colour, &ours) };
    if albedo.is_none() {
        import.remark_value(element, "diffuse_reflectance", "a nonlinear plastic", "the base is darker and more saturated")?;
    }
    if import.colour(element, "specular_reflectance", 1.0, Role::Reflectance)? != Textured::grey(1.0) {
        import.remark_value(element, "specular_reflectance", "1, a clear coat", "the highlight is brighter, and white")?;
    }
    Ok(one_or_two_sided(Plastic { albedo: albedo.unwrap_or(colour), ior, roughness }, two_sided))
}
