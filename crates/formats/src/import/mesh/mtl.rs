//! The statements of an MTL file.
//!
//! Wavefront Technologies, "Appendix B2. MTL material format", 1995. `Ke` and the keys of physically based materials (`Pr Pm Ps Pc Pcr
//! aniso anisor norm`) are extensions that exporters such as Blender's write.
use super::map::Map;
use crate::import::Remarks;
use noisefall_base::quote;
use noisefall_scene::model::number;

/// Statements of a material, by key. Materials have few statements, and files many materials: a tree would take kilobytes for each.
#[derive(Clone, Debug, PartialEq)]
pub struct Statements<T>(Vec<(&'static str, T)>);

impl<T> Default for Statements<T> {
    fn default() -> Statements<T> {
        Statements(Vec::new())
    }
}

impl<T> Statements<T> {
    fn get(&self, key: &str) -> Option<&T> {
        self.0.iter().find(|(of, _)| *of == key).map(|(_, value)| value)
    }

    /// The last statement counts.
    fn insert(&mut self, key: &'static str, value: T) {
        self.0.retain(|(of, _)| *of != key);
        self.0.reserve_exact(1);
        self.0.push((key, value));
    }
}

/// A material of an MTL file: the values that it states.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mtl {
    /// Diffuse, specular and emitted colours, and the transmission filter: `Kd Ks Ke Tf`.
    pub colours: Statements<[f64; 3]>,
    /// `Ns Ni d Tr illum Pr Pm Ps Pc Pcr aniso anisor`.
    pub numbers: Statements<f64>,
    /// Textures by their keys in lower case, such as `map_kd`; bump maps are `bump`.
    pub maps: Statements<Map>,
}

const COLOURS: [&str; 4] = ["Kd", "Ks", "Ke", "Tf"];
const NUMBERS: [&str; 12] = ["Ns", "Ni", "d", "Tr", "illum", "Pr", "Pm", "Ps", "Pc", "Pcr", "aniso", "anisor"];
const MAPS: [&str; 14] = [
    "map_kd",
    "map_ks",
    "map_ns",
    "map_d",
    "map_tr",
    "map_ke",
    "map_pr",
    "map_pm",
    "map_ps",
    "map_pc",
    "map_pcr",
    "map_aniso",
    "bump",
    "norm",
];
/// Statements without effect here: ambient light does not exist, and the others choose how a program filters textures.
const IGNORED: [&str; 5] = ["ka", "map_ka", "map_aat", "sharpness", "map_refl"];

/// Reads the materials of a file. `file` is its name in remarks.
pub fn read(text: &str, file: &str, remarks: &mut Remarks) -> Vec<(String, Mtl)> {
    let mut materials: Vec<(String, Mtl)> = Vec::new();
    for line in text.split(['\n', '\r']) {
        let line = line.trim();
        let (key, value) = line.split_at(line.find(|c: char| c.is_ascii_whitespace()).unwrap_or(line.len()));
        if key.is_empty() || key.starts_with('#') {
            continue;
        }
        let value = value.trim();
        if key.eq_ignore_ascii_case("newmtl") {
            materials.push((value.to_owned(), Mtl::default()));
        } else if let Some((name, material)) = materials.last_mut()
            && !material.set(key, value)
        {
            let place = format!("{file}: material \"{}\"", quote::piece(name));
            let found = format!("`{}`", quote::piece(line));
            remarks.add(place, found, "nothing", "this property of the material is missing");
        }
    }
    materials
}

impl Mtl {
    /// A colour.
    pub fn colour(&self, key: &str) -> Option<[f64; 3]> {
        self.colours.get(key).copied()
    }

    /// A number.
    pub fn number(&self, key: &str) -> Option<f64> {
        self.numbers.get(key).copied()
    }

    /// A texture.
    pub fn map(&self, key: &str) -> Option<&Map> {
        self.maps.get(key)
    }

    /// Takes a statement. Returns whether it is understood.
    fn set(&mut self, key: &str, value: &str) -> bool {
        let named = |names: &[&'static str]| names.iter().find(|name| name.eq_ignore_ascii_case(key)).copied();
        let alias = match key.to_ascii_lowercase().as_str() {
            "map_bump" => Some("bump"),
            "map_norm" | "map_kn" | "map_normal" => Some("norm"),
            "map_opacity" => Some("map_d"),
            "map_emissive" => Some("map_ke"),
            _ => named(&MAPS),
        };
        if let Some(name) = alias {
            Map::read(value).map(|map| self.maps.insert(name, map)).is_some()
        } else if let Some(name) = named(&COLOURS) {
            colour(value).map(|colour| self.colours.insert(name, colour)).is_some()
        } else if let Some(name) = named(&NUMBERS) {
            let word = value.split_ascii_whitespace().find(|word| *word != "-halo");
            let number = word.and_then(number::real).filter(|x| x.is_finite());
            number.map(|number| self.numbers.insert(name, number.into())).is_some()
        } else {
            named(&IGNORED).is_some()
        }
    }
}

/// One number for all channels or three. `xyz` precedes coordinates of CIE 1931.
fn colour(value: &str) -> Option<[f64; 3]> {
    /// Linear Rec. 709 of X, Y and Z (IEC 61966-2-1).
    const RGB: [[f64; 3]; 3] = [[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]];
    let mut words = value.split_ascii_whitespace().peekable();
    let is_xyz = words.next_if_eq(&"xyz").is_some();
    let first = f64::from(number::real(words.next()?)?);
    let mut next = || words.next().and_then(number::real).map_or(first, f64::from);
    let found = [first, next(), next()];
    let rgb = if is_xyz { RGB.map(|row| (0..3).map(|i| row[i] * found[i]).sum::<f64>()) } else { found };
    rgb.iter().all(|x| x.is_finite()).then(|| rgb.map(|x| x.max(0.0)))
}
