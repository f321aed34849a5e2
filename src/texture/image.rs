//! Image: the texels of an image with bilinear interpolation.
//!
//! The picture spans the unit square, u to the right and v downwards from its top left corner; texel centres lie at
//! ((i + ½)/width, (j + ½)/height).
use std::sync::{Arc, OnceLock};

use super::{Found, Pattern, Summary, TextureCompiler, TextureCoordinates, Textures, Texturing};
use crate::{
    declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Resources, Value, words},
    image::{Encoding, Texels, read_light_of},
    math::{F, Lanes, M, Pick, U, V, round::floor},
};

/// An image file in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// The file, relative to the scene.
    pub path: String,
    /// Encoding of its numbers.
    pub encoding: Encoding,
    /// The channels that are used.
    pub channel: Channel,
    /// What continues the image in u.
    pub wrap_u: Wrap,
    /// What continues the image in v.
    pub wrap_v: Wrap,
    /// Interpolation between texels.
    pub filter: TexelFilter,
    /// Factors of u and v, applied first.
    pub scale: [f64; 2],
    /// Rotation of u towards v, degrees, applied second.
    pub rotate: f64,
    /// Added to u and v at last.
    pub offset: [f64; 2],
}

impl Default for Image {
    fn default() -> Self {
        Image {
            path: String::new(),
            encoding: Encoding::default(),
            channel: Channel::Rgb,
            wrap_u: Wrap::Repeat,
            wrap_v: Wrap::Repeat,
            filter: TexelFilter::Bilinear,
            scale: [1.0; 2],
            rotate: 0.0,
            offset: [0.0; 2],
        }
    }
}

/// Channels of an image or of vertex colors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// The color.
    Rgb,
    /// The first channel.
    Red,
    /// The second channel.
    Green,
    /// The third channel.
    Blue,
    /// The opacity; 1 if there is none.
    Alpha,
}

words! {
    Channel {
        Rgb: "rgb", "RGB", "The color.";
        Red: "red", "Red", "The first channel, as grey.";
        Green: "green", "Green", "The second channel, as grey.";
        Blue: "blue", "Blue", "The third channel, as grey.";
        Alpha: "alpha", "Alpha", "The opacity, as grey; 1 if the file has none.";
    }
}

/// What continues an image beyond its unit square.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrap {
    /// The image again.
    Repeat,
    /// The mirrored image.
    Mirror,
    /// Its outermost texels.
    Clamp,
    /// Nothing: black.
    Black,
}

words! {
    Wrap {
        Repeat: "repeat", "Repeat", "The image again.";
        Mirror: "mirror", "Mirror", "The image, mirrored every second time.";
        Clamp: "clamp", "Clamp", "The outermost texels.";
        Black: "black", "Black", "Black.";
    }
}

/// Interpolation between texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TexelFilter {
    /// Linear in u and v.
    Bilinear,
    /// None.
    Nearest,
}

words! {
    TexelFilter {
        Bilinear: "bilinear", "Bilinear", "Interpolates between four texels.";
        Nearest: "nearest", "Nearest", "The texel at the point.";
    }
}

impl Kind for Image {
    const KIND: Parameter =
        Parameter::new("image", "An image over the unit square of u and v, repeated.").aliases("bitmap imagemap file");
}

impl Declare for Image {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const PATH: Parameter =
            Parameter::new("path", "PNG, JPEG, TGA, WebP, EXR or HDR file.").required().aliases("file filename src");
        const ENCODING: Parameter = Parameter::new("encoding", "Encoding of the file's numbers; EXR and HDR are always linear.");
        p.value(&PATH, Value::File(&mut self.path));
        const CHANNEL: Parameter = Parameter::new("channel", "The channels that are used.");
        const WRAP_U: Parameter = Parameter::new("wrap_u", "What continues the image in u.");
        const WRAP_V: Parameter = Parameter::new("wrap_v", "What continues the image in v.");
        const FILTER: Parameter = Parameter::new("filter", "Interpolation between texels.");
        const SCALE: Parameter = Parameter::new("scale", "Factors of u and v, applied first.");
        const ROTATE: Parameter = Parameter::new("rotate", "Rotation of u towards v, applied second.").unit("degrees");
        const OFFSET: Parameter = Parameter::new("offset", "Added to u and v at last.");
        p.word(&ENCODING, &mut self.encoding);
        p.word(&CHANNEL, &mut self.channel);
        p.word(&WRAP_U, &mut self.wrap_u);
        p.word(&WRAP_V, &mut self.wrap_v);
        p.word(&FILTER, &mut self.filter);
        p.value(&SCALE, Value::Pair(&mut self.scale));
        p.number(&ROTATE, &mut self.rotate, Range::FINITE);
        p.value(&OFFSET, Value::Pair(&mut self.offset));
    }
}

impl Texturing for Image {
    type Pattern = Arc<ImageTexture>;

    fn compile(&self, compiler: &mut TextureCompiler) -> Result<Arc<ImageTexture>, Problem> {
        ImageTexture::read(compiler.resources, "path", &self.path, self.encoding)
    }
}

impl Pattern for Arc<ImageTexture> {
    fn summary(&self, _: &Textures) -> Summary {
        Summary { mean: self.mean(), maximum: self.maximum(), steps: [self.step_u(), self.step_v(), f32::INFINITY] }
    }

    #[inline(always)]
    fn apply<L: Lanes>(&self, l: L, here: M<L>, at: &TextureCoordinates<L>, found: &mut Found<L>) {
        found.colour = here.pick(self.colour(l, at.u, at.v, Edge::Repeat), found.colour);
    }
}

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
        let file = resources.file(path);
        resources.once("pictures", format!("picture {} {encoding:?}", file.key()), || {
            let picture = read_light_of(&file, encoding)
                .map_err(|error| Problem::at(key, error.to_string(), "this image cannot be used"))?;
            resources.reserve(key, "the texels of an image", size_of_val(&picture.radiance[..]) as u64)?;
            Ok(ImageTexture::new(picture))
        })
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
fn neighbours<L: Lanes>(t: F<L>, size: u32, edge: Edge) -> (U<L>, U<L>, F<L>) {
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
