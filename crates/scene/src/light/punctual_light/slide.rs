//! The image that a light casts.
use std::sync::Arc;

use crate::{
    image::Encoding,
    texture::{
        Edge, ImageTexture,
        image::{Image, SampledImage, TexelFilter, Wrap},
    },
};
use noisefall_base::{
    declare::{Problem, Resources},
    math::{F, Lanes, V},
};

/// The image that a light casts, over the unit square. Clones share its texels.
#[derive(Clone)]
pub enum Slide {
    /// The outermost texels continue it.
    Held(Arc<ImageTexture>),
    /// With other settings.
    Sampled(Arc<ImageTexture>, Arc<SampledImage>),
}

impl Slide {
    /// Reads the file that a description names as `image`.
    pub fn read(
        resources: &Resources,
        path: &str,
        encoding: Encoding,
        (wrap, filter): (Wrap, TexelFilter),
    ) -> Result<Slide, Problem> {
        let texels = ImageTexture::read(resources, "image", path, encoding)?;
        // Within the image, a mirrored one continues as a clamped one does.
        if filter == TexelFilter::Bilinear && matches!(wrap, Wrap::Clamp | Wrap::Mirror) {
            return Ok(Slide::Held(texels));
        }
        let path = path.to_owned();
        let image = Image { path, encoding, wrap_u: wrap, wrap_v: wrap, filter, ..Image::default() };
        let key = format!("slide {} {image:?}", resources.file(&image.path).key());
        let sampled = resources.hold(key, || SampledImage::new(texels.clone(), &image))?;
        Ok(Slide::Sampled(texels, sampled))
    }

    /// Width over height.
    pub fn aspect(&self) -> f64 {
        let (Slide::Held(texels) | Slide::Sampled(texels, _)) = self;
        f64::from(texels.step_v() / texels.step_u())
    }

    /// The mean over the image.
    pub fn mean(&self) -> [f32; 3] {
        match self {
            Slide::Held(texels) => texels.mean(),
            Slide::Sampled(_, sampled) => sampled.summary().mean,
        }
    }

    /// Whether both are the same in memory.
    pub fn is_same(&self, other: &Slide) -> bool {
        match (self, other) {
            (Slide::Held(a), Slide::Held(b)) => Arc::ptr_eq(a, b),
            (Slide::Sampled(_, a), Slide::Sampled(_, b)) => Arc::ptr_eq(a, b),
            _ => false,
        }
    }

    /// The colour at (u, v) of the image.
    #[inline(always)]
    pub fn colour<L: Lanes>(&self, l: L, u: F<L>, v: F<L>) -> V<L> {
        match self {
            Slide::Held(texels) => {
                // An image repeats in u: half a texel from its edges is the last place that does not blend with the other edge.
                let rim = texels.step_u();
                texels.colour(l, u.max(l.f(rim)).min(l.f(1.0 - rim)), v, Edge::Clamp)
            }
            Slide::Sampled(_, sampled) => sampled.colour(l, u, v),
        }
    }
}
