//! The table of textures: names become ids, picture files are read, and what a texture refers to is built before it.
use std::collections::BTreeMap;

use toml::Spanned;

use super::{
    check::{Checker, ColourRange},
    desc::{CheckerDesc, Colour, NoiseDesc, TextureDesc},
    diagnostic::SceneError,
    errors::Errors,
};
use crate::{
    image::{Encoding, read_light},
    quote,
    texture::{ImageTexture, Texture, Textures},
};

/// Checkers of checkers may go this deep.
const DEEPEST: usize = 64;

/// A colour of the scene: constant or by a texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ColourSource {
    Constant([f32; 3]),
    /// The id in [`Textures`].
    Texture(u32),
}

/// The textures of a scene file and what it calls them.
pub struct NamedTextures {
    pub textures: Textures,
    ids: BTreeMap<String, u32>,
}

impl NamedTextures {
    /// What is wrong goes to `errors`, and a grey takes its place: what refers to it is looked at all the same.
    pub fn compile(check: &Checker, descs: &BTreeMap<String, Spanned<TextureDesc>>, errors: &mut Errors) -> NamedTextures {
        let mut builder = Builder { check, descs, textures: Textures::default(), ids: BTreeMap::new(), open: Vec::new() };
        errors.left_out("textures").for_each(|name| builder.stand_in(name));
        for (name, desc) in descs {
            if errors.are_many() {
                break;
            }
            let built = builder.texture(name, desc);
            if errors.keep(desc, built).is_none() {
                builder.stand_in(name);
            }
        }
        NamedTextures { textures: builder.textures, ids: builder.ids }
    }

    /// The id of a texture by its name.
    pub fn id(&self, check: &Checker, name: &Spanned<String>) -> Result<u32, SceneError> {
        let id = self.ids.get(name.as_ref()).copied();
        id.ok_or_else(|| check.not_defined("texture", name, self.ids.keys()))
    }

    /// A texture without a name, from a picture file.
    pub fn picture(&mut self, check: &Checker, path: &Spanned<String>, encoding: Encoding) -> Result<u32, SceneError> {
        Ok(self.textures.push(image(check, path, encoding)?))
    }

    /// The colour, or the mean colour of the texture.
    pub fn typical(&self, source: ColourSource) -> [f32; 3] {
        match source {
            ColourSource::Constant(colour) => colour,
            ColourSource::Texture(id) => self.textures.mean(id),
        }
    }

    /// A colour or the texture that it names, all of whose values lie in the range.
    pub fn colour_or_texture(
        &self,
        check: &Checker,
        range: &ColourRange,
        value: &Spanned<Colour>,
    ) -> Result<ColourSource, SceneError> {
        let Colour::Texture(name) = value.as_ref() else {
            return Ok(ColourSource::Constant(check.colour(range, value)?));
        };
        let id = self.id(check, name)?;
        let most = self.textures.maximum(id).into_iter().fold(0.0, f32::max);
        if f64::from(most) > range.most {
            let message = format!("`{}` is out of range: texture `{}` reaches {most}", range.what, name.as_ref());
            return Err(check.0.error(name.span(), message, range.expected));
        }
        Ok(ColourSource::Texture(id))
    }
}

fn image(check: &Checker, path: &Spanned<String>, encoding: Encoding) -> Result<Texture, SceneError> {
    let picture = read_light(&check.path(path), encoding)
        .map_err(|error| check.0.error(path.span(), error.to_string(), "this picture cannot be used"))?;
    check.reserve(path.span(), "the texels of a picture", size_of_val(&picture.radiance[..]) as u64)?;
    Ok(Texture::Image(ImageTexture::new(picture)))
}

struct Builder<'a> {
    check: &'a Checker<'a>,
    descs: &'a BTreeMap<String, Spanned<TextureDesc>>,
    textures: Textures,
    ids: BTreeMap<String, u32>,
    /// The textures that are being built, each for the one before it.
    open: Vec<&'a str>,
}

impl<'a> Builder<'a> {
    /// Grey in place of a texture whose error is known.
    fn stand_in(&mut self, name: &str) {
        self.open.clear();
        let grey = self.textures.push(Texture::Constant([0.5; 3]));
        self.ids.insert(name.to_owned(), grey);
    }

    fn texture(&mut self, name: &'a str, desc: &'a Spanned<TextureDesc>) -> Result<u32, SceneError> {
        if let Some(id) = self.ids.get(name) {
            return Ok(*id);
        }
        self.open.push(name);
        let d = desc.as_ref();
        let texture = match (&d.image, &d.checker, &d.noise) {
            (Some(picture), None, None) => image(self.check, &picture.path, picture.encoding)?,
            (None, Some(checker), None) => self.checker(checker)?,
            (None, None, Some(noise)) => self.noise(noise)?,
            (None, None, None) => return Err(self.kinds(desc, &format!("texture `{name}` says no kind"))),
            _ => return Err(self.kinds(desc, &format!("texture `{name}` says more than one kind"))),
        };
        self.open.pop();
        let id = self.textures.push(texture);
        self.ids.insert(name.to_owned(), id);
        Ok(id)
    }

    fn kinds(&self, desc: &Spanned<TextureDesc>, message: &str) -> SceneError {
        self.check.0.error(desc.span(), message, "expected one of `image = { … }`, `checker = { … }` and `noise = { … }`")
    }

    fn checker(&mut self, desc: &'a CheckerDesc) -> Result<Texture, SceneError> {
        let scale = self.check.within("scale", &desc.scale, 1e-6, 1e5)?;
        let (even, odd) = (self.square(&desc.even)?, self.square(&desc.odd)?);
        Ok(Texture::Checker { even, odd, scale })
    }

    fn square(&mut self, value: &'a Spanned<Colour>) -> Result<u32, SceneError> {
        let Colour::Texture(name) = value.as_ref() else {
            let colour = self.check.colour(&ColourRange::TEXTURE, value)?;
            return Ok(self.textures.push(Texture::Constant(colour)));
        };
        let refused = |message: String, label: &str| Err(self.check.0.error(name.span(), message, label));
        if let Some(start) = self.open.iter().position(|open| open == name.as_ref()) {
            let circle: Vec<String> =
                self.open[start..].iter().chain([&self.open[start]]).map(|name| format!("`{}`", quote::piece(name))).collect();
            let shown = match &circle[..] {
                [first, second, .., last] if circle.len() > 6 => format!("{first} uses {second} uses … uses {last}"),
                all => all.join(" uses "),
            };
            return refused(format!("textures in a circle: {shown}"), "this closes the circle");
        }
        if self.open.len() >= DEEPEST {
            return refused(format!("textures are nested deeper than {DEEPEST}"), "too deep");
        }
        if let Some(id) = self.ids.get(name.as_ref()) {
            return Ok(*id);
        }
        let (name, desc) =
            self.descs.get_key_value(name.as_ref()).ok_or_else(|| self.check.not_defined("texture", name, self.descs.keys()))?;
        self.texture(name, desc)
    }

    fn noise(&self, desc: &NoiseDesc) -> Result<Texture, SceneError> {
        let octaves = *desc.octaves.as_ref();
        if !(1..=16).contains(&octaves) {
            let message = format!("`octaves` is out of range: {octaves}");
            return Err(self.check.0.error(desc.octaves.span(), message, "expected a whole number from 1 to 16"));
        }
        Ok(Texture::Noise {
            scale: self.check.within("scale", &desc.scale, 1e-6, 1e5)?,
            octaves,
            low: self.check.colour(&ColourRange::TEXTURE, &desc.low)?,
            high: self.check.colour(&ColourRange::TEXTURE, &desc.high)?,
        })
    }
}
