//! The textures of a scene while it is compiled: names become ids, and what a texture refers to is compiled before it.
use std::collections::{BTreeMap, BTreeSet};

use super::{Constant, Texture, TextureKind, Textures};
use noisefall_base::{
    declare::{Family, Parameter, Path, Problem, Range, Resources, Textured},
    quote,
};

/// Textures of textures may go this deep.
const DEEPEST: usize = 64;
/// Names of the texels of images in the report of a compile: those that the scene uses, and the others.
pub const PICTURES: &str = "images";
pub const UNUSED_PICTURES: &str = "unused images";
/// Most lookups of other textures that one lookup may make. n nested products of a texture with itself would make 2ⁿ.
pub(super) const MOST_LOOKUPS: u32 = 64;

/// A colour of the scene: constant or by a texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ColourSource {
    /// A constant colour.
    Constant([f32; 3]),
    /// The id in [`Textures`].
    Texture(u32),
}

/// A number of the scene: constant, or the luminance of a texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NumberSource {
    /// A constant number.
    Constant(f32),
    /// The id in [`Textures`].
    Texture(u32),
}

/// The textures that are compiled so far, and what the scene calls them.
pub struct TextureCompiler<'a> {
    /// Files and memory.
    pub resources: &'a Resources,
    /// The textures so far.
    pub textures: Textures,
    described: &'a BTreeMap<String, TextureKind>,
    /// The names of those that something in the scene uses.
    used: BTreeSet<String>,
    ids: BTreeMap<String, u32>,
    /// The textures that are being compiled, each for the one before it.
    open: Vec<String>,
}

impl<'a> TextureCompiler<'a> {
    /// Compiles all textures. Problems go to `problems`, and grey replaces the texture so that references to it can still be checked.
    /// `used` are names of textures that something in the scene uses, and `stand_ins` of those that could not be read at all.
    pub fn new<'n>(
        resources: &'a Resources,
        described: &'a BTreeMap<String, TextureKind>,
        used: BTreeSet<String>,
        stand_ins: impl Iterator<Item = &'n str>,
        problems: &mut Vec<Problem>,
    ) -> TextureCompiler<'a> {
        let mut compiler =
            TextureCompiler { resources, textures: Textures::default(), described, used, ids: BTreeMap::new(), open: Vec::new() };
        stand_ins.for_each(|name| compiler.stand_in(name));
        for name in described.keys() {
            if let Err(problem) = compiler.texture(name) {
                // The texture that closes a circle, or goes too deep, may be another than the one that is compiled.
                let place = compiler.open.last().map_or(name.as_str(), String::as_str);
                problems.push(problem.within(&Path::of("textures").key(place)));
                compiler.stand_in(name);
            }
        }
        compiler
    }

    /// The report's name for the texels of the texture that is being compiled.
    pub fn pictures(&self) -> &'static str {
        let is_unused = self.open.last().is_some_and(|name| !self.used.contains(name));
        if is_unused { UNUSED_PICTURES } else { PICTURES }
    }

    fn stand_in(&mut self, name: &str) {
        self.open.clear();
        let grey = self.textures.push(Texture::Constant(Constant([0.5; 3])));
        self.ids.insert(name.to_owned(), grey);
    }

    fn texture(&mut self, name: &str) -> Result<u32, Problem> {
        if let Some(id) = self.ids.get(name) {
            return Ok(*id);
        }
        let kind = &self.described[name];
        self.open.push(name.to_owned());
        let texture = kind.compile(self).map_err(|problem| problem.within(&Path::of(kind.name())))?;
        let id = self.textures.push(texture);
        let lookups = self.textures.lookups(id);
        if lookups > MOST_LOOKUPS {
            let message = format!("a lookup of this texture takes {lookups} lookups of others, more than {MOST_LOOKUPS}");
            return Err(Problem::at(kind.name(), message, "it combines too many"));
        }
        self.open.pop();
        self.ids.insert(name.to_owned(), id);
        Ok(id)
    }

    /// The id of a part of a texture: of a colour, or of another texture, which is compiled first.
    pub fn part(&mut self, key: &str, value: &Textured) -> Result<u32, Problem> {
        match self.source(key, value)? {
            ColourSource::Constant(colour) => Ok(self.textures.push(Texture::Constant(Constant(colour)))),
            ColourSource::Texture(id) => Ok(id),
        }
    }

    /// A part of a texture: a colour, or another texture, which is compiled first.
    pub fn source(&mut self, key: &str, value: &Textured) -> Result<ColourSource, Problem> {
        match value {
            Textured::Constant(colour) => Ok(ColourSource::Constant(colour.map(|x| x as f32))),
            Textured::Texture(name) => self.nested(key, name).map(ColourSource::Texture),
        }
    }

    /// A part of a texture that is a fraction: a number from 0 to 1, or another texture, which is compiled first.
    pub fn fraction(&mut self, key: &str, value: &Textured<f64>) -> Result<NumberSource, Problem> {
        let name = match value {
            Textured::Constant(x) => return Ok(NumberSource::Constant(*x as f32)),
            Textured::Texture(name) => name,
        };
        let id = self.nested(key, name)?;
        self.check_range(key, (name, id), &Range::UNIT)?;
        Ok(NumberSource::Texture(id))
    }

    /// The id of a texture that another one names at a key; it is compiled first.
    fn nested(&mut self, key: &str, name: &str) -> Result<u32, Problem> {
        let at = format!("{key}.texture");
        if let Some(start) = self.open.iter().position(|open| open.as_str() == name) {
            let circle: Vec<String> =
                self.open[start..].iter().chain([&self.open[start]]).map(|name| format!("`{}`", quote::piece(name))).collect();
            let shown = match &circle[..] {
                [first, second, .., last] if circle.len() > 6 => format!("{first} uses {second} uses … uses {last}"),
                all => all.join(" uses "),
            };
            return Err(Problem::at(&at, format!("textures in a circle: {shown}"), "this closes the circle"));
        }
        if self.open.len() >= DEEPEST {
            return Err(Problem::at(&at, format!("textures are nested deeper than {DEEPEST}"), "too deep"));
        }
        if self.described.contains_key(name) {
            return self.texture(name);
        }
        self.id(&at, name)
    }

    /// The id of a texture by its name, which stands at a key.
    pub fn id(&self, key: &str, name: &str) -> Result<u32, Problem> {
        let known = || self.ids.keys().chain(self.described.keys().filter(|name| !self.ids.contains_key(*name)));
        self.ids.get(name).copied().ok_or_else(|| Problem::not_defined(key, Family::Texture, name, known()))
    }

    /// Adds a texture without a name.
    pub fn push(&mut self, texture: Texture) -> u32 {
        self.textures.push(texture)
    }

    /// The colour or the texture of a parameter, all of whose values lie in the range.
    pub fn colour(&self, parameter: &Parameter, value: &Textured, range: &Range) -> Result<ColourSource, Problem> {
        let name = match value {
            Textured::Constant(colour) => return Ok(ColourSource::Constant(colour.map(|x| x as f32))),
            Textured::Texture(name) => name,
        };
        let id = self.id(&format!("{}.texture", parameter.key), name)?;
        self.check_range(parameter.key, (name, id), range)?;
        Ok(ColourSource::Texture(id))
    }

    /// Checks that a texture at a key does not exceed the range.
    fn check_range(&self, key: &str, (name, id): (&str, u32), range: &Range) -> Result<(), Problem> {
        let most = self.textures.maximum(id).into_iter().fold(0.0, f32::max);
        if f64::from(most) > range.most {
            let message = format!("`{key}` is out of range: texture `{name}` reaches {most}");
            let label = match range.expected {
                "" => format!("expected at most {}: a `product` scales it, and a `ramp` cuts it", range.most),
                said => said.to_owned(),
            };
            return Err(Problem::at(&format!("{key}.texture"), message, label));
        }
        Ok(())
    }

    /// The number or the texture of a parameter, all of whose values lie in the range.
    pub fn number(&self, parameter: &Parameter, value: &Textured<f64>, range: &Range) -> Result<NumberSource, Problem> {
        let name = match value {
            Textured::Constant(number) => return Ok(NumberSource::Constant(*number as f32)),
            Textured::Texture(name) => name,
        };
        Ok(match self.colour(parameter, &Textured::Texture(name.clone()), range)? {
            ColourSource::Constant([number, ..]) => NumberSource::Constant(number),
            ColourSource::Texture(id) => NumberSource::Texture(id),
        })
    }

    /// The colour, or the mean colour of the texture.
    pub fn typical(&self, source: ColourSource) -> [f32; 3] {
        match source {
            ColourSource::Constant(colour) => colour,
            ColourSource::Texture(id) => self.textures.mean(id),
        }
    }

    /// The largest value of each channel.
    pub fn maximum(&self, source: ColourSource) -> [f32; 3] {
        match source {
            ColourSource::Constant(colour) => colour,
            ColourSource::Texture(id) => self.textures.maximum(id),
        }
    }

    /// The largest value of any channel, at most 1.
    pub fn largest(&self, source: ColourSource) -> f32 {
        self.maximum(source).into_iter().fold(0.0, f32::max).min(1.0)
    }
}
