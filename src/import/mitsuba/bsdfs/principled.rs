//! Disney's principled BSDF, and its thin sheet as a mixture of a diffuse sheet and OpenPBR.
use super::{
    super::{colours::Role, context::Import, tree::Element},
    one_or_two_sided, transparent,
};
use crate::{
    declare::Range,
    material::{Disney, blend::Blend, diffuse_transmission::DiffuseTransmission, principled::Principled},
    scene::{
        SceneError,
        description::{MaterialDescription, Textured},
    },
    texture::{mix::Mix, product::Product},
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

pub fn principled_thin(import: &mut Import, element: Element, _: bool) -> Result<MaterialDescription, SceneError> {
    let base = common(import, element)?;
    let eta = match import.textured_number(element, "eta", 1.5)? {
        Textured::Constant(eta) => eta.clamp(1.0, 20.0),
        Textured::Texture(_) => 1.5,
    };
    let passes = match import.textured_number(element, "diff_trans", 0.0)? {
        Textured::Constant(passes) => (0.5 * passes).clamp(0.0, 1.0),
        Textured::Texture(_) => 0.5,
    };
    element.ignore(&["flatness"]);
    import.remark(element, "a mixture of a diffuse sheet and OpenPBR", "another model of sheen and of the rough pane");
    let weight = base.transmission_weight.clone();
    let color = base.base_color.clone();
    let [reflectance, transmittance] = [1.0 - passes, passes].map(|part| tinted(import, element, &color, part));
    let sheet = transparent(DiffuseTransmission { reflectance, transmittance });
    let pane =
        transparent(Principled { specular_ior: eta, transmission_weight: Textured::Constant(1.0), thin_walled: true, ..base });
    let [first, second] = [("sheet", sheet), ("pane", pane)].map(|(name, material)| {
        let name = import.materials.unique(&format!("{} {name}", element.label()), "material");
        import.description.materials.insert(name.clone(), material);
        name
    });
    Ok(transparent(Blend { first, second, weight, ..Blend::default() }))
}

/// Rates of sampling have no effect on the image.
fn ignore_rates(element: Element) {
    element.ignore(&[
        "main_specular_sampling_rate",
        "clearcoat_sampling_rate",
        "diffuse_reflectance_sampling_rate",
        "specular_reflectance_sampling_rate",
        "specular_transmittance_sampling_rate",
        "diffuse_transmittance_sampling_rate",
    ]);
}

fn common(import: &mut Import, element: Element) -> Result<Principled, SceneError> {
    ignore_rates(element);
    let color = import.colour(element, "base_color", 0.5, Role::Reflectance)?;
    let roughness = import.fraction(element, "roughness", 0.5)?;
    let anisotropic = import.fraction(element, "anisotropic", 0.0)?;
    if anisotropic != Textured::Constant(0.0) {
        import.uses.coordinates = true;
    }
    let tint = import.fraction(element, "spec_tint", 0.0)?;
    let sheen_tint = import.fraction(element, "sheen_tint", 0.0)?;
    Ok(Principled {
        specular_color: toward(import, element, &color, tint),
        fuzz_color: toward(import, element, &color, sheen_tint),
        transmission_color: color.clone().map(|color| color.map(f64::sqrt)),
        transmission_weight: import.fraction(element, "spec_trans", 0.0)?,
        fuzz_weight: import.fraction(element, "sheen", 0.0)?,
        specular_roughness: widened(roughness, &anisotropic),
        specular_roughness_anisotropy: import.scaled(anisotropic, 0.9),
        base_color: color,
        ..Principled::default()
    })
}

/// Roughness that gives the widths r²/s and r² s with s² = 1 − 0.9 a by OpenPBR's formula, which keeps their mean square.
fn widened(roughness: Textured<f64>, anisotropic: &Textured<f64>) -> Textured<f64> {
    match (roughness, anisotropic) {
        (Textured::Constant(r), Textured::Constant(a)) => {
            let ratio = 1.0 - 0.9 * a;
            Textured::Constant((r * ((1.0 + ratio * ratio) / (2.0 * ratio)).powf(0.25)).clamp(0.0, 1.0))
        }
        (roughness, _) => roughness,
    }
}

/// White, or as far towards the hue of a colour as a tint says.
fn toward(import: &mut Import, element: Element, color: &Textured, tint: Textured<f64>) -> Textured {
    match (color, tint) {
        (_, Textured::Constant(0.0)) => Textured::grey(1.0),
        (Textured::Constant(color), Textured::Constant(tint)) => {
            let luminance = 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
            let hue = if luminance > 0.0 { color.map(|x| x / luminance) } else { [1.0; 3] };
            Textured::Constant(hue.map(|x| (1.0 + (x - 1.0) * tint).clamp(0.0, 1.0)))
        }
        (color, weight) => {
            let mix = Mix { a: Textured::grey(1.0), b: color.clone(), weight };
            Textured::Texture(import.add_texture(&format!("{} tint", element.label()), mix))
        }
    }
}

fn tinted(import: &mut Import, element: Element, color: &Textured, part: f64) -> Textured {
    match color {
        Textured::Constant(color) => Textured::Constant(color.map(|x| x * part)),
        textured @ Textured::Texture(_) => {
            let product = Product { a: textured.clone(), b: Textured::grey(part) };
            Textured::Texture(import.add_texture(&format!("{} part", element.label()), product))
        }
    }
}
