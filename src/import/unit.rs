//! Parts of a whole, such as opacities and weights, from files whose textures exceed 1.
use std::path::Path;

use crate::{
    declare::{Assets, Resources, Textured},
    image::{Encoding, read_light_of},
    scene::description::{SceneDescription, TextureKind},
    texture::{
        image::Image,
        product::Product,
        ramp::{Ramp, Stop},
    },
};

/// Textures within textures that are looked at.
const DEEPEST: usize = 16;

/// The largest value of a texture of a description, or more. `root` is the folder of the scene.
pub fn largest(description: &SceneDescription, assets: &Assets, root: &Path, name: &str) -> f64 {
    Search { description, assets, root }.of_texture(name, DEEPEST)
}

/// The textures for a texture that reaches `most`, which is more than 1, cut at 1: the first one is the input of the second, under the name
/// that the caller gives to it.
pub fn cut(name: String, most: f64) -> (Product, impl FnOnce(String) -> Ramp) {
    let scaled = Product { a: Textured::Texture(name), b: Textured::grey(1.0 / most) };
    let stop = |at: f64, grey: f64| Stop { at, color: [grey; 3] };
    let stops = vec![stop(0.0, 0.0), stop(1.0 / most, 1.0), stop(1.0, 1.0)];
    (scaled, |input| Ramp { input: Textured::Texture(input), stops })
}

struct Search<'a> {
    description: &'a SceneDescription,
    assets: &'a Assets,
    root: &'a Path,
}

impl Search<'_> {
    fn of_texture(&self, name: &str, depth: usize) -> f64 {
        let Some(depth) = depth.checked_sub(1) else { return 1.0 };
        let brightest = |colour: &[f64; 3]| colour.iter().copied().fold(0.0, f64::max);
        let of = |value: &Textured| match value {
            Textured::Constant(colour) => brightest(colour),
            Textured::Texture(name) => self.of_texture(name, depth),
        };
        match self.description.textures.get(name) {
            Some(TextureKind::Image(image)) => self.of_image(image),
            Some(TextureKind::Checker(squares)) => of(&squares.even).max(of(&squares.odd)),
            Some(TextureKind::Mix(mix)) => of(&mix.a).max(of(&mix.b)),
            Some(TextureKind::Product(product)) => of(&product.a) * of(&product.b),
            Some(TextureKind::Noise(noise)) => brightest(&noise.low).max(brightest(&noise.high)),
            Some(TextureKind::Ramp(ramp)) => ramp.stops.iter().map(|stop| brightest(&stop.color)).fold(0.0, f64::max),
            _ => 1.0,
        }
    }

    /// Only some formats have values above 1. What cannot be read has an error of its own.
    fn of_image(&self, image: &Image) -> f64 {
        let ends_in = |end: &&str| image.path.to_ascii_lowercase().ends_with(*end);
        if ![".exr", ".hdr", ".pic", ".pfm"].iter().any(ends_in) {
            return 1.0;
        }
        let file = Resources::new(self.root).with_assets(self.assets.clone()).file(&image.path);
        let read = read_light_of(&file, Encoding::Linear);
        read.map_or(1.0, |texels| {
            texels.radiance.iter().flat_map(|pixel| &pixel[..3]).fold(0.0, |most, x| f64::max(most, (*x).into()))
        })
    }
}
