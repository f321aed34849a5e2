//! Microfacets: their distribution and widths.
use super::super::{context::Import, tree::Element};
use crate::{
    material::{Distribution, Roughness},
    scene::{SceneError, description::Textured},
};

/// The facets of a rough surface.
pub struct Facets {
    pub roughness: Roughness,
    pub distribution: Distribution,
    /// From 0, round, to 1.
    pub anisotropy: f64,
    /// Degrees.
    pub tangent_rotation: f64,
}

/// The distribution, and the width of a surface with round highlights.
pub fn facets(import: &mut Import, element: Element) -> Result<Facets, SceneError> {
    let distribution = distribution(import, element)?;
    element.ignore(&["sample_visible"]);
    if !element.has("alpha_u") && !element.has("alpha_v") {
        let alpha = import.fraction(element, "alpha", 0.1)?;
        return Ok(Facets { roughness: Roughness::Alpha(alpha), distribution, anisotropy: 0.0, tangent_rotation: 0.0 });
    }
    let [u, v] = [import.fraction(element, "alpha_u", 0.1)?, import.fraction(element, "alpha_v", 0.1)?];
    match (u, v) {
        (Textured::Constant(u), Textured::Constant(v)) => {
            if u != v {
                import.uses.coordinates = true;
            }
            Ok(widths(u, v, distribution))
        }
        (u, _) => {
            import.remark_value(element, "alpha_v", "`alpha_u` in all directions", "highlights are round")?;
            Ok(Facets { roughness: Roughness::Alpha(u), distribution, anisotropy: 0.0, tangent_rotation: 0.0 })
        }
    }
}

/// Widths along u and v as a width and an anisotropy: α_t = α √(2/(1 + (1 − a)²)) and α_b = (1 − a) α_t.
fn widths(u: f64, v: f64, distribution: Distribution) -> Facets {
    let (long, short) = (u.max(v), u.min(v));
    let anisotropy = if long > 0.0 { 1.0 - short / long } else { 0.0 };
    let alpha = (0.5 * (long * long + short * short)).sqrt();
    // Numbers that are equal give their own value without rounding.
    let alpha = if long == short { long } else { alpha };
    Facets {
        roughness: Roughness::Alpha(Textured::Constant(alpha)),
        distribution,
        anisotropy,
        tangent_rotation: if v > u { 90.0 } else { 0.0 },
    }
}

/// The distribution of microfacets; Beckmann by default.
pub fn distribution(import: &mut Import, element: Element) -> Result<Distribution, SceneError> {
    match element.text("distribution")?.unwrap_or("beckmann") {
        "ggx" => Ok(Distribution::Ggx),
        "beckmann" => Ok(Distribution::Beckmann),
        found @ ("phong" | "as") => {
            let place = element.property("distribution")?.unwrap_or(element);
            let what = format!("the {found} distribution of microfacets");
            import.remarks.add(place.place(), what, "Beckmann of the same width", "highlights have another width");
            Ok(Distribution::Beckmann)
        }
        other => Err(element.error(format!("`{other}` is not a distribution of microfacets"), "beckmann or ggx")),
    }
}
