//! What was meant by words of other renderers and textbooks, and by values that lack their table.

/// Words that are not keys here, and the keys that they may mean; of several the first that is known at the place.
const SYNONYMS: [(&[&str], &[&str]); 23] = [
    (&["samples", "samples_per_pixel", "sample_count", "num_samples", "n"], &["spp"]),
    (&["depth", "max_depth", "bounces", "max_bounce", "maxdepth"], &["max_bounces"]),
    (&["russian_roulette", "rr"], &["roulette"]),
    (&["integrator", "method", "nee"], &["estimator"]),
    (&["sampling", "importance_sampling", "distribution"], &["directions"]),
    (&["sharing", "share"], &["reuse"]),
    (&["position", "origin", "from", "pos", "location"], &["eye", "center", "base"]),
    (&["target", "at", "to", "direction", "lookat"], &["look_at"]),
    (&["size", "width", "height"], &["resolution"]),
    (&["angle", "field_of_view", "vfov", "hfov"], &["fov"]),
    (&["aperture", "dof"], &["lens"]),
    (&["power", "intensity", "flux", "strength", "brightness", "watts", "le", "Le", "L_e"], &["radiance"]),
    (&["light", "emitter", "emissive", "area_light", "lamp"], &["emission"]),
    (&["lambert", "diffuse", "matte", "oren_nayar"], &["lambertian"]),
    (&["glass", "refractive", "water", "transparent"], &["dielectric"]),
    (&["metal", "metallic", "gold", "copper"], &["conductor"]),
    (&["specular", "perfect_mirror", "reflective"], &["mirror"]),
    (&["glossy", "coated", "paint", "varnish"], &["plastic"]),
    (&["color", "colour", "rho", "reflectance", "kd", "Kd", "rgb"], &["albedo", "reflectance", "radiance", "f0"]),
    (&["eta", "index", "index_of_refraction", "refraction"], &["ior"]),
    (&["box", "cube", "aabb"], &["cuboid"]),
    (&["quad", "plane", "square", "parallelogram"], &["rectangle"]),
    (&["file", "filename", "src"], &["path", "image"]),
];

/// Tables that are known by one value: their key, and that of the value.
const TABLES: [(&str, &str); 7] = [
    ("emission", "radiance"),
    ("background", "radiance"),
    ("truth", "radiance"),
    ("lambertian", "albedo"),
    ("mirror", "reflectance"),
    ("dielectric", "ior"),
    ("roulette", "fixed"),
];

/// Tables that are known by a file.
const FILES: [(&str, &str); 2] = [("image", "path"), ("mesh", "path")];

/// The known word that is meant by one that is none.
pub fn synonym<'k>(word: &str, known: &[&'k str]) -> Option<&'k str> {
    let (_, meant) = SYNONYMS.iter().find(|(words, meant)| words.contains(&word) && meant.iter().any(|m| known.contains(m)))?;
    meant.iter().find_map(|meant| known.iter().find(|known| *known == meant).copied())
}

/// What is to be said of a word besides the one that is meant.
pub fn remark(word: &str, meant: &str) -> Option<&'static str> {
    match (word, meant) {
        ("power" | "flux" | "watts" | "intensity", "radiance") => {
            Some("radiance is in W/(m² sr): a flat lamp of area A with the power Φ has Φ/(π A)")
        }
        ("width" | "height", "resolution") => Some("write resolution = [width, height]"),
        ("vfov", "fov") => Some("`fov` is the angle across the picture's width, in degrees"),
        ("metal" | "metallic" | "gold" | "copper", "conductor") => {
            Some("such as conductor = { f0 = [1.0, 0.78, 0.34], roughness = 0.3 }")
        }
        ("glass" | "water", "dielectric") => Some("such as dielectric = { ior = 1.5 }"),
        ("lambert" | "diffuse" | "matte", "lambertian") => Some("such as lambertian = { albedo = 0.8 }"),
        _ => None,
    }
}

/// Whether this is the key of a table for which its one value may be written by mistake.
pub fn is_known_by_one_value(key: &str) -> bool {
    TABLES.iter().any(|(table, _)| *table == key)
}

/// How to write a value that stands where its table is expected.
pub fn table_around(key: &str, value: &str) -> Option<String> {
    let is_text = value.starts_with(['"', '\'']);
    let is_number = value.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '[' | '.' | '-' | '+'));
    let tables: &[(&str, &str)] = if is_text { &FILES } else { &TABLES };
    let (_, inner) = tables.iter().find(|(table, _)| *table == key).filter(|_| is_text || is_number)?;
    Some(format!("{{ {inner} = {value} }}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_word_means_two_things_at_one_place() {
        for (i, (words, meant)) in SYNONYMS.iter().enumerate() {
            for (others, also_meant) in &SYNONYMS[i + 1..] {
                let shared = words.iter().any(|word| others.contains(word));
                assert!(!shared || meant.iter().all(|meant| !also_meant.contains(meant)), "{words:?} {others:?}");
            }
        }
    }
}
