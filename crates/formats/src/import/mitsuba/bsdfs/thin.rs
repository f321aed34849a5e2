//! Disney's thin sheet: what it reflects without highlight as Disney's BSDF, a diffuse back, and its rough pane as that of OpenPBR.
use super::{
    super::{colours::Role, context::Import, tree::Element},
    principled::ignore_rates,
    transparent,
};
use noisefall_scene::{
    material::{Disney, blend::Blend, diffuse_transmission::DiffuseTransmission, principled::Principled},
    scene::{
        SceneError,
        description::{MaterialDescription, Textured},
    },
    texture::{mix::Mix, product::Product},
};

pub fn principled_thin(import: &mut Import, element: Element, _: bool) -> Result<MaterialDescription, SceneError> {
    ignore_rates(element);
    import.remark(element, "a mixture of Disney's BSDF, a diffuse sheet and OpenPBR", "another model of the rough pane");
    let color = import.colour(element, "base_color", 0.5, Role::Reflectance)?;
    let roughness = import.fraction(element, "roughness", 0.5)?;
    let clear = import.fraction(element, "spec_trans", 0.0)?;
    let pane = pane(import, element, &color, &roughness)?;
    // Twice the fraction of the diffuse light that passes.
    let passing = match import.textured_number(element, "diff_trans", 0.0)? {
        Textured::Constant(passing) => Textured::Constant((0.5 * passing).clamp(0.0, 1.0)),
        passing @ Textured::Texture(_) => import.scaled(passing, 0.5),
    };
    let front = Disney {
        base_color: color.clone(),
        roughness,
        // No highlight.
        ior: 1.0,
        flatness: import.fraction(element, "flatness", 0.0)?,
        sheen: import.fraction(element, "sheen", 0.0)?,
        sheen_tint: import.fraction(element, "sheen_tint", 0.0)?,
        ..Disney::default()
    };
    let back = DiffuseTransmission { reflectance: Textured::grey(0.0), transmittance: color };
    let sheet = mixed(import, element, [("front", transparent(front)), ("back", transparent(back))], passing);
    Ok(mixed(import, element, [("sheet", sheet), ("pane", transparent(pane))], clear))
}

/// The mixture of two parts, or the only one that there is.
fn mixed(
    import: &mut Import,
    element: Element,
    [first, second]: [(&str, MaterialDescription); 2],
    weight: Textured<f64>,
) -> MaterialDescription {
    match weight {
        Textured::Constant(0.0) => first.1,
        Textured::Constant(1.0) => second.1,
        weight => {
            let [first, second] = [first, second].map(|(part, material)| import.part_of(element, part, material));
            transparent(Blend { first, second, weight, by_side: false })
        }
    }
}

/// The rough pane. It reflects as one interface does, and its colour is that of one passage.
fn pane(import: &mut Import, element: Element, color: &Textured, roughness: &Textured<f64>) -> Result<Principled, SceneError> {
    const TYPICAL: f64 = 0.5;
    let eta = match import.textured_number(element, "eta", 1.5)? {
        Textured::Constant(eta) => eta.clamp(1.0, 20.0),
        Textured::Texture(_) => 1.5,
    };
    // Light that passes sees facets of another roughness (B. Burley, "Extending the Disney BRDF", 2015, section 5.3).
    let factor = (0.65 * eta - 0.35).clamp(0.0, 1.0);
    let through = match roughness {
        Textured::Constant(roughness) => roughness * factor,
        Textured::Texture(_) => TYPICAL * factor,
    };
    let anisotropic = import.fraction(element, "anisotropic", 0.0)?;
    if anisotropic != Textured::Constant(0.0) {
        import.uses.coordinates = true;
    }
    let tint = import.fraction(element, "spec_tint", 0.0)?;
    Ok(Principled {
        specular_color: toward(import, element, color, tint),
        specular_ior: of_pane(eta),
        specular_roughness: match &anisotropic {
            Textured::Constant(anisotropic) => widened(import.scaled(roughness.clone(), factor), *anisotropic),
            Textured::Texture(_) => import.scaled(roughness.clone(), factor),
        },
        specular_roughness_anisotropy: import.scaled(anisotropic, 0.9),
        transmission_weight: Textured::Constant(1.0),
        transmission_color: dimmed(import, element, color, passed(through)),
        thin_walled: true,
        ..Principled::default()
    })
}

/// The index of a pane with the reflectance R of one interface of index η: light between its interfaces raises R' to 2R'/(1 + R').
fn of_pane(eta: f64) -> f64 {
    let single = ((eta - 1.0) / (eta + 1.0)).powi(2);
    let root = (single / (2.0 - single)).sqrt();
    (1.0 + root) / (1.0 - root)
}

/// The fraction of the light that the facets of Mitsuba's pane let pass head on: a fit, within 2 %, to version 3.9.1.
fn passed(roughness: f64) -> f64 {
    const HALF: f64 = 0.73;
    const STEEPNESS: f64 = 4.35;
    1.0 / (1.0 + (roughness / HALF).powf(STEEPNESS))
}

/// Roughness that gives the widths r²/s and r² s with s² = 1 − 0.9 a by OpenPBR's formula, which keeps their mean square.
fn widened(roughness: Textured<f64>, anisotropic: f64) -> Textured<f64> {
    let ratio = 1.0 - 0.9 * anisotropic;
    roughness.map(|r| (r * ((1.0 + ratio * ratio) / (2.0 * ratio)).powf(0.25)).clamp(0.0, 1.0))
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

fn dimmed(import: &mut Import, element: Element, color: &Textured, part: f64) -> Textured {
    match color {
        Textured::Constant(color) => Textured::Constant(color.map(|x| x * part)),
        textured @ Textured::Texture(_) => {
            let product = Product { a: textured.clone(), b: Textured::grey(part) };
            Textured::Texture(import.add_texture(&format!("{} part", element.label()), product))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panes_reflect_and_transmit_as_in_mitsuba() {
        for (eta, single) in [(1.2, 0.008_26), (1.5, 0.04), (2.0, 0.1111)] {
            let interface: f64 = ((of_pane(eta) - 1.0) / (of_pane(eta) + 1.0)).powi(2);
            assert!((2.0 * interface / (1.0 + interface) - single).abs() < 1e-4, "{eta}");
        }
        // Roughness of the facets, and the light that passes them in Mitsuba 3.9.1 over that through a smooth pane.
        for (roughness, expected) in
            [(0.1875, 1.0), (0.3125, 0.975), (0.43, 0.907), (0.475, 0.865), (0.625, 0.672), (0.95, 0.255)]
        {
            assert!((passed(roughness) - expected).abs() < 0.02, "{roughness}: {}", passed(roughness));
        }
    }
}
