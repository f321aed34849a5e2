//! Thin scattering layers of Mitsuba 0.6: diffuse sheets, and the single scattering of Hanrahan and Krueger.
//!
//! P. Hanrahan and W. Krueger, "Reflection from layered surfaces due to subsurface scattering", SIGGRAPH 1993.
use super::{
    super::{colours::Role, context::Import, tree::Element, unread},
    transparent,
};
use noisefall_scene::{
    material::{blend::Blend, diffuse_transmission::DiffuseTransmission, null::Null},
    scene::{
        SceneError,
        description::{MaterialDescription, Textured},
    },
};

pub fn diffuse_transmitter(import: &mut Import, element: Element, _: bool) -> Result<MaterialDescription, SceneError> {
    let transmittance = import.colour(element, "transmittance", 0.5, Role::Reflectance)?;
    Ok(transparent(DiffuseTransmission { reflectance: Textured::grey(0.0), transmittance }))
}

/// A layer that light meets or passes, as a mixture of a diffuse sheet and nothing. Reflected and transmitted fractions are those of light
/// that comes head on and scatters once, equally in all directions.
pub fn scattering_layer(import: &mut Import, element: Element, _: bool) -> Result<MaterialDescription, SceneError> {
    import.remark(
        element,
        "a mixture of a diffuse sheet and nothing",
        "light scatters equally in all directions, from all of them",
    );
    element.objects(&["phase"])?.iter().for_each(|(_, phase)| unread::skip(*phase));
    element.ignore(&["material"]);
    let thickness = element.number("thickness", 1.0)?.max(0.0);
    let mut constant = |name: &str, default: f64| -> Result<[f64; 3], SceneError> {
        match import.colour(element, name, default, Role::Index)? {
            Textured::Constant(colour) => Ok(colour),
            Textured::Texture(_) => Ok([default; 3]),
        }
    };
    let [scattered, extinction] = if element.has("sigma_t") || element.has("albedo") {
        let [extinction, albedo] = [constant("sigma_t", 1.0)?, constant("albedo", 0.75)?];
        [[0, 1, 2].map(|channel| extinction[channel] * albedo[channel]), extinction]
    } else {
        let [scattered, absorbed] = [constant("sigma_s", 1.0)?, constant("sigma_a", 0.1)?];
        [scattered, [0, 1, 2].map(|channel| scattered[channel] + absorbed[channel])]
    };
    let depth = extinction.map(|extinction| thickness * extinction);
    let met = depth.map(|depth| 1.0 - (-depth).exp());
    let weight = (met[0] + met[1] + met[2]) / 3.0;
    if weight == 0.0 {
        return Ok(transparent(Null));
    }
    let part = |reflects: bool| {
        [0, 1, 2].map(|channel| {
            let albedo = if extinction[channel] > 0.0 { scattered[channel] / extinction[channel] } else { 0.0 };
            // The mixture meets all channels equally.
            (albedo * scattered_once(depth[channel], reflects) / weight).clamp(0.0, 0.5)
        })
    };
    let sheet = transparent(DiffuseTransmission {
        reflectance: Textured::Constant(part(true)),
        transmittance: Textured::Constant(part(false)),
    });
    let [first, second] =
        [("nothing", transparent(Null)), ("sheet", sheet)].map(|(name, material)| import.part_of(element, name, material));
    Ok(transparent(Blend { first, second, weight: Textured::Constant(weight), by_side: false }))
}

/// The fraction of light head on that scatters once in a layer of an optical depth without absorption, and leaves it on one side.
fn scattered_once(depth: f64, reflects: bool) -> f64 {
    const STEPS: u32 = 64;
    let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(STEPS);
    // Uniform in the probability to scatter by then.
    let met = 1.0 - (-depth).exp();
    let at = |i: u32| -(-middle(i) * met).ln_1p();
    // Half of the directions lead to each side.
    let leaves = |way: f64| (0..STEPS).map(|j| (-way / middle(j)).exp()).sum::<f64>() / (2.0 * f64::from(STEPS));
    met * (0..STEPS).map(|i| leaves(if reflects { at(i) } else { depth - at(i) })).sum::<f64>() / f64::from(STEPS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thin_layers_scatter_equally_to_both_sides_and_thick_ones_back() {
        for reflects in [true, false] {
            let thin = scattered_once(1e-3, reflects);
            assert!((thin / 1e-3 - 0.5).abs() < 0.01, "{thin}");
        }
        // ½ ∫ e^(−t) E₂(t) dt = ½ (1 − ln 2) of a layer without end.
        let back = scattered_once(40.0, true);
        assert!((back - 0.5 * (1.0 - std::f64::consts::LN_2)).abs() < 2e-3, "{back}");
        assert!(scattered_once(40.0, false) < 1e-3);
    }
}
