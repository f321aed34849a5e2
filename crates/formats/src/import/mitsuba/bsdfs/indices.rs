//! Indices of refraction: numbers, or the names of materials.
use super::super::{context::Import, tree::Element};
use noisefall_scene::scene::SceneError;

/// Materials at 589 nm and 0 to 20 °C (Hecht, "Optics", fourth edition, and the tables of Mitsuba).
const NAMED: [(&str, f64); 23] = [
    ("vacuum", 1.0),
    ("helium", 1.000_036),
    ("hydrogen", 1.000_132),
    ("air", 1.000_277),
    ("carbon dioxide", 1.000_45),
    ("water", 1.333),
    ("acetone", 1.36),
    ("ethanol", 1.361),
    ("carbon tetrachloride", 1.461),
    ("glycerol", 1.4729),
    ("benzene", 1.501),
    ("silicone oil", 1.520_45),
    ("bromine", 1.661),
    ("water ice", 1.31),
    ("fused quartz", 1.458),
    ("pyrex", 1.47),
    ("acrylic glass", 1.49),
    ("polypropylene", 1.49),
    ("bk7", 1.5046),
    ("sodium chloride", 1.544),
    ("amber", 1.55),
    ("pet", 1.575),
    ("diamond", 2.419),
];

/// The range of our indices.
const LEAST: f64 = 0.05;
const MOST: f64 = 20.0;

/// Indices inside and outside of an interface; `inside` is the default.
pub fn interface(import: &mut Import, element: Element, inside: &str) -> Result<[f64; 2], SceneError> {
    Ok([index(import, element, "int_ior", inside)?, index(import, element, "ext_ior", "air")?])
}

fn index(import: &mut Import, element: Element, name: &str, default: &str) -> Result<f64, SceneError> {
    let Some(value) = element.property(name)? else { return Ok(named(default).unwrap_or(1.0)) };
    let known = if value.tag() == "string" { named(value.value()?) } else { None };
    let index = match known {
        Some(index) => index,
        None if value.tag() == "string" && value.value()?.trim().parse::<f64>().is_err() => {
            let names = NAMED.map(|(name, _)| name).join(", ");
            return Err(
                value.error(format!("\"{}\" is not a material with a known index", value.value()?), format!("known: {names}"))
            );
        }
        None => element.number(name, 1.0)?,
    };
    if !(LEAST..=MOST).contains(&index) {
        import.remark(value, "the nearest index from 0.05 to 20", "light is refracted less");
    }
    Ok(index.clamp(LEAST, MOST))
}

fn named(name: &str) -> Option<f64> {
    let name = name.trim().to_ascii_lowercase();
    NAMED.iter().find(|(known, _)| *known == name).map(|(_, index)| *index)
}
