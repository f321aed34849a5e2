//! Textures of materials as factors, images and vertex colours.
use std::io::Read;

use serde_json::{Value, json};

use super::{
    super::{ExportError, textures::DEEPEST},
    context::{Export, table},
    known::Mapped,
};
use noisefall_base::{
    declare::{Problem, Textured},
    file::open_regular,
};
use noisefall_scene::{
    image::Encoding,
    scene::description::TextureKind,
    texture::{
        ImageTexture,
        image::{Channel, Image, TexelFilter, Wrap},
    },
};

/// A factor times a texture, in some channels of an image.
#[derive(Clone, Debug)]
pub struct Part {
    /// The factor; grey for numbers.
    pub factor: [f64; 3],
    /// The name of the texture.
    pub texture: Option<String>,
    /// The channel of a number; `Rgb` for a color.
    pub channel: Channel,
    /// Whether the colours of vertices are a further factor.
    pub has_vertices: bool,
}

impl Part {
    /// The factor of a number.
    pub fn number(&self) -> f64 {
        self.factor[0]
    }

    /// The name of the texture in the file. The reader appends the channel of a number.
    pub fn name(&self) -> &str {
        let name = self.texture.as_deref().unwrap_or_default();
        name.strip_suffix(self.channel.name()).and_then(|name| name.strip_suffix(' ')).unwrap_or(name)
    }

    /// Whether the channels of the part may hold anything.
    pub fn is_free(&self) -> bool {
        self.texture.is_none() && self.factor == [0.0; 3]
    }
}

impl Export<'_> {
    /// A color.
    pub fn color(&self, color: &Textured) -> Part {
        self.part(color, Channel::Rgb, None)
    }

    /// A number in a channel.
    pub fn number(&self, number: &Textured<f64>, channel: Channel) -> Part {
        self.part(&number.clone().map(|number| [number; 3]), channel, None)
    }

    /// A colour or number, without its factors. `vertices` is the channel of the colours of vertices that may be one of them.
    pub fn part(&self, value: &Textured, channel: Channel, vertices: Option<Channel>) -> Part {
        let mut part = Part { factor: [1.0; 3], texture: None, channel, has_vertices: false };
        let mut rest = vec![value];
        for _ in 0..DEEPEST {
            let Some(next) = rest.pop() else { return part };
            match next {
                // The luminance of a product is not that of its factors, unless one is grey.
                Textured::Constant(c) if channel == Channel::Rgb || (c[0] == c[1] && c[1] == c[2]) => {
                    part.factor = std::array::from_fn(|i| part.factor[i] * c[i]);
                }
                Textured::Texture(name) => match self.colors.kind(name) {
                    Some(TextureKind::Product(product)) => rest.extend([&product.a, &product.b]),
                    Some(TextureKind::VertexColor(of)) if Some(of.channel) == vertices && !part.has_vertices => {
                        part.has_vertices = true;
                    }
                    _ if part.texture.is_none() => part.texture = Some(name.clone()),
                    _ => break,
                },
                Textured::Constant(_) => break,
            }
        }
        let texture = if let Textured::Texture(name) = value { Some(name.clone()) } else { None };
        Part { factor: [1.0; 3], texture, channel, has_vertices: false }
    }

    /// The use of an image that has the textures of all parts in their channels; `None` without textures. Factors change if texels
    /// would be greater than 1.
    pub fn map(&mut self, parts: &mut [Part]) -> Result<Option<Value>, ExportError> {
        parts.iter_mut().for_each(|part| self.flatten(part));
        if parts.iter().all(|part| part.texture.is_none()) {
            return Ok(None);
        }
        let key = format!("{:?}", parts.iter().map(|part| (&part.texture, part.channel, part.is_free())).collect::<Vec<_>>());
        let mapped = match self.maps.get(&key) {
            Some(known) => known.clone(),
            None => {
                let mapped = match self.passed(parts)? {
                    Some(info) => Some(Mapped { info, scales: vec![1.0; parts.len()] }),
                    None => self.packed(parts)?,
                };
                self.maps.insert(key, mapped.clone());
                mapped
            }
        };
        let Some(Mapped { info, scales }) = mapped else { return Ok(None) };
        self.uses_coordinates = true;
        parts.iter_mut().zip(scales).for_each(|(part, scale)| part.factor = part.factor.map(|x| x * scale));
        Ok(Some(info))
    }

    /// The mean stands for a texture that does not depend on u and v.
    fn flatten(&mut self, part: &mut Part) {
        let Some(name) = part.texture.take_if(|name| !self.colors.is_flat(name)) else { return };
        let mean = match part.channel {
            Channel::Rgb => self.colors.mean(&Textured::Texture(name.clone())),
            _ => [self.colors.mean_number(&Textured::Texture(name.clone())); 3],
        };
        part.factor = std::array::from_fn(|i| part.factor[i] * mean[i]);
        let found = format!("the texture `{name}`, which varies in space");
        self.remark(found, "its mean", "the surface is the same everywhere");
    }

    /// The image of the scene itself, if its channels are those of the parts.
    fn passed(&mut self, parts: &[Part]) -> Result<Option<Value>, ExportError> {
        let mut found: Option<(&str, &Image)> = None;
        for part in parts {
            let Some(name) = &part.texture else { continue };
            let Some(TextureKind::Image(image)) = self.colors.kind(name) else { return Ok(None) };
            let expected = if part.channel == Channel::Rgb { Encoding::Srgb } else { Encoding::Linear };
            let is_same = found.is_none_or(|(_, other)| placement(other) == placement(image) && other.path == image.path);
            if !is_same || image.channel != part.channel || (image.encoding != expected && part.channel != Channel::Alpha) {
                return Ok(None);
            }
            found = found.or(Some((part.name(), image)));
        }
        let Some((name, image)) = found else { return Ok(None) };
        for part in parts.iter().filter(|part| part.texture.is_none() && !part.is_free()) {
            // The file's channel would change a constant.
            if part.channel != Channel::Alpha || !self.is_opaque(&image.path)? {
                return Ok(None);
            }
        }
        if !self.is_web_image(&image.path)? {
            return Ok(None);
        }
        let path = self.new.name(&image.path);
        Ok(Some(self.texture(path, name, image)))
    }

    fn is_opaque(&self, path: &str) -> Result<bool, ExportError> {
        let opacity = ImageTexture::read_opacity(self.resources, "path", path).map_err(|problem| self.invalid(problem))?;
        Ok(opacity.texels().iter().all(|texel| texel[0] == 1.0))
    }

    /// Whether a file is a PNG or a JPEG, by its first bytes.
    pub fn is_web_image(&self, path: &str) -> Result<bool, ExportError> {
        let file = self.resources.file(path);
        let mut start = Vec::new();
        match file.content::<Vec<u8>>() {
            Some(bytes) => start.extend(bytes.iter().take(4)),
            None => {
                let read = open_regular(file.path()).and_then(|file| file.take(4).read_to_end(&mut start));
                let path = file.path().to_owned();
                read.map_err(|error| ExportError::Unreadable { path, reason: error.to_string() })?;
            }
        }
        Ok(start.starts_with(b"\x89PNG") || start.starts_with(b"\xff\xd8"))
    }

    /// The use of an image file as a texture. `image` says how it lies on the surface.
    pub fn texture(&mut self, path: String, name: &str, image: &Image) -> Value {
        let source = self.images.iter().position(|known| *known == path).unwrap_or_else(|| {
            self.images.push(path);
            self.images.len() - 1
        });
        let mut texture = table(json!({ "source": source, "name": name }));
        let wraps = [image.wrap_u, image.wrap_v].map(|wrap| self.wrap(wrap));
        let filter = if image.filter == TexelFilter::Nearest { 9728 } else { 9729 };
        if (wraps, filter) != ([REPEAT; 2], 9729) {
            let [s, t] = wraps;
            let sampler = json!({ "wrapS": s, "wrapT": t, "magFilter": filter, "minFilter": filter });
            texture.insert("sampler".to_owned(), json!(self.document.add_once("samplers", sampler)));
        }
        let index = self.document.add_once("textures", Value::Object(texture));
        let mut info = table(json!({ "index": index }));
        if image.shear != 0.0 {
            self.remark("the shear of an image", "no shear", "the texture lies elsewhere");
        }
        let plain = Image::default();
        if (image.scale, image.rotate, image.offset) != (plain.scale, plain.rotate, plain.offset) {
            // Rotations of the format turn v towards u.
            let turn = 0.0 - image.rotate.to_radians();
            let transform = json!({ "scale": image.scale, "rotation": turn, "offset": image.offset });
            self.document.extend(&mut info, "KHR_texture_transform", transform);
        }
        Value::Object(info)
    }

    fn wrap(&mut self, wrap: Wrap) -> u32 {
        match wrap {
            Wrap::Repeat => REPEAT,
            Wrap::Mirror => 33648,
            Wrap::Clamp => 33071,
            Wrap::Black => {
                self.remark("a wrap mode \"black\"", "\"clamp\"", "the edge of the image continues");
                33071
            }
        }
    }

    /// The error of a file that a texture names.
    pub fn invalid(&self, problem: Problem) -> ExportError {
        ExportError::Invalid { place: self.notes.place().to_owned(), reason: problem.message }
    }
}

/// Code of images that repeat.
const REPEAT: u32 = 10497;

/// An image with nothing but how it lies on the surface.
pub fn placement(image: &Image) -> Image {
    let Image { wrap_u, wrap_v, filter, scale, shear, rotate, offset, .. } = *image;
    Image { wrap_u, wrap_v, filter, scale, shear, rotate, offset, ..Image::default() }
}
