//! The material of Noisefall for a material of MTL.
//!
//! | MTL | ours |
//! |---|---|
//! | any of `Pr Pm Ps Pc Pcr aniso anisor` or their maps | `principled`: `Kd` is the base colour, `Pm` metalness, `Pr` roughness, `Pc` and `Pcr` the coat, `Ps` fuzz |
//! | `illum` 6 or 7; 4 or 9 with `d` < 1 | `dielectric` of index `Ni`; with `Tf`, `principled` that is transparent |
//! | black `Kd`, bright `Ks` | `conductor` with F₀ = `Ks` |
//! | `Ks` and `illum` 2 or more | `plastic`: `Kd` under a coat of index `Ni` |
//! | everything else | `lambertian` |
//!
//! The exponent `Ns` of a Phong highlight becomes α = √(2/(`Ns` + 2)), which has the same spread of normals (Walter et al., "Microfacet
//! models for refraction through rough surfaces", 2007). `d`, or 1 − `Tr`, is the opacity of all but glass. `Ke` is a radiance,
//! W/(m² sr), of both sides, because winding is not reliable. `Ka` has no effect: it is the reflectance of ambient light, which a path
//! tracer does not have.
use super::{map::Map, mtl::Mtl, textures::Textures};
use crate::import::Imported;
use noisefall_base::declare::Textured;
use noisefall_scene::{
    light::emission::{radiance::Radiance, texture::Texture},
    material::{Conductor, Dielectric, Lambertian, Material, Plastic, Reflectance, Roughness, principled::Principled},
    scene::description::{Bump, EmissionDescription, EmissionSource, MaterialDescription},
    texture::image::Channel,
};

/// Index of glass and coats where the file has none.
const INDEX: f64 = 1.5;
/// Surfaces with a darker diffuse and a brighter specular colour are metal.
const DARK: f64 = 0.02;
const BRIGHT: f64 = 0.2;
/// Height of a bump map's white over its black, as part of the size of the scene: MTL has no unit.
const RELIEF: f64 = 0.002;

/// The material and the emission of an object.
pub struct Appearance {
    pub material: MaterialDescription,
    pub emission: Option<EmissionDescription>,
}

/// Translates a material. `place` is its place in remarks, and `size` the diagonal of the scene, metres.
pub fn appearance(mtl: &Mtl, place: &str, size: f64, textures: &mut Textures, to: &mut Imported) -> Appearance {
    let mut work = MtlImport { mtl, place, textures, to };
    let is_glass = work.is_glass();
    let kind = if work.is_physical() {
        work.principled(is_glass)
    } else if is_glass {
        work.glass()
    } else {
        work.classic()
    };
    let opacity = if is_glass { None } else { work.opacity() };
    let (bump, normal_map) = work.relief(size);
    let emission = work.emission();
    Appearance { material: MaterialDescription { kind, bump, normal_map, opacity, ..MaterialDescription::default() }, emission }
}

struct MtlImport<'a> {
    mtl: &'a Mtl,
    place: &'a str,
    textures: &'a mut Textures,
    to: &'a mut Imported,
}

impl MtlImport<'_> {
    fn remark(&mut self, found: &str, used: &str, effect: &str) {
        self.to.remarks.add(self.place, found, used, effect);
    }

    fn illum(&self) -> u32 {
        self.mtl.number("illum").map_or(2, |illum| illum as u32)
    }

    fn is_physical(&self) -> bool {
        const NUMBERS: [&str; 7] = ["Pr", "Pm", "Ps", "Pc", "Pcr", "aniso", "anisor"];
        const MAPS: [&str; 6] = ["map_pr", "map_pm", "map_ps", "map_pc", "map_pcr", "map_aniso"];
        NUMBERS.iter().any(|key| self.mtl.number(key).is_some()) || MAPS.iter().any(|key| self.mtl.map(key).is_some())
    }

    fn is_glass(&self) -> bool {
        match self.illum() {
            6 | 7 => true,
            4 | 9 => self.dissolve() < 1.0,
            _ => false,
        }
    }

    /// The opacity without its map. Exporters that write both state the transparency as `Tr`. MeshLab writes an opacity as `Tr`, so 1
    /// alone makes nothing invisible.
    fn dissolve(&self) -> f64 {
        let from_transparency = || self.mtl.number("Tr").filter(|_| !self.is_tr_opacity()).map(|transparency| 1.0 - transparency);
        self.mtl.number("d").or_else(from_transparency).unwrap_or(1.0).clamp(0.0, 1.0)
    }

    /// Whether `Tr` must be an opacity.
    fn is_tr_opacity(&self) -> bool {
        let has_map = ["map_d", "map_tr"].iter().any(|key| self.mtl.map(key).is_some());
        !has_map && self.mtl.number("d").is_none() && self.mtl.number("Tr").is_some_and(|tr| tr >= 1.0)
    }

    /// Adds a remark on numbers that are cut at 1.
    fn remark_above_1(&mut self, keys: &[&str]) {
        for key in keys {
            if self.mtl.number(key).is_some_and(|number| number > 1.0) {
                self.remark(&format!("`{key}` above 1"), "1", "it is a part of the whole");
            }
        }
    }

    fn index(&self) -> f64 {
        self.mtl.number("Ni").filter(|index| *index > 1.0).map_or(INDEX, |index| index.min(20.0))
    }

    /// A reflectance: a colour of at most 1 times its map. Some exporters write black where a map says everything.
    fn reflectance(&mut self, key: &str, map: &str) -> Textured {
        let map = self.mtl.map(map);
        let mut colour = self.mtl.colour(key).unwrap_or(if map.is_some() { [1.0; 3] } else { [0.0; 3] });
        if map.is_some() && colour == [0.0; 3] {
            self.remark(&format!("a texture times a black `{key}`"), "the texture alone", "the surface is brighter");
            colour = [1.0; 3];
        }
        if colour.iter().any(|x| *x > 1.0) {
            self.remark(&format!("`{key}` above 1"), "1", "the surface is darker, and creates no light");
            colour = colour.map(|x| x.min(1.0));
        }
        let textured = self.textures.colour(self.to, self.place, colour, map);
        self.textures.reflectance(self.to, self.place, textured)
    }

    fn diffuse(&mut self) -> Textured {
        if self.mtl.colour("Kd").is_none() && self.mtl.map("map_kd").is_none() {
            return Textured::grey(0.6);
        }
        self.reflectance("Kd", "map_kd")
    }

    /// α of the highlight of Phong's exponent.
    fn alpha(&mut self) -> Roughness {
        /// Narrower highlights are those of mirrors.
        const SMOOTH: f64 = 0.003;
        if self.mtl.map("map_ns").is_some() {
            self.remark("`map_Ns`", "`Ns` alone", "the highlight is the same everywhere");
        }
        let exponent = self.mtl.number("Ns").unwrap_or(0.0).max(0.0);
        let alpha = (2.0 / (exponent + 2.0)).sqrt();
        Roughness::alpha(if alpha < SMOOTH { 0.0 } else { alpha as f32 })
    }

    fn classic(&mut self) -> Material {
        let specular = self.mtl.colour("Ks").map_or(0.0, |ks| ks.into_iter().fold(0.0, f64::max));
        let has_specular = specular > 0.0 || self.mtl.map("map_ks").is_some();
        let diffuse = self.mtl.colour("Kd").map_or(1.0, |kd| kd.into_iter().fold(0.0, f64::max));
        if self.illum() < 2 || !has_specular {
            return Lambertian { albedo: self.diffuse() }.into();
        }
        let is_metal = diffuse < DARK && self.mtl.map("map_kd").is_none() && specular > BRIGHT;
        let roughness = self.alpha();
        if is_metal {
            self.remark("Phong's highlight (`Ks Ns`)", "`conductor`", "the highlight has another shape");
            let f0 = self.reflectance("Ks", "map_ks");
            return Conductor { fresnel: Reflectance::Schlick(f0), roughness, ..Conductor::default() }.into();
        }
        self.remark("Phong's highlight (`Ks Ns`)", "`plastic`", "the highlight has another shape, strength and colour");
        Plastic { albedo: self.diffuse(), ior: self.index(), roughness }.into()
    }

    fn glass(&mut self) -> Material {
        let ior = self.index();
        let tint = self.mtl.colour("Tf").unwrap_or([1.0; 3]).map(|x| x.min(1.0));
        // Exporters write black where they have no filter.
        if tint == [1.0; 3] || tint == [0.0; 3] {
            return Dielectric { ior, ..Dielectric::default() }.into();
        }
        self.remark("`Tf`", "a tint of each interface", "thick glass is no darker than thin glass");
        Principled {
            specular_ior: ior,
            specular_roughness: Textured::Constant(0.0),
            transmission_weight: Textured::Constant(1.0),
            transmission_color: Textured::Constant(tint),
            ..Principled::default()
        }
        .into()
    }

    fn principled(&mut self, is_glass: bool) -> Material {
        self.remark_above_1(&["Pm", "Pr", "Ps", "Pc", "Pcr", "aniso"]);
        let base_color = self.diffuse();
        let tint = self.mtl.colour("Tf").filter(|tint| *tint != [0.0; 3]).unwrap_or([1.0; 3]).map(|x| x.min(1.0));
        Principled {
            base_color,
            base_metalness: self.unit("Pm", "map_pm", 0.0),
            specular_roughness: self.unit("Pr", "map_pr", 0.5),
            specular_roughness_anisotropy: self.unit("aniso", "map_aniso", 0.0),
            specular_ior: self.index(),
            transmission_weight: Textured::Constant(f64::from(u8::from(is_glass))),
            transmission_color: Textured::Constant(tint),
            coat_weight: self.unit("Pc", "map_pc", 0.0),
            coat_roughness: self.unit("Pcr", "map_pcr", 0.0),
            fuzz_weight: self.unit("Ps", "map_ps", 0.0),
            tangent_rotation: self.mtl.number("anisor").unwrap_or(0.0) * 360.0,
            ..Principled::default()
        }
        .into()
    }

    /// A number from 0 to 1 times its map. `default` stands where there is neither.
    fn unit(&mut self, key: &str, map: &str, default: f64) -> Textured<f64> {
        let map = self.mtl.map(map);
        let number = self.mtl.number(key).map(|number| number.clamp(0.0, 1.0));
        // A factor of 0 beside a map is an exporter's default.
        let factor = match map {
            Some(_) => number.filter(|number| *number > 0.0).unwrap_or(1.0),
            None => number.unwrap_or(default),
        };
        let number = self.textures.number(self.to, self.place, factor, map, Channel::Rgb);
        self.textures.part_of_whole(self.to, self.place, number)
    }

    /// The opacity; `None` is 1. A map that is the image of the colours means the opacity of that image.
    fn opacity(&mut self) -> Option<Textured<f64>> {
        self.remark_above_1(&["d"]);
        if self.is_tr_opacity() && !self.is_glass() {
            self.remark("`Tr 1` without `d`", "an opaque surface, as MeshLab means it", "an invisible one would not be shown");
        }
        let map = self.mtl.map("map_d").or_else(|| {
            let inverse = self.mtl.map("map_tr");
            if inverse.is_some() {
                self.to.remarks.add(self.place, "`map_Tr`", "`map_d`", "transparent and opaque parts may be swapped");
            }
            inverse
        });
        let mut factor = self.dissolve();
        if factor == 0.0 && map.is_some() {
            factor = 1.0;
        }
        let is_of_colour = map.is_some_and(|map| self.mtl.map("map_kd").is_some_and(|colour| colour.path == map.path));
        let channel = if is_of_colour { Channel::Alpha } else { Channel::Rgb };
        let opacity = self.textures.number(self.to, self.place, factor, map, channel);
        let opacity = self.textures.part_of_whole(self.to, self.place, opacity);
        (opacity != Textured::Constant(1.0)).then_some(opacity)
    }

    /// Bump map and normal map. Files of normals are often given as bump maps.
    fn relief(&mut self, size: f64) -> (Option<Bump>, Option<String>) {
        let has_normals = |map: &&Map| ["normal", "nrm"].iter().any(|word| map.path.to_ascii_lowercase().contains(word));
        let (normals, heights) = (self.mtl.map("norm"), self.mtl.map("bump"));
        if let Some(map) = normals.or(heights.filter(has_normals)) {
            if normals.is_none() {
                self.remark("a bump map named as normals", "a normal map", "the relief differs if the image holds heights");
            }
            return (None, self.textures.normals(self.to, self.place, map));
        }
        let bump = heights.and_then(|map| {
            let texture = self.textures.heights(self.to, self.place, map)?;
            self.remark("a bump map", "heights in proportion to the scene", "the relief may be deeper or flatter");
            Some(Bump { texture, height: (map.bump * size * RELIEF).clamp(-1e6, 1e6) })
        });
        (bump, None)
    }

    fn emission(&mut self) -> Option<EmissionDescription> {
        let map = self.mtl.map("map_ke");
        let stated = self.mtl.colour("Ke").filter(|colour| *colour != [0.0; 3]);
        let radiance = stated.or(map.map(|_| [1.0; 3]))?.map(|x| x.min(1e15));
        if map.is_some_and(|map| self.textures.is_black(map)) {
            self.remark("a black image of `Ke`", "no emission", "it gives no light");
            return None;
        }
        let source: EmissionSource = match self.textures.colour(self.to, self.place, radiance, map) {
            // The map is missing, and the file states no radiance.
            Textured::Constant(_) if stated.is_none() => return None,
            Textured::Constant(radiance) => Radiance { radiance }.into(),
            Textured::Texture(name) => Texture { name }.into(),
        };
        Some(EmissionDescription { source, two_sided: true, ..EmissionDescription::default() })
    }
}
