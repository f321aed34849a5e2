//! Smooth and rough metal.
use super::{
    super::{colours::Role, context::Import, tree::Element},
    metals, one_or_two_sided,
    roughness::{self, Facets},
};
use noisefall_scene::{
    material::{Conductor, Reflectance, Roughness},
    scene::{SceneError, description::MaterialDescription},
};

pub fn conductor(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    let fresnel = reflectance(import, element)?;
    Ok(one_or_two_sided(Conductor { fresnel, roughness: Roughness::SMOOTH, ..Conductor::default() }, two_sided))
}

pub fn rough_conductor(import: &mut Import, element: Element, two_sided: bool) -> Result<MaterialDescription, SceneError> {
    let fresnel = reflectance(import, element)?;
    roughness::rough(import, element, |Facets { roughness, distribution, anisotropy, tangent_rotation }| {
        let fresnel = fresnel.clone();
        let metal = Conductor { fresnel, roughness, distribution, anisotropy, tangent_rotation, energy_compensation: false };
        one_or_two_sided(metal, two_sided)
    })
}

/// A metal by its name or index, times `specular_reflectance`.
fn reflectance(import: &mut Import, element: Element) -> Result<Reflectance, SceneError> {
    let tint = import.colour(element, "specular_reflectance", 1.0, Role::Reflectance)?;
    let Some((eta, k)) = indices(import, element)? else { return Ok(Reflectance::Constant(tint)) };
    Ok(Reflectance::Index { eta, k, tint })
}

/// η and k per channel.
type Index = ([f64; 3], [f64; 3]);

/// The index of a metal; `None` of a mirror.
fn indices(import: &mut Import, element: Element) -> Result<Option<Index>, SceneError> {
    let outside = element.number("ext_eta", 1.0)?;
    if element.has("eta") || element.has("k") {
        let [eta, k] = [index(import, element, "eta", 0.0)?, index(import, element, "k", 1.0)?];
        let is_mirror = eta == [0.0; 3] && k == [1.0; 3];
        return Ok((!is_mirror).then(|| (eta.map(|x| x / outside), k.map(|x| x / outside))));
    }
    match element.text("material")?.unwrap_or("none") {
        "none" => Ok(None),
        name => match metals::named(name) {
            Some((_, eta, k)) => Ok(Some((*eta, *k))),
            None => {
                let message = format!("\"{name}\" is not a metal that Noisefall knows");
                Err(element.error(message, format!("give its `eta` and `k`, or one of {}", metals::names())))
            }
        },
    }
}

fn index(import: &mut Import, element: Element, name: &str, default: f64) -> Result<[f64; 3], SceneError> {
    let Some(value) = element.property(name)? else { return Ok([default; 3]) };
    match import.constant(value, Role::Index)? {
        Some(index) => Ok(index.map(|x| x.clamp(0.0, 1e3))),
        None => {
            import.remark(value, "0.2 for η, 3 for k", "the metal has the same colour everywhere");
            Ok([if name == "eta" { 0.2 } else { 3.0 }; 3])
        }
    }
}
