//! The coats of Mitsuba 0.6 over other BSDFs, as those of OpenPBR.
use super::{
    super::{colours::Role, context::Import, tree::Element},
    adapters, indices, roughness,
};
use noisefall_scene::{
    material::{Conductor, Lambertian, Material, Reflectance, Roughness, principled::Principled},
    scene::{
        SceneError,
        description::{MaterialDescription, Textured},
    },
};

pub fn coating(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    let inner = import.material(adapters::only(element)?, two_sided)?;
    let [inside, outside] = indices::interface(import, element, "bk7")?;
    let thickness = element.number("thickness", 1.0)?.max(0.0);
    let absorbed = match import.colour(element, "sigma_a", 0.0, Role::Index)? {
        Textured::Constant(absorbed) => absorbed,
        Textured::Texture(_) => {
            import.remark_value(element, "sigma_a", "0, a clear coat", "the base is brighter")?;
            [0.0; 3]
        }
    };
    let coat_roughness = if element.kind() == "roughcoating" {
        roughness::distribution(import, element)?;
        element.ignore(&["sample_visible"]);
        let alpha = import.fraction(element, "alpha", 0.1)?;
        rooted(import, element, Roughness::Alpha(alpha))
    } else {
        Textured::Constant(0.0)
    };
    import.remark_value(element, "specular_reflectance", "1", "the coat reflects as clear glass does")?;
    let base = match &inner.kind {
        Material::Lambertian(Lambertian { albedo }) => {
            Principled { base_color: albedo.clone(), specular_weight: Textured::Constant(0.0), ..Principled::default() }
        }
        Material::Conductor(metal) => of_metal(import, element, metal),
        Material::Principled(base) if base.coat_weight == Textured::Constant(0.0) => base.clone(),
        _ => {
            import.remark(element, "the BSDF within it alone", "the coat does not reflect");
            return Ok(inner);
        }
    };
    import.remark(element, "the coat of OpenPBR", "light between coat and base is approximated");
    let kind = Principled {
        coat_weight: Textured::Constant(1.0),
        coat_ior: (inside / outside).clamp(1.0, 3.0),
        coat_roughness,
        // In and out, straight through.
        coat_color: Textured::Constant(absorbed.map(|absorbed| (-2.0 * thickness * absorbed).exp())),
        ..base
    };
    Ok(MaterialDescription { kind: kind.into(), ..inner })
}

fn of_metal(import: &mut Import, element: Element, metal: &Conductor) -> Principled {
    let base_color = match &metal.fresnel {
        Reflectance::Constant(colour) | Reflectance::Schlick(colour) => colour.clone(),
        Reflectance::Index { eta, k, tint } => {
            let head_on = |channel: usize| {
                let squared = k[channel] * k[channel];
                ((eta[channel] - 1.0).powi(2) + squared) / ((eta[channel] + 1.0).powi(2) + squared)
            };
            let tint = match tint {
                Textured::Constant(tint) => *tint,
                Textured::Texture(_) => [1.0; 3],
            };
            Textured::Constant([0, 1, 2].map(|channel| (head_on(channel) * tint[channel]).clamp(0.0, 1.0)))
        }
    };
    Principled {
        base_color,
        base_metalness: Textured::Constant(1.0),
        specular_roughness: rooted(import, element, metal.roughness.clone()),
        specular_roughness_anisotropy: Textured::Constant(metal.anisotropy),
        tangent_rotation: metal.tangent_rotation,
        ..Principled::default()
    }
}

/// The roughness of OpenPBR, the root of α.
fn rooted(import: &mut Import, element: Element, roughness: Roughness) -> Textured<f64> {
    const TYPICAL: f64 = 0.1;
    match roughness {
        Roughness::Alpha(Textured::Constant(alpha)) => Textured::Constant(alpha.clamp(0.0, 1.0).sqrt()),
        Roughness::Roughness(roughness) => roughness,
        Roughness::Alpha(Textured::Texture(_)) => {
            import.remark(element, "a width of 0.1", "the highlight has the same width everywhere");
            Textured::Constant(TYPICAL.sqrt())
        }
    }
}
