//! Materials: glTF's metallic-roughness model and its extensions as `principled`, OpenPBR Surface.
mod base;
mod interface;
mod layers;
mod light;

use std::collections::HashMap;

pub use self::light::STEP;

use super::{
    document::{Document, Index, Material, Primitive, TextureInfo, UvMap, element},
    extensions::MaterialExtensions,
    refusal::Found,
    textures::{SurfaceInputs, Textures, Use, number},
};
use crate::import::{Imported, Names, uv_maps};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    image::Encoding,
    scene::description::{EmissionDescription, MaterialDescription},
    texture::image::{Channel, Image, Wrap},
};

/// A material of the description.
#[derive(Clone, Debug)]
pub struct Made {
    pub name: String,
    /// Emission of the objects that have it.
    pub emission: Option<EmissionDescription>,
}

/// Makes the materials of the description.
pub struct Materials<'a> {
    document: &'a Document,
    textures: Textures<'a>,
    /// Name of the file, in remarks.
    file: &'a str,
    names: Names,
    made: HashMap<(Option<Index>, SurfaceInputs), Made>,
}

/// A material that is being made.
struct MaterialImport<'w, 'a> {
    material: &'w Material,
    extensions: &'w MaterialExtensions,
    textures: &'w mut Textures<'a>,
    to: &'w mut Imported,
    surface: &'w SurfaceInputs,
    place: &'w str,
    /// Whether Blender wrote the file.
    is_of_blender: bool,
    /// Whether Noisefall wrote it.
    is_ours: bool,
}

impl<'a> Materials<'a> {
    pub fn new(document: &'a Document, textures: Textures<'a>, file: &'a str) -> Materials<'a> {
        Materials { document, textures, file, names: Names::default(), made: HashMap::new() }
    }

    /// The surface of a primitive for its material: which texture coordinates are read. They are those of the color.
    pub fn surface(&self, primitive: &Primitive, material: Option<Index>) -> Found<SurfaceInputs> {
        let material = material.map(|index| element(&self.document.materials, index, "material")).transpose()?;
        let wanted = material.and_then(|material| maps(material).next().map(TextureInfo::set));
        let has = |set: &u32| primitive.attributes.uvs(*set).is_some();
        // Without textures, the coordinates give the tangents of anisotropic materials.
        let uvs = wanted.filter(has).or_else(|| (0..4).find(has));
        // Normal maps are looked up at the coordinates of the mesh.
        let normals = material.and_then(|material| material.normal_texture.as_deref());
        let map = normals.filter(|normals| uvs == Some(normals.set())).map(TextureInfo::map);
        let map = map.filter(|map| map.is_finite() && uv_maps::placed(map).is_some());
        let map = map.map_or_else(UvMap::default, |map| UvMap::of(&map));
        Ok(SurfaceInputs { uvs, map, colours: primitive.attributes.color.is_some() })
    }

    /// Whether relief or highlights of a material follow tangents.
    pub fn follows_tangents(&self, material: Option<Index>) -> bool {
        let material = material.and_then(|index| self.document.materials.get(index as usize));
        material.is_some_and(|material| {
            let anisotropy = material.extensions.as_deref().and_then(|extensions| extensions.anisotropy.as_deref());
            material.normal_texture.is_some() || anisotropy.is_some_and(|found| found.anisotropy_strength > 0.0)
        })
    }

    /// The material for a surface.
    pub fn make(&mut self, to: &mut Imported, index: Option<Index>, surface: &SurfaceInputs) -> Found<Made> {
        let key = (index, surface.clone());
        if let Some(made) = self.made.get(&key) {
            return Ok(made.clone());
        }
        let usual = Material { double_sided: true, ..Material::default() };
        let material = index.map_or(Ok(&usual), |index| element(&self.document.materials, index, "material"))?;
        let fallback = index.map_or_else(|| "default".to_owned(), |index| format!("material {index}"));
        let name = self.names.unique(&material.name, &fallback);
        let place = format!("{}: material \"{name}\"", self.file);
        let none = MaterialExtensions::default();
        let mut work = MaterialImport {
            material,
            extensions: material.extensions.as_deref().unwrap_or(&none),
            textures: &mut self.textures,
            to,
            surface,
            place: &place,
            is_of_blender: self.document.asset.generator.contains("Blender I/O"),
            is_ours: self.document.asset.generator == "Noisefall",
        };
        let (description, emission) = work.make();
        to.description.materials.insert(name.clone(), description);
        let made = Made { name, emission };
        self.made.insert(key, made.clone());
        Ok(made)
    }
}

/// The textures of a material that are read, that of its colour first.
fn maps(material: &Material) -> impl Iterator<Item = &TextureInfo> {
    let pbr = material.pbr_metallic_roughness.as_deref();
    let specular = material.extensions.as_deref().and_then(|extensions| extensions.specular_glossiness.as_deref());
    let maps = [
        specular.and_then(|specular| specular.diffuse_texture.as_ref()),
        pbr.and_then(|pbr| pbr.base_color_texture.as_ref()),
        specular.and_then(|specular| specular.specular_glossiness_texture.as_ref()),
        pbr.and_then(|pbr| pbr.metallic_roughness_texture.as_ref()),
        material.normal_texture.as_deref(),
        material.emissive_texture.as_deref(),
    ];
    maps.into_iter().flatten().chain(material.extensions.as_deref().into_iter().flat_map(MaterialExtensions::maps))
}

impl MaterialImport<'_, '_> {
    fn make(&mut self) -> (MaterialDescription, Option<EmissionDescription>) {
        let opacity = self.opacity();
        let is_culled = !self.material.double_sided;
        if self.extensions.unlit.is_some() {
            let (kind, emission) = self.unlit();
            return (MaterialDescription { kind, opacity, ..MaterialDescription::default() }, emission);
        }
        let principled = self.principled();
        let transmits = principled.transmission_weight != Textured::Constant(0.0);
        // Our own exporter writes what it means; elsewhere it is a hint for rasterizers, which show what lies behind.
        let is_one_sided = is_culled && !transmits && self.is_ours;
        if is_culled && !transmits && !is_one_sided {
            self.remark("`doubleSided` is false", "two sides", "a rasterizer shows what lies behind back faces");
        }
        if self.material.occlusion_texture.is_some() {
            let effect = "none: the renderer computes occlusion itself";
            self.remark("`occlusionTexture`", "nothing", effect);
        }
        let normal_map = self.normal_map();
        let emission = self.emission();
        let two_sided = is_one_sided.then_some(false);
        (
            MaterialDescription { kind: principled.into(), normal_map, two_sided, opacity, ..MaterialDescription::default() },
            emission,
        )
    }

    fn remark(&mut self, found: impl Into<String>, used: impl Into<String>, effect: impl Into<String>) {
        self.to.remarks.add(self.place, found, used, effect);
    }

    fn colour(&mut self, factor: [f64; 3], map: Option<&TextureInfo>) -> Textured {
        let of = Use { map, surface: self.surface, place: self.place };
        self.textures.colour(self.to, factor.map(|x| x.max(0.0)), &of, Encoding::Srgb)
    }

    /// A fraction of the file, by its key.
    fn number(&mut self, key: &str, factor: f64, map: Option<&TextureInfo>, channel: Channel) -> Textured<f64> {
        let factor = self.within(key, factor, [0.0, 1.0]);
        let of = Use { map, surface: self.surface, place: self.place };
        self.textures.number(self.to, factor, &of, channel)
    }

    /// A colour of fractions, by its key.
    fn unit_colour(&mut self, key: &str, factor: [f64; 3], map: Option<&TextureInfo>) -> Textured {
        let factor = self.units(key, factor);
        self.colour(factor, map)
    }

    fn units(&mut self, key: &str, factor: [f64; 3]) -> [f64; 3] {
        let taken = factor.map(|x| x.clamp(0.0, 1.0));
        if taken != factor {
            self.remark(format!("`{key}` {factor:?}"), format!("{taken:?}"), "the colour is out of its range, 0 to 1");
        }
        taken
    }

    fn within(&mut self, key: &str, x: f64, [least, most]: [f64; 2]) -> f64 {
        let taken = x.clamp(least, most);
        if taken != x {
            self.remark(format!("`{key}` {x}"), taken.to_string(), format!("the number is out of its range, {least} to {most}"));
        }
        taken
    }

    fn product(&mut self, a: Textured<f64>, b: Textured<f64>) -> Textured<f64> {
        number(self.textures.times(self.to, a.map(|x| [x; 3]), b.map(|x| [x; 3])))
    }

    /// A colour times that of the vertices.
    fn with_vertices(&mut self, colour: Textured) -> Textured {
        if !self.surface.colours {
            return colour;
        }
        let vertices = self.textures.vertex_colour(self.to, Channel::Rgb);
        self.textures.times(self.to, colour, vertices)
    }

    /// A number times the opacity of the vertices.
    fn with_vertex_alpha(&mut self, alpha: Textured<f64>) -> Textured<f64> {
        if !self.surface.colours {
            return alpha;
        }
        let vertices = self.textures.vertex_colour(self.to, Channel::Alpha);
        number(self.textures.times(self.to, alpha.map(|alpha| [alpha; 3]), vertices))
    }

    /// The file of the normal map, which is read as it stands.
    fn normal_map(&mut self) -> Option<String> {
        let map = self.material.normal_texture.as_deref();
        let of = Use { map, surface: self.surface, place: self.place };
        let image = self.textures.path(self.to, &of)?;
        let scale = map.and_then(|map| map.scale).unwrap_or(1.0);
        if scale == 0.0 {
            return None;
        }
        if scale != 1.0 {
            self.remark(format!("`normalTexture.scale` {scale}"), "1", "bumps are of another depth");
        }
        let plain = Image { path: image.path.clone(), ..Image::default() };
        if (image.scale, image.shear, image.rotate, image.offset) != (plain.scale, plain.shear, plain.rotate, plain.offset) {
            self.remark("a transform of `normalTexture`", "none", "bumps lie elsewhere on the surface");
        }
        if (image.wrap_u, image.wrap_v) != (Wrap::Repeat, Wrap::Repeat) {
            self.remark("a wrap mode of `normalTexture`", "repeat", "bumps differ where coordinates leave the unit square");
        }
        Some(image.path)
    }
}
