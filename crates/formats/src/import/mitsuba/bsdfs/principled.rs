//! Disney's principled BSDF.
use super::{
    super::{colours::Role, context::Import, tree::Element},
    one_or_two_sided, transparent,
};
use noisefall_base::declare::Range;
use noisefall_scene::{
    material::Disney,
    scene::{
        SceneError,
        description::{MaterialDescription, Textured},
    },
};

/// Takes Disney's BSDF over as it is.
pub fn principled(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    ignore_rates(element);
    let spec_trans = import.fraction(element, "spec_trans", 0.0)?;
    let transmits = spec_trans != Textured::Constant(0.0);
    let anisotropic = import.fraction(element, "anisotropic", 0.0)?;
    if anisotropic != Textured::Constant(0.0) {
        import.uses.coordinates = true;
    }
    let material = Disney {
        base_color: import.colour(element, "base_color", 0.5, Role::Reflectance)?,
        metallic: import.fraction(element, "metallic", 0.0)?,
        roughness: import.fraction(element, "roughness", 0.5)?,
        anisotropic,
        ior: index(import, element, transmits)?,
        spec_tint: import.fraction(element, "spec_tint", 0.0)?,
        spec_trans,
        flatness: import.fraction(element, "flatness", 0.0)?,
        sheen: import.fraction(element, "sheen", 0.0)?,
        sheen_tint: import.fraction(element, "sheen_tint", 0.0)?,
        clearcoat: import.fraction(element, "clearcoat", 0.0)?,
        clearcoat_gloss: import.fraction(element, "clearcoat_gloss", 0.0)?,
    };
    Ok(if transmits { transparent(material) } else { one_or_two_sided(material, two_sided) })
}

/// The index of refraction, which `specular` states by the reflectance 0.08 × `specular` at normal incidence. Where light passes, it
/// is not 1.
fn index(import: &mut Import, element: Element, transmits: bool) -> Result<f64, SceneError> {
    const LEAST_SPECULAR: f64 = 1e-3;
    const LEAST_INDEX: f64 = 1.001;
    let eta = match element.optional_number("eta")? {
        Some(eta) if transmits && eta == 1.0 => LEAST_INDEX,
        Some(eta) => eta,
        None => {
            let specular = element.number("specular", 0.5)?;
            let specular = if transmits && specular == 0.0 { LEAST_SPECULAR } else { specular };
            2.0 / (1.0 - (0.08 * specular.clamp(0.0, 12.0)).sqrt()) - 1.0
        }
    };
    let known = eta.clamp(Range::INDEX.least, Range::INDEX.most);
    if known != eta {
        import.remark(element, &format!("an index of refraction of {known}"), "reflections have another strength");
    }
    Ok(known)
}

/// Rates of sampling have no effect on the image.
pub fn ignore_rates(element: Element) {
    element.ignore(&[
        "main_specular_sampling_rate",
        "clearcoat_sampling_rate",
        "diffuse_reflectance_sampling_rate",
        "specular_reflectance_sampling_rate",
        "specular_transmittance_sampling_rate",
        "diffuse_transmittance_sampling_rate",
    ]);
}
