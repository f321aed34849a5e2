//! Images of materials, with their transforms and factors.
use std::{
    collections::HashMap,
    path::{Path, PathBuf},
};

use super::{library::locate, map::Map};
use crate::import::{
    Folder, Imported, Names,
    unit::{self, Limiter},
};
use noisefall_base::{declare::Textured, quote};
use noisefall_scene::{
    image::{EXTENSIONS, Encoding, read_light},
    texture::{
        TextureKind,
        image::{Channel, Image, Wrap},
        product::Product,
    },
};

/// The textures of a scene.
pub struct Textures {
    folder: Folder,
    names: Names,
    known: HashMap<String, String>,
    /// Reflectances, by the textures that may exceed 1.
    limited: HashMap<String, String>,
}

impl Textures {
    pub fn new(folder: Folder) -> Textures {
        Textures { folder, names: Names::default(), known: HashMap::new(), limited: HashMap::new() }
    }

    /// A colour times a texture.
    pub fn colour(&mut self, to: &mut Imported, place: &str, factor: [f64; 3], map: Option<&Map>) -> Textured {
        let Some(map) = map else { return Textured::Constant(factor) };
        let Some(image) = self.image(to, place, map, Encoding::Srgb) else { return Textured::Constant(factor) };
        let factor = factor.map(|x| x * map.range[1]);
        let channel = map.channel.unwrap_or(Channel::Rgb);
        let name = self.add(to, Image { channel, ..image }.into(), stem(&map.path));
        self.times(to, factor, name)
    }

    /// A number times a texture of numbers, which are linear. Without a choice of the channel it is the luminance.
    pub fn number(&mut self, to: &mut Imported, place: &str, factor: f64, map: Option<&Map>, channel: Channel) -> Textured<f64> {
        let Some(map) = map else { return Textured::Constant(factor) };
        let channel = map.channel.unwrap_or(channel);
        // Opacity is read from the same texels as the color.
        let encoding = if channel == Channel::Alpha { Encoding::Srgb } else { Encoding::Linear };
        let Some(image) = self.image(to, place, map, encoding) else { return Textured::Constant(factor) };
        let name = self.add(to, Image { channel, ..image }.into(), stem(&map.path));
        self.times(to, [factor * map.range[1]; 3], name).map(|[grey, ..]| grey)
    }

    /// A part of a whole, cut at 1.
    pub fn part_of_whole(&mut self, to: &mut Imported, place: &str, value: Textured<f64>) -> Textured<f64> {
        let Textured::Texture(name) = value else { return value };
        let most = unit::largest(&to.description, &to.assets, self.folder.root(), &name);
        if most <= 1.0 {
            return Textured::Texture(name);
        }
        to.remarks.add(place, format!("values of `{}` above 1", quote::piece(&name)), "1", "it is a part of the whole");
        let (scaled, ramp) = unit::cut(name.clone(), most);
        let scaled = self.add(to, scaled.into(), &format!("{name} scaled"));
        Textured::Texture(self.add(to, ramp(scaled).into(), &format!("{name} cut")))
    }

    /// A reflectance, cut at 1 in each channel.
    pub fn reflectance(&mut self, to: &mut Imported, place: &str, value: Textured) -> Textured {
        let Textured::Texture(name) = value else { return value };
        let (description, assets, root) = (&mut to.description, &mut to.assets, self.folder.root());
        let limited = self.limited.entry(name.clone()).or_insert_with(|| {
            let most = unit::largest(description, assets, root, &name);
            let names = &mut self.names;
            if most > 1.0 { Limiter { description, assets, root, names }.texture(&name, 1.0) } else { name.clone() }
        });
        if *limited != name {
            let effect = "the surface is darker, and creates no light";
            to.remarks.add(place, format!("values of `{}` above 1", quote::piece(&name)), "1", effect);
        }
        Textured::Texture(limited.clone())
    }

    /// The name of a texture, for bump maps.
    pub fn heights(&mut self, to: &mut Imported, place: &str, map: &Map) -> Option<String> {
        let image = self.image(to, place, map, Encoding::Linear)?;
        let channel = map.channel.unwrap_or(Channel::Rgb);
        Some(self.add(to, Image { channel, ..image }.into(), stem(&map.path)))
    }

    /// The file of a normal map.
    pub fn normals(&self, to: &mut Imported, place: &str, map: &Map) -> Option<String> {
        let image = self.image(to, place, map, Encoding::Linear)?;
        let plain = Image { path: image.path.clone(), encoding: image.encoding, ..Image::default() };
        if image != plain {
            to.remarks.add(place, "options of a normal map", "the image without them", "the relief lies elsewhere");
        }
        Some(image.path)
    }

    /// Adds a texture, once, and returns its name.
    pub fn add(&mut self, to: &mut Imported, kind: TextureKind, wanted: &str) -> String {
        let key = format!("{kind:?}");
        let name = self.known.entry(key).or_insert_with(|| self.names.unique(wanted, "texture")).clone();
        to.description.textures.entry(name.clone()).or_insert(kind);
        name
    }

    fn times(&mut self, to: &mut Imported, factor: [f64; 3], name: String) -> Textured {
        if factor == [1.0; 3] {
            return Textured::Texture(name);
        }
        let wanted = format!("{name} times a colour");
        let factor = factor.map(|x| x.clamp(0.0, 1e15));
        let product = Product { a: Textured::Constant(factor), b: Textured::Texture(name) };
        Textured::Texture(self.add(to, product.into(), &wanted))
    }

    /// Whether the image of a statement is there, and black.
    pub fn is_black(&self, map: &Map) -> bool {
        map.range[1] == 0.0
            || self.found(map).is_ok_and(|path| read_light(&path, Encoding::Srgb).is_ok_and(|image| image.is_black()))
    }

    /// The file of a statement.
    fn found(&self, map: &Map) -> Result<PathBuf, String> {
        let found = |name: &str| {
            let extension = name.rsplit('.').next().unwrap_or_default().to_ascii_lowercase();
            match EXTENSIONS.contains(&extension.as_str()) {
                true => locate(name, &self.folder).map_err(String::from),
                false => Err(format!("`{}` is not of a supported format", quote::path(Path::new(name)))),
            }
        };
        // The first name is the whole one, whose error counts.
        let all = map.names().map(found).reduce(|whole, short| if whole.is_ok() || short.is_err() { whole } else { short });
        all.unwrap_or_else(|| Err("a texture without a name".to_owned()))
    }

    /// The image of a statement. v points upwards in the file and downwards in ours.
    fn image(&self, to: &mut Imported, place: &str, map: &Map, encoding: Encoding) -> Option<Image> {
        let path = match self.found(map) {
            Ok(path) => self.folder.described(&path),
            Err(reason) => {
                to.remarks.add(place, format!("texture: {reason}"), "its factor alone", "the texture is missing");
                return None;
            }
        };
        for option in &map.unknown {
            let found = format!("option `{}` of a texture", quote::piece(option));
            to.remarks.add(place, found, "nothing", "the texture looks different");
        }
        if map.range[0] != 0.0 {
            to.remarks.add(place, "`-mm` with a base", "its gain alone", "the texture is darker");
        }
        let wrap = if map.clamps { Wrap::Clamp } else { Wrap::Repeat };
        // u, v ↦ s u + o, s v + o upwards is v ↦ s v + 1 − s − o downwards.
        let offset = [map.offset[0], 1.0 - map.scale[1] - map.offset[1]];
        Some(Image { path, encoding, wrap_u: wrap, wrap_v: wrap, scale: map.scale, offset, ..Image::default() })
    }
}

/// A file name without folders and its end.
fn stem(path: &str) -> &str {
    let file = path.rsplit(['/', '\\']).next().unwrap_or_default();
    file.rsplit_once('.').map_or(file, |(stem, _)| stem)
}
