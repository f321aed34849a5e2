//! Microfacets: their distribution and widths.
use super::{
    super::{context::Import, tree::Element},
    widths,
};
use noisefall_scene::{
    material::{Distribution, Roughness},
    scene::{
        SceneError,
        description::{MaterialDescription, Textured},
    },
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

/// The surface that `build` makes of the facets. Where widths along u and v vary apart, it is a mixture of such surfaces.
pub fn rough(
    import: &mut Import,
    element: Element,
    build: impl Fn(Facets) -> MaterialDescription,
) -> Result<MaterialDescription, SceneError> {
    let distribution = distribution(import, element)?;
    element.ignore(&["sample_visible"]);
    let round = |alpha| Facets { roughness: Roughness::Alpha(alpha), distribution, anisotropy: 0.0, tangent_rotation: 0.0 };
    if !element.has("alpha_u") && !element.has("alpha_v") {
        return Ok(build(round(import.fraction(element, "alpha", 0.1)?)));
    }
    let [u, v] = [import.fraction(element, "alpha_u", 0.1)?, import.fraction(element, "alpha_v", 0.1)?];
    if u == v {
        return Ok(build(round(u)));
    }
    import.uses.coordinates = true;
    if let (Textured::Constant(u), Textured::Constant(v)) = (&u, &v) {
        return Ok(build(facets_of(*u, *v, distribution)));
    }
    if let Some(mixture) = widths::mixture(import, element, [&u, &v], &|[u, v]| build(facets_of(u, v, distribution)))? {
        import.remark(element, "a mixture of surfaces of a few widths", "widths between them are approximated");
        return Ok(mixture);
    }
    import.remark_value(element, "alpha_v", "`alpha_u` in all directions", "highlights are round")?;
    Ok(build(round(u)))
}

/// Widths along u and v as a width and an anisotropy: α_t = α √(2/(1 + (1 − a)²)) and α_b = (1 − a) α_t.
fn facets_of(u: f64, v: f64, distribution: Distribution) -> Facets {
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
