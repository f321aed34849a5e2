//! Smooth, rough and thin glass.
use super::{
    super::{colours::Role, context::Import, tree::Element},
    indices, roughness, transparent,
};
use crate::{
    material::{Dielectric, thin_dielectric::ThinDielectric},
    scene::{
        SceneError,
        description::{MaterialDescription, Textured},
    },
};

pub fn dielectric(import: &mut Import, element: Element, _: bool) -> Result<MaterialDescription, SceneError> {
    let [ior, ior_outside] = indices::interface(import, element, "bk7")?;
    untinted(import, element)?;
    Ok(transparent(Dielectric { ior, ior_outside, ..Dielectric::default() }))
}

pub fn rough_dielectric(import: &mut Import, element: Element, _: bool) -> Result<MaterialDescription, SceneError> {
    let [ior, ior_outside] = indices::interface(import, element, "bk7")?;
    untinted(import, element)?;
    let facets = roughness::facets(import, element)?;
    Ok(transparent(Dielectric {
        ior,
        ior_outside,
        roughness: facets.roughness,
        anisotropy: facets.anisotropy,
        tangent_rotation: facets.tangent_rotation,
        energy_compensation: false,
        ..Dielectric::default()
    }))
}

pub fn thin_dielectric(import: &mut Import, element: Element, _: bool) -> Result<MaterialDescription, SceneError> {
    let [inside, outside] = indices::interface(import, element, "bk7")?;
    untinted(import, element)?;
    Ok(transparent(ThinDielectric { ior: (inside / outside).clamp(0.05, 20.0), ..ThinDielectric::default() }))
}

/// Glass of ours reflects and transmits without a tint at its surface.
fn untinted(import: &mut Import, element: Element) -> Result<(), SceneError> {
    for name in ["specular_reflectance", "specular_transmittance"] {
        if import.colour(element, name, 1.0, Role::Reflectance)? != Textured::grey(1.0) {
            import.remark_value(element, name, "1, clear glass", "the glass has no tint")?;
        }
    }
    Ok(())
}
