//! Image: the texels of an image, or one of their channels.
//!
//! The image spans the unit square, u to the right and v downwards from its top left corner; texel centres lie at
//! ((i + ½)/width, (j + ½)/height).
//!
//! | part | file |
//! |---|---|
//! | the words of its settings | `words.rs` |
//! | texels, repeated with bilinear interpolation | `texels.rs` |
//! | lookups with other settings | `sampled.rs` |
//! | scale, rotation and offset of u and v | `uv_map.rs` |
//! | texels that interpolation needs, by the wrap of an axis | `wrapping.rs` |
//! | exact means over the unit square | `mean.rs` |
mod mean;
mod sampled;
mod texels;
mod uv_map;
mod words;
mod wrapping;

use std::sync::Arc;

pub use self::{
    sampled::SampledImage,
    texels::{Edge, ImageTexture},
    words::{Channel, TexelFilter, Wrap},
};
use super::{LookupResult, Pattern, Summary, TextureCompiler, TextureCoordinates, Textures, Texturing};
use crate::image::Encoding;
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Value},
    math::{Lanes, M, Pick},
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
    /// How the image continues beyond 0 and 1 in u.
    pub wrap_u: Wrap,
    /// How the image continues beyond 0 and 1 in v.
    pub wrap_v: Wrap,
    /// Interpolation between texels.
    pub filter: TexelFilter,
    /// Factors of u and v, applied first.
    pub scale: [f64; 2],
    /// Multiple of v that is added to u, applied after the scale.
    pub shear: f64,
    /// Rotation of u towards v, degrees, applied after that.
    pub rotate: f64,
    /// Offset that is added to u and v, applied last.
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
            shear: 0.0,
            rotate: 0.0,
            offset: [0.0; 2],
        }
    }
}

impl Kind for Image {
    const KIND: Parameter = Parameter::new("image", "An image over the unit square of u and v.").aliases("bitmap imagemap file");
}

impl Declare for Image {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const PATH: Parameter =
            Parameter::new("path", "PNG, JPEG, TGA, WebP, BMP, EXR, HDR or PFM file.").required().aliases("file filename src");
        const ENCODING: Parameter =
            Parameter::new("encoding", "Encoding of the file's numbers; EXR, HDR and PFM are always linear.");
        const CHANNEL: Parameter = Parameter::new("channel", "The channels that are used.");
        const WRAP_U: Parameter = Parameter::new("wrap_u", "How the image continues beyond 0 and 1 in u.");
        const WRAP_V: Parameter = Parameter::new("wrap_v", "How the image continues beyond 0 and 1 in v.");
        const FILTER: Parameter = Parameter::new("filter", "Interpolation between texels.");
        const SCALE: Parameter = Parameter::new("scale", "Factors that multiply u and v, applied first. v points downwards.");
        const SHEAR: Parameter = Parameter::new("shear", "Multiple of v that is added to u, applied after the scale.");
        const ROTATE: Parameter = Parameter::new("rotate", "Rotation from u towards v, applied after the shear.").unit("°");
        const OFFSET: Parameter = Parameter::new("offset", "Offset that is added to u and v, applied last.");
        p.value(&PATH, Value::File(&mut self.path));
        p.word(&ENCODING, &mut self.encoding);
        p.word(&CHANNEL, &mut self.channel);
        p.word(&WRAP_U, &mut self.wrap_u);
        p.word(&WRAP_V, &mut self.wrap_v);
        p.word(&FILTER, &mut self.filter);
        p.value(&SCALE, Value::Pair(&mut self.scale));
        p.number(&SHEAR, &mut self.shear, Range::linear(-1e4, 1e4));
        p.number(&ROTATE, &mut self.rotate, Range::FINITE);
        p.value(&OFFSET, Value::Pair(&mut self.offset));
    }
}

impl Image {
    /// Whether it is repeated in the coordinates of the surface, with bilinear interpolation of its color.
    fn is_plain(&self) -> bool {
        *self == Image { path: self.path.clone(), encoding: self.encoding, ..Image::default() }
    }
}

impl Texturing for Image {
    type Pattern = ImagePattern;

    fn compile(&self, compiler: &mut TextureCompiler) -> Result<ImagePattern, Problem> {
        let resources = compiler.resources;
        let texels = ImageTexture::read_image(resources, compiler.pictures(), self)?;
        if self.is_plain() {
            return Ok(ImagePattern::Plain(texels));
        }
        // The mean may take a visit to all texels.
        let key = format!("sampled {} {self:?}", resources.file(&self.path).key());
        resources.hold(key, || SampledImage::new(texels, self)).map(ImagePattern::Sampled)
    }
}

/// Steps of finite differences, in halves of a texel: small, because the slope of interpolated texels changes from one to the next.
const SLOPE: f32 = 1.0 / 16.0;

/// An image as the renderer looks it up.
pub enum ImagePattern {
    /// With the default settings.
    Plain(Arc<ImageTexture>),
    /// With other settings.
    Sampled(Arc<SampledImage>),
}

impl Pattern for ImagePattern {
    fn summary(&self, _: &Textures) -> Summary {
        match self {
            ImagePattern::Plain(image) => Summary {
                mean: image.mean(),
                maximum: image.maximum(),
                steps: [image.step_u() * SLOPE, image.step_v() * SLOPE, f32::INFINITY],
                lookups: 0,
            },
            ImagePattern::Sampled(image) => image.summary(),
        }
    }

    #[inline(always)]
    fn apply<L: Lanes>(&self, l: L, here: M<L>, at: &TextureCoordinates<L>, _: &Textures, found: &mut LookupResult<L>) {
        let colour = match self {
            ImagePattern::Plain(image) => image.colour(l, at.u, at.v, Edge::Repeat),
            ImagePattern::Sampled(image) => image.colour(l, at.u, at.v),
        };
        found.colour = here.pick(colour, found.colour);
    }
}
