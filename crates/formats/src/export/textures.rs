//! The colours of textures, for formats without such textures: the mean, or an image.
use std::collections::BTreeSet;

use crate::import::pictures;
use noisefall_base::{
    declare::{Resources, Textured},
    math::{F, M, One, U, V},
};
use noisefall_scene::{
    scene::description::{SceneDescription, TextureKind},
    texture::{TextureCompiler, TextureCoordinates},
};

/// Pixels of a side of an image of a texture.
pub const SIDE: u32 = 1024;
/// Remark on an image of a texture: its size, and what it changes.
pub const BAKED: [&str; 2] =
    ["an image of 1024 × 1024 pixels", "edges are interpolated between pixels, and it repeats outside the unit square"];
/// Textures within textures, as far as their kinds are looked at.
pub const DEEPEST: usize = 64;

/// The textures of a scene.
pub struct Colors<'a> {
    description: &'a SceneDescription,
    compiler: TextureCompiler<'a>,
}

impl<'a> Colors<'a> {
    /// Compiles the textures. Those with an error are grey.
    pub fn new(description: &'a SceneDescription, resources: &'a Resources) -> Colors<'a> {
        let compiler =
            TextureCompiler::new(resources, &description.textures, BTreeSet::new(), std::iter::empty(), &mut Vec::new());
        Colors { description, compiler }
    }

    /// The compiled textures.
    pub fn compiler(&self) -> &TextureCompiler<'a> {
        &self.compiler
    }

    fn id(&self, name: &str) -> Option<u32> {
        self.compiler.id("texture", name).ok()
    }

    /// The texture with a name.
    pub fn kind(&self, name: &str) -> Option<&'a TextureKind> {
        self.description.textures.get(name)
    }

    /// A colour, or the mean of its texture.
    pub fn mean(&self, color: &Textured) -> [f64; 3] {
        match color {
            Textured::Constant(color) => *color,
            Textured::Texture(name) => self.id(name).map_or([0.5; 3], |id| self.compiler.textures.mean(id).map(f64::from)),
        }
    }

    /// A number, or the mean luminance of its texture.
    pub fn mean_number(&self, number: &Textured<f64>) -> f64 {
        match number {
            Textured::Constant(number) => *number,
            Textured::Texture(name) => luminance(self.mean(&Textured::Texture(name.clone()))),
        }
    }

    /// Whether a texture is known to depend on nothing but u and v. Its mean stands for any other one.
    pub fn is_flat(&self, name: &str) -> bool {
        self.is_flat_within(name, DEEPEST)
    }

    fn is_flat_within(&self, name: &str, depth: usize) -> bool {
        let Some(kind) = self.kind(name).filter(|_| depth > 0) else { return false };
        let color = |part: &Textured| match part {
            Textured::Constant(_) => true,
            Textured::Texture(name) => self.is_flat_within(name, depth - 1),
        };
        let number = |part: &Textured<f64>| match part {
            Textured::Constant(_) => true,
            Textured::Texture(name) => self.is_flat_within(name, depth - 1),
        };
        match kind {
            TextureKind::Image(_) => true,
            TextureKind::Checker(checker) => color(&checker.even) && color(&checker.odd),
            TextureKind::Product(product) => color(&product.a) && color(&product.b),
            TextureKind::Mix(mix) => color(&mix.a) && color(&mix.b) && number(&mix.weight),
            TextureKind::Ramp(ramp) => number(&ramp.input),
            _ => false,
        }
    }

    /// The pixels of an image of a texture over the unit square.
    pub fn pixels(&self, name: &str) -> Option<Vec<[f32; 3]>> {
        let id = self.id(name)?;
        let at = |i: u32| (i as f32 + 0.5) / SIDE as f32;
        let pixel = |i: u32| {
            let p = V::splat(One, [0.0; 3]);
            let at = TextureCoordinates { u: F(at(i % SIDE)), v: F(at(i / SIDE)), p, vertex: None };
            let color = self.compiler.textures.colour(One, U(id), M(true), &at);
            [color.x.0, color.y.0, color.z.0]
        };
        Some((0..SIDE * SIDE).map(pixel).collect())
    }

    /// An EXR image of a texture over the unit square, after a function of its colors.
    pub fn exr(&self, name: &str, f: impl Fn([f64; 3]) -> [f64; 3]) -> Option<Vec<u8>> {
        let mut pixels = self.pixels(name)?;
        pixels.iter_mut().for_each(|color| *color = f(color.map(f64::from)).map(|x| x as f32));
        pictures::exr(SIDE, SIDE, &pixels)
    }
}

/// The luminance of linear Rec. 709.
pub fn luminance([r, g, b]: [f64; 3]) -> f64 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}
