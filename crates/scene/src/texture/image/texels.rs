//! The table of an image's texels, repeated with bilinear interpolation.
use std::sync::{Arc, OnceLock};

use super::{Channel, Image};
use crate::{
    image::{Encoding, PictureError, Texels, read_light_of, read_opacity_of},
    texture::PICTURES,
};
use noisefall_base::{
    declare::{NamedFile, Problem, Resources},
    math::{F, Lanes, Pick, U, V, round::floor},
};

/// Tells the texels of a file's opacity from its others.
const OPACITY: &str = "opacity";

/// Wrapping of an image at its top and bottom. At left and right it always repeats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// Repeats the image.
    Repeat,
    /// Continues the first and the last row.
    Clamp,
}

/// An image as a table of texels.
pub struct ImageTexture {
    width: u32,
    height: u32,
    texels: Vec<[f32; 4]>,
    /// Computed at its first use: compiles that reuse the texture need no visit to all texels.
    colours: OnceLock<Colours>,
}

/// Mean and largest value of the texels.
#[derive(Clone, Copy)]
struct Colours {
    mean: [f32; 3],
    maximum: [f32; 3],
}

impl ImageTexture {
    /// Makes a texture of an image.
    pub fn new(picture: Texels) -> ImageTexture {
        ImageTexture { width: picture.width, height: picture.height, texels: picture.radiance, colours: OnceLock::new() }
    }

    /// Reads the file that a description names at a key. Textures of the same file and encoding share their texels.
    pub fn read(resources: &Resources, key: &str, path: &str, encoding: Encoding) -> Result<Arc<ImageTexture>, Problem> {
        ImageTexture::decoded(resources, PICTURES, [key, path, &format!("{encoding:?}")], |file| read_light_of(file, encoding))
    }

    /// Reads the opacity of the file, as grey.
    pub fn read_opacity(resources: &Resources, key: &str, path: &str) -> Result<Arc<ImageTexture>, Problem> {
        ImageTexture::decoded(resources, PICTURES, [key, path, OPACITY], read_opacity_of)
    }

    /// Reads the image of a texture. `part` is the name of its texels in the report of the compile.
    pub fn read_image(resources: &Resources, part: &'static str, image: &Image) -> Result<Arc<ImageTexture>, Problem> {
        let decoded =
            |what, read: &dyn Fn(&NamedFile) -> _| ImageTexture::decoded(resources, part, ["path", &image.path, what], read);
        match image.channel {
            Channel::Alpha => decoded(OPACITY, &read_opacity_of),
            _ => decoded(&format!("{:?}", image.encoding), &|file| read_light_of(file, image.encoding)),
        }
    }

    /// Decodes a file once; `what` tells its texels from others of the same file.
    fn decoded(
        resources: &Resources,
        part: &'static str,
        [key, path, what]: [&str; 3],
        read: impl FnOnce(&NamedFile) -> Result<Texels, PictureError>,
    ) -> Result<Arc<ImageTexture>, Problem> {
        let file = resources.file(path);
        resources.once(part, format!("image {} {what}", file.key()), || {
            let picture = read(&file).map_err(|error| Problem::at(key, error.to_string(), "this image cannot be used"))?;
            resources.reserve(key, "the texels of an image", size_of_val(&picture.radiance[..]) as u64)?;
            Ok(ImageTexture::new(picture))
        })
    }

    /// Width and height in texels.
    pub fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// The texels, row by row.
    pub fn texels(&self) -> &[[f32; 4]] {
        &self.texels
    }

    /// The colour at (u, v). Any numbers are allowed: NaN and infinity give some colour of the image.
    #[inline(always)]
    pub fn colour<L: Lanes>(&self, l: L, u: F<L>, v: F<L>, edge: Edge) -> V<L> {
        let (left, right, x) = neighbours(u - floor(u).0, self.width, Edge::Repeat);
        let v = match edge {
            Edge::Repeat => v - floor(v).0,
            Edge::Clamp => v,
        };
        let (upper, lower, y) = neighbours(v, self.height, edge);
        let (upper, lower) = (upper * self.width, lower * self.width);
        let top = self.mix(l, upper + left, upper + right, x);
        let bottom = self.mix(l, lower + left, lower + right, x);
        top * (1.0 - y) + bottom * y
    }

    #[inline(always)]
    fn mix<L: Lanes>(&self, l: L, a: U<L>, b: U<L>, t: F<L>) -> V<L> {
        let [ax, ay, az, _] = l.rows(&self.texels, a);
        let [bx, by, bz, _] = l.rows(&self.texels, b);
        V { x: ax, y: ay, z: az } * (1.0 - t) + V { x: bx, y: by, z: bz } * t
    }

    /// The mean over the unit square; for repeated bilinear texels this is the mean texel.
    pub fn mean(&self) -> [f32; 3] {
        self.colours().mean
    }

    /// The largest value of each channel.
    pub fn maximum(&self) -> [f32; 3] {
        self.colours().maximum
    }

    fn colours(&self) -> Colours {
        let sum = |channel: usize| self.texels.iter().map(|texel| f64::from(texel[channel])).sum::<f64>();
        let largest = |channel: usize| self.texels.iter().map(|texel| texel[channel]).fold(0.0, f32::max);
        *self.colours.get_or_init(|| Colours {
            mean: [0, 1, 2].map(|channel| (sum(channel) / self.texels.len() as f64) as f32),
            maximum: [0, 1, 2].map(largest),
        })
    }

    /// Half a texel.
    pub fn step_u(&self) -> f32 {
        0.5 / self.width as f32
    }
    /// Height of a texel in v.
    pub fn step_v(&self) -> f32 {
        0.5 / self.height as f32
    }
}

/// The two texels whose centres enclose `t` in [0, 1] on an axis of `size` texels, and the fraction from the first to the second.
#[inline(always)]
pub(super) fn neighbours<L: Lanes>(t: F<L>, size: u32, edge: Edge) -> (U<L>, U<L>, F<L>) {
    // NaN becomes 1: whatever a lane holds, the texels exist.
    let t = t.min(t.splat(1.0)).max(t.splat(0.0));
    let x = t * size as f32 - 0.5;
    let (start, first) = floor(x);
    let second = first + 1;
    let (before, after) = match edge {
        Edge::Repeat => (size - 1, 0),
        Edge::Clamp => (0, size - 1),
    };
    let before = U(L::splat_int(first.0, before));
    let after = U(L::splat_int(first.0, after));
    (first.is(u32::MAX).pick(before, first), second.is(size).pick(after, second), x - start)
}
