//! Smooth, rough and thin glass.
use super::{
    super::{colours::Role, context::Import, tree::Element},
    indices, roughness, transparent,
};
use noisefall_scene::{
    material::{Dielectric, thin_dielectric::ThinDielectric},
    scene::{
        SceneError,
        description::{MaterialDescription, Textured},
    },
};

pub fn dielectric(import: &mut Import, element: Element, _: bool) -> Result<MaterialDescription, SceneError> {
    let [ior, ior_outside] = indices::interface(import, element, "bk7")?;
    let [specular_reflectance, specular_transmittance] = tints(import, element)?;
    Ok(transparent(Dielectric { ior, ior_outside, specular_reflectance, specular_transmittance, ..Dielectric::default() }))
}

pub fn rough_dielectric(import: &mut Import, element: Element, _: bool) -> Result<MaterialDescription, SceneError> {
    let [ior, ior_outside] = indices::interface(import, element, "bk7")?;
    let [specular_reflectance, specular_transmittance] = tints(import, element)?;
    roughness::rough(import, element, |facets| {
        transparent(Dielectric {
            ior,
            ior_outside,
            roughness: facets.roughness,
            distribution: facets.distribution,
            specular_reflectance: specular_reflectance.clone(),
            specular_transmittance: specular_transmittance.clone(),
            anisotropy: facets.anisotropy,
            tangent_rotation: facets.tangent_rotation,
            energy_compensation: false,
            ..Dielectric::default()
        })
    })
}

pub fn thin_dielectric(import: &mut Import, element: Element, _: bool) -> Result<MaterialDescription, SceneError> {
    let [inside, outside] = indices::interface(import, element, "bk7")?;
    let names = ["specular_reflectance", "specular_transmittance"];
    let mut constant = [[1.0; 3]; 2];
    for ((tint, name), constant) in tints(import, element)?.into_iter().zip(names).zip(&mut constant) {
        match tint {
            Textured::Constant(tint) => *constant = tint,
            Textured::Texture(_) => import.remark_value(element, name, "1, clear glass", "the glass has no tint")?,
        }
    }
    let [specular_reflectance, specular_transmittance] = constant;
    let ior = (inside / outside).clamp(0.05, 20.0);
    Ok(transparent(ThinDielectric { ior, specular_reflectance, specular_transmittance, ..ThinDielectric::default() }))
}

/// Factors of reflected and of transmitted light.
fn tints(import: &mut Import, element: Element) -> Result<[Textured; 2], SceneError> {
    Ok([
        import.colour(element, "specular_reflectance", 1.0, Role::Reflectance)?,
        import.colour(element, "specular_transmittance", 1.0, Role::Reflectance)?,
    ])
}
