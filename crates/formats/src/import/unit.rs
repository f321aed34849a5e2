//! Parts of a whole, such as opacities, weights and reflectances, from files whose textures exceed 1.
use std::path::Path;

use crate::import::{Names, pictures::exr};
use noisefall_base::declare::{Assets, Resources, Textured};
use noisefall_scene::{
    image::{Encoding, Texels, read_light_of},
    scene::description::{SceneDescription, TextureKind},
    texture::{
        image::{Channel, Image},
        mix::Mix,
        product::Product,
        ramp::{Ramp, Stop},
    },
};

/// Textures within textures that are looked at.
const DEEPEST: usize = 16;

/// The largest value of a texture of a description, or more. `root` is the folder of the scene.
pub fn largest(description: &SceneDescription, assets: &Assets, root: &Path, name: &str) -> f64 {
    brightest(Search { description, assets, root, is_exact: false }.of_texture(name, DEEPEST))
}

/// The largest value in each channel. All images are read.
pub fn channels(description: &SceneDescription, assets: &Assets, root: &Path, name: &str) -> [f64; 3] {
    Search { description, assets, root, is_exact: true }.of_texture(name, DEEPEST)
}

/// The textures for a texture that reaches `most`, which is more than 1, cut at 1: the first one is the input of the second, under the name
/// that the caller gives to it.
pub fn cut(name: String, most: f64) -> (Product, impl FnOnce(String) -> Ramp) {
    let scaled = Product { a: Textured::Texture(name), b: Textured::grey(1.0 / most) };
    let stop = |at: f64, grey: f64| Stop { at, color: [grey; 3] };
    let stops = vec![stop(0.0, 0.0), stop(1.0 / most, 1.0), stop(1.0, 1.0)];
    (scaled, |input| Ramp { input: Textured::Texture(input), stops })
}

/// Limits textures, under new names.
pub struct Limiter<'a> {
    pub description: &'a mut SceneDescription,
    pub assets: &'a mut Assets,
    /// The folder of the scene.
    pub root: &'a Path,
    /// Names of the textures.
    pub names: &'a mut Names,
}

impl Limiter<'_> {
    /// A texture of at most `most`, in place of one that may exceed it. Images are cut texel by texel.
    pub fn texture(&mut self, name: &str, most: f64) -> String {
        self.limited(name, most, DEEPEST)
    }

    fn limited(&mut self, name: &str, most: f64, depth: usize) -> String {
        let Some((depth, kind)) = depth.checked_sub(1).zip(self.description.textures.get(name).cloned()) else {
            return name.to_owned();
        };
        let mut limit = |value: &Textured, most: f64| match value {
            Textured::Constant(colour) => Textured::Constant(colour.map(|x| x.min(most))),
            Textured::Texture(name) => Textured::Texture(self.limited(name, most, depth)),
        };
        let limited: TextureKind = match &kind {
            TextureKind::Image(image) => {
                let Some(bytes) = cut_image(self.assets, self.root, image, most) else { return name.to_owned() };
                let name = self.names.unique(&format!("{name} cut"), "texture");
                let path = format!("textures/{name}.exr");
                self.assets.insert(path.clone(), bytes);
                let cut = Image { path, encoding: Encoding::Linear, ..image.clone() };
                self.description.textures.insert(name.clone(), cut.into());
                return name;
            }
            TextureKind::Mix(mix) => Mix { a: limit(&mix.a, most), b: limit(&mix.b, most), weight: mix.weight.clone() }.into(),
            TextureKind::Product(product) => match (&product.a, &product.b) {
                (Textured::Constant(factor), b) | (b, Textured::Constant(factor)) => {
                    Product { a: Textured::Constant(*factor), b: limit(b, most / brightest(*factor).max(1e-12)) }.into()
                }
                (a, b) => Product { a: limit(a, most.min(1.0)), b: limit(b, most) }.into(),
            },
            _ => return name.to_owned(),
        };
        if limited == kind {
            return name.to_owned();
        }
        let name = self.names.unique(&format!("{name} cut"), "texture");
        self.description.textures.insert(name.clone(), limited);
        name
    }
}

/// Whether the format of an image can have values above 1.
fn is_of_light(image: &Image) -> bool {
    let ends_in = |end: &&str| image.path.to_ascii_lowercase().ends_with(*end);
    [".exr", ".hdr", ".pic", ".pfm"].iter().any(ends_in)
}

fn texels(assets: &Assets, root: &Path, image: &Image) -> Option<Texels> {
    let file = Resources::new(root).with_assets(assets.clone()).file(&image.path);
    read_light_of(&file, image.encoding).ok()
}

fn greatest(texels: &Texels) -> [f64; 3] {
    texels.radiance.iter().fold([0.0; 3], |most, [r, g, b, _]| each(most, [*r, *g, *b].map(f64::from), f64::max))
}

/// The image cut at `most`, encoded, if it has greater values.
fn cut_image(assets: &Assets, root: &Path, image: &Image, most: f64) -> Option<Vec<u8>> {
    let may_exceed = image.channel != Channel::Alpha && (most < 1.0 || is_of_light(image));
    let texels = may_exceed.then(|| texels(assets, root, image)).flatten().filter(|texels| brightest(greatest(texels)) > most)?;
    let pixels: Vec<[f32; 3]> = texels.radiance.iter().map(|pixel| [0, 1, 2].map(|i| pixel[i].min(most as f32))).collect();
    exr(texels.width, texels.height, &pixels)
}

struct Search<'a> {
    description: &'a SceneDescription,
    assets: &'a Assets,
    root: &'a Path,
    /// Whether images are read that cannot exceed 1.
    is_exact: bool,
}

impl Search<'_> {
    /// The largest value in each channel, or more.
    fn of_texture(&self, name: &str, depth: usize) -> [f64; 3] {
        let Some(depth) = depth.checked_sub(1) else { return [1.0; 3] };
        let of = |value: &Textured| match value {
            Textured::Constant(colour) => *colour,
            Textured::Texture(name) => self.of_texture(name, depth),
        };
        match self.description.textures.get(name) {
            Some(TextureKind::Image(image)) => self.of_image(image),
            Some(TextureKind::Checker(squares)) => each(of(&squares.even), of(&squares.odd), f64::max),
            Some(TextureKind::Mix(mix)) => each(of(&mix.a), of(&mix.b), f64::max),
            Some(TextureKind::Product(product)) => each(of(&product.a), of(&product.b), |a, b| a * b),
            Some(TextureKind::Noise(noise)) => each(noise.low, noise.high, f64::max),
            Some(TextureKind::Ramp(ramp)) => ramp.stops.iter().fold([0.0; 3], |most, stop| each(most, stop.color, f64::max)),
            _ => [1.0; 3],
        }
    }

    fn of_image(&self, image: &Image) -> [f64; 3] {
        if !self.is_exact && !is_of_light(image) {
            return [1.0; 3];
        }
        // A file that cannot be read has an error of its own.
        let Some(texels) = texels(self.assets, self.root, image) else { return [1.0; 3] };
        match image.channel {
            Channel::Rgb => greatest(&texels),
            _ => [brightest(greatest(&texels)); 3],
        }
    }
}

fn each(a: [f64; 3], b: [f64; 3], combine: impl Fn(f64, f64) -> f64) -> [f64; 3] {
    [0, 1, 2].map(|channel| combine(a[channel], b[channel]))
}

fn brightest(colour: [f64; 3]) -> f64 {
    colour.into_iter().fold(0.0, f64::max)
}
