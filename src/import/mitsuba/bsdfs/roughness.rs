//! Microfacets: their distribution and widths.
use super::super::{context::Import, tree::Element};
use crate::{
    material::Roughness,
    scene::{SceneError, description::Textured},
};

/// The facets of a rough surface.
pub struct Facets {
    pub roughness: Roughness,
    /// From 0, round, to 1.
    pub anisotropy: f64,
    /// Degrees.
    pub tangent_rotation: f64,
}

/// The distribution, and the width of a surface with round highlights.
pub fn facets(import: &mut Import, element: Element) -> Result<Facets, SceneError> {
    distribution(import, element)?;
    element.ignore(&["sample_visible"]);
    if !element.has("alpha_u") && !element.has("alpha_v") {
        let alpha = import.fraction(element, "alpha", 0.1)?;
        return Ok(Facets { roughness: Roughness::Alpha(alpha), anisotropy: 0.0, tangent_rotation: 0.0 });
    }
    let [u, v] = [import.fraction(element, "alpha_u", 0.1)?, import.fraction(element, "alpha_v", 0.1)?];
    match (u, v) {
        (Textured::Constant(u), Textured::Constant(v)) => {
            if u != v {
                import.uses.coordinates = true;
            }
            Ok(widths(u, v))
        }
        (u, _) => {
            import.remark_value(element, "alpha_v", "`alpha_u` in all directions", "highlights are round")?;
            Ok(Facets { roughness: Roughness::Alpha(u), anisotropy: 0.0, tangent_rotation: 0.0 })
        }
    }
}

/// Widths along u and v as a width and an anisotropy: α_t = α √(2/(1 + (1 − a)²)) and α_b = (1 − a) α_t.
pub fn widths(u: f64, v: f64) -> Facets {
    let (long, short) = (u.max(v), u.min(v));
    let anisotropy = if long > 0.0 { 1.0 - short / long } else { 0.0 };
    let alpha = (0.5 * (long * long + short * short)).sqrt();
    // Numbers that are equal give their own value without rounding.
    let alpha = if long == short { long } else { alpha };
    Facets {
        roughness: Roughness::Alpha(Textured::Constant(alpha)),
        anisotropy,
        tangent_rotation: if v > u { 90.0 } else { 0.0 },
    }
}

/// All of our facets are GGX.
pub fn distribution(import: &mut Import, element: Element) -> Result<(), SceneError> {
    match element.text("distribution")?.unwrap_or("beckmann") {
        "ggx" => {}
        "beckmann" | "phong" | "as" => {
            let place = element.property("distribution")?.unwrap_or(element);
            import.remarks.add(
                place.place(),
                "the Beckmann distribution of microfacets",
                "GGX of the same width",
                "highlights have a sharper peak and a wider glow",
            );
        }
        other => return Err(element.error(format!("`{other}` is no distribution of microfacets"), "beckmann or ggx")),
    }
    Ok(())
}
