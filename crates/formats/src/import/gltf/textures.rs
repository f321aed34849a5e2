//! Textures: images with their samplers and transforms, products with factors, and vertex colours.
use std::{collections::HashMap, path::Path};

use super::{
    document::{Document, TextureInfo, UvMap, element},
    images::Images,
};
use crate::import::{Imported, Names, uv_maps};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    image::Encoding,
    texture::{
        TextureKind,
        image::{Channel, Image, TexelFilter, Wrap},
        product::Product,
        ramp::{Ramp, Stop},
        vertex_color::VertexColor,
    },
};

/// Makes the textures of the description. Equal ones are one.
pub struct Textures<'a> {
    pub document: &'a Document,
    images: Images<'a>,
    names: Names,
    known: HashMap<String, String>,
}

/// The surface that a material is made for.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct SurfaceInputs {
    /// The set of texture coordinates; `None` if there is none.
    pub uvs: Option<u32>,
    /// The transform in the coordinates of the mesh: that of the normal map, which is looked up without one of its own.
    pub map: UvMap,
    /// Whether vertices have colours.
    pub colours: bool,
}

/// A texture of a material.
pub struct Use<'u> {
    /// The texture in the file.
    pub map: Option<&'u TextureInfo>,
    /// The surface that it is for.
    pub surface: &'u SurfaceInputs,
    /// The place of remarks.
    pub place: &'u str,
}

impl<'a> Textures<'a> {
    pub fn new(document: &'a Document, images: Images<'a>) -> Textures<'a> {
        Textures { document, images, names: Names::default(), known: HashMap::new() }
    }

    /// A factor times the colour of a texture.
    pub fn colour(&mut self, to: &mut Imported, factor: [f64; 3], of: &Use, encoding: Encoding) -> Textured {
        match self.image(to, of, Channel::Rgb, encoding) {
            Some(name) => self.times(to, Textured::Constant(factor), Textured::Texture(name)),
            None => Textured::Constant(factor),
        }
    }

    /// A factor times a channel of a texture.
    pub fn number(&mut self, to: &mut Imported, factor: f64, of: &Use, channel: Channel) -> Textured<f64> {
        // Exporters put metal and roughness in one image, with the factor 0 for one that has no texture.
        if factor == 0.0 {
            return Textured::Constant(0.0);
        }
        // The opacity is read from the same file as the color: both share their texels.
        let encoding = if channel == Channel::Alpha { Encoding::Srgb } else { Encoding::Linear };
        match self.image(to, of, channel, encoding) {
            Some(name) => number(self.times(to, Textured::grey(factor), Textured::Texture(name))),
            None => Textured::Constant(factor),
        }
    }

    /// A product. A factor of 1 is left out.
    pub fn times(&mut self, to: &mut Imported, a: Textured, b: Textured) -> Textured {
        match (&a, &b) {
            (Textured::Constant(a), Textured::Constant(b)) => Textured::Constant(std::array::from_fn(|i| a[i] * b[i])),
            (Textured::Constant(one), _) if *one == [1.0; 3] => b,
            (_, Textured::Constant(one)) if *one == [1.0; 3] => a,
            _ => Textured::Texture(self.add(to, Product { a, b }.into(), "product")),
        }
    }

    /// The colours of the vertices, or a channel of them.
    pub fn vertex_colour(&mut self, to: &mut Imported, channel: Channel) -> Textured {
        Textured::Texture(self.add(to, VertexColor { channel }.into(), "vertex color"))
    }

    /// A number between two stops of a ramp: `from` where the input is `start`, and `until` where it is `end`.
    pub fn ramp(
        &mut self,
        to: &mut Imported,
        input: Textured<f64>,
        [start, end]: [f64; 2],
        [from, until]: [f64; 2],
    ) -> Textured<f64> {
        if let Textured::Constant(x) = input {
            let t = ((x - start) / (end - start)).clamp(0.0, 1.0);
            return Textured::Constant(from + t * (until - from));
        }
        let stop = |at: f64, value: f64| Stop { at, color: [value; 3] };
        let ramp = Ramp { input, stops: vec![stop(start, from), stop(end, until)] };
        Textured::Texture(self.add(to, ramp.into(), "ramp"))
    }

    /// The file of a texture, for normal maps.
    pub fn path(&mut self, to: &mut Imported, of: &Use) -> Option<Image> {
        let info = of.map?;
        let Some(set) = of.surface.uvs else {
            to.remarks.add(of.place, "a texture on a mesh without TEXCOORD_n", "its factor alone", "the surface has one colour");
            return None;
        };
        if info.set() != set {
            let found = format!("a texture at TEXCOORD_{}", info.set());
            to.remarks.add(of.place, found, format!("TEXCOORD_{set}"), "the texture lies elsewhere on the surface");
        }
        match self.described(to, info, &of.surface.map) {
            Ok(image) => Some(image),
            Err(reason) => {
                to.remarks.add(
                    of.place,
                    format!("texture {}: {reason}", info.index),
                    "its factor alone",
                    "the texture is missing",
                );
                None
            }
        }
    }

    fn image(&mut self, to: &mut Imported, of: &Use, channel: Channel, encoding: Encoding) -> Option<String> {
        let image = self.path(to, of)?;
        Some(self.add_image(to, of, Image { channel, encoding, ..image }))
    }

    /// Adds an image under the name of its texture or file.
    pub fn add_image(&mut self, to: &mut Imported, of: &Use, image: Image) -> String {
        let texture = of.map.and_then(|info| self.document.textures.get(info.index as usize));
        let base = texture.map(|texture| &*texture.name).filter(|name| !name.is_empty()).unwrap_or_else(|| stem(&image.path));
        let wanted = if image.channel == Channel::Rgb { base.to_owned() } else { format!("{base} {}", image.channel.name()) };
        self.add(to, image.into(), &wanted)
    }

    /// Adds an image file that is made from another, and returns its path.
    pub fn derived(&mut self, to: &mut Imported, path: &str, what: &str, bytes: Vec<u8>) -> String {
        self.images.add(&format!("{} {what}", stem(path)), bytes, &mut to.assets)
    }

    /// The folder of the scene.
    pub fn folder(&self) -> &Path {
        self.images.folder.path()
    }

    /// The image of a texture with its sampler and transform.
    fn described(&mut self, to: &mut Imported, info: &TextureInfo, of_mesh: &UvMap) -> Result<Image, String> {
        let text = |error: super::refusal::Refusal| error.message;
        let texture = element(&self.document.textures, info.index, "texture").map_err(text)?;
        let webp = texture.extensions.webp.as_ref().map(|image| image.source);
        let source = match webp.or(texture.source) {
            Some(source) => source,
            None if texture.extensions.basisu.is_some() => {
                return Err("KTX2 files (KHR_texture_basisu) are not supported".to_owned());
            }
            None => return Err("it has no image".to_owned()),
        };
        let sampler = match texture.sampler {
            Some(sampler) => element(&self.document.samplers, sampler, "sampler").map_err(text)?.clone(),
            None => super::document::Sampler::default(),
        };
        let transform = info.extensions.transform.as_deref().cloned().unwrap_or_default();
        let placed = if *of_mesh == UvMap::default() {
            let rotate = 0.0 - transform.rotation.to_degrees();
            Image { scale: transform.scale, rotate, offset: transform.offset, ..Image::default() }
        } else if *of_mesh == UvMap::of(&info.map()) {
            Image::default()
        } else {
            let map = info.map() * of_mesh.map().inverse();
            uv_maps::placed(&map).ok_or("its KHR_texture_transform flattens it")?
        };
        Ok(Image {
            path: self.images.path(source, &mut to.assets)?,
            wrap_u: wrap(sampler.wrap_s),
            wrap_v: wrap(sampler.wrap_t),
            filter: if sampler.mag_filter == Some(NEAREST) { TexelFilter::Nearest } else { TexelFilter::Bilinear },
            ..placed
        })
    }

    fn add(&mut self, to: &mut Imported, kind: TextureKind, wanted: &str) -> String {
        let key = format!("{kind:?}");
        let name = self.known.entry(key).or_insert_with(|| self.names.unique(wanted, "texture"));
        to.description.textures.entry(name.clone()).or_insert(kind);
        name.clone()
    }
}

/// A colour as a number: textures give their luminance, which is that of a grey.
pub fn number(colour: Textured) -> Textured<f64> {
    colour.map(|[grey, ..]| grey)
}

/// The name of a file without folders and ending.
fn stem(path: &str) -> &str {
    let file = path.rsplit('/').next().unwrap_or_default();
    file.rsplit_once('.').map_or(file, |(stem, _)| stem)
}

/// Code of filters without interpolation.
const NEAREST: u32 = 9728;

fn wrap(code: Option<u32>) -> Wrap {
    match code {
        Some(33071) => Wrap::Clamp,
        Some(33648) => Wrap::Mirror,
        _ => Wrap::Repeat,
    }
}
