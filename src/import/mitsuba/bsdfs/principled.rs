//! Disney's principled BSDF as OpenPBR.
//!
//! B. Burley, "Extending the Disney BRDF to a BSDF with Integrated Subsurface Scattering", 2015. The two agree in metal, in rough
//! reflection and transmission, and in the Fresnel term of the interface; sheen, clear coat and the diffuse lobe differ.
use super::{
    super::{colours::Role, context::Import, tree::Element},
    one_or_two_sided, transparent,
};
use crate::{
    material::{blend::Blend, diffuse_transmission::DiffuseTransmission, principled::Principled},
    scene::{
        SceneError,
        description::{MaterialDescription, Textured},
    },
    texture::{mix::Mix, product::Product},
};

/// The clear coat of Disney's model: its index, and the fraction of its lobe at `clearcoat = 1`.
const COAT_INDEX: f64 = 1.5;
const COAT_SHARE: f64 = 0.25;

pub fn principled(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    let base = common(import, element)?;
    let clearcoat = import.fraction(element, "clearcoat", 0.0)?;
    let gloss = import.fraction(element, "clearcoat_gloss", 0.0)?;
    let has_clearcoat = clearcoat != Textured::Constant(0.0);
    let coat_roughness = match gloss {
        Textured::Constant(gloss) => Textured::Constant((0.1 + (0.001 - 0.1) * gloss).sqrt()),
        Textured::Texture(_) => Textured::Constant(0.05f64.sqrt()),
    };
    let specular = element.number("specular", 0.5)?.clamp(0.0, 1.0);
    let eta = element.optional_number("eta")?.unwrap_or(2.0 / (1.0 - (0.08 * specular).sqrt()) - 1.0);
    let material = Principled {
        base_metalness: import.fraction(element, "metallic", 0.0)?,
        specular_ior: eta.clamp(1.0, 20.0),
        coat_weight: import.scaled(clearcoat, COAT_SHARE),
        coat_roughness,
        coat_ior: COAT_INDEX,
        coat_darkening: Textured::Constant(0.0),
        ..base
    };
    let transmits = material.transmission_weight != Textured::Constant(0.0);
    let has_sheen = material.fuzz_weight != Textured::Constant(0.0);
    let flatness = import.fraction(element, "flatness", 0.0)? != Textured::Constant(0.0);
    let differs: Vec<&str> = [("sheen", has_sheen), ("clear coat", has_clearcoat), ("flatness", flatness)]
        .into_iter()
        .filter_map(|(name, differs)| differs.then_some(name))
        .chain(["diffuse lobe"])
        .collect();
    import.remark(element, "OpenPBR", &format!("another model of the {}", differs.join(", ")));
    Ok(if transmits { transparent(material) } else { one_or_two_sided(material, two_sided) })
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
    Ok(transparent(Blend { first, second, weight }))
}

/// What both models share.
fn common(import: &mut Import, element: Element) -> Result<Principled, SceneError> {
    element.ignore(&[
        "main_specular_sampling_rate",
        "clearcoat_sampling_rate",
        "diffuse_reflectance_sampling_rate",
        "specular_reflectance_sampling_rate",
        "specular_transmittance_sampling_rate",
        "diffuse_transmittance_sampling_rate",
    ]);
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
        transmission_color: root(&color),
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

/// White, or as far towards the hue of a color as a tint says.
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

fn root(color: &Textured) -> Textured {
    match color {
        Textured::Constant(color) => Textured::Constant(color.map(f64::sqrt)),
        textured @ Textured::Texture(_) => textured.clone(),
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
