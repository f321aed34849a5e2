//! Textures: colours that vary over a surface.
//!
//! A kind is one file and one line of the catalogue below. Its file holds the description, with its parameters, and the [`Pattern`] that
//! the renderer looks up.
pub mod checker;
mod compiler;
mod constant;
pub mod image;
pub mod mix;
pub mod noise;
mod parts;
pub mod product;
pub mod ramp;
#[cfg(test)]
mod tests;
pub mod vertex_color;

use fearless_simd_macros::simd;

pub use self::{
    compiler::{ColourSource, NumberSource, PICTURES, TextureCompiler, UNUSED_PICTURES},
    constant::Constant,
    image::{Edge, ImagePattern, ImageTexture},
};
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters, Problem},
    math::{F, Lanes, M, U, V, colour::LUMINANCE},
};

macro_rules! textures {
    ($($module:ident::$Kind:ident),+ $(,)?) => {
        noisefall_base::declare::catalogue! {
            /// A texture as a scene describes it.
            pub enum TextureKind: Declare, "texture" { $($module::$Kind),+ }
        }

        impl TextureKind {
            /// The texture as the renderer looks it up.
            fn compile(&self, compiler: &mut TextureCompiler) -> Result<Texture, Problem> {
                match self {
                    $(TextureKind::$Kind(kind) => kind.compile(compiler).map(Texture::$Kind)),+
                }
            }
        }

        /// A texture as the renderer looks it up. Colours are linear Rec. 709.
        pub enum Texture {
            /// A constant colour.
            Constant(Constant),
            $(
                #[doc = concat!("The texture in `", stringify!($module), ".rs`.")]
                $Kind(<$module::$Kind as Texturing>::Pattern)
            ),+
        }

        /// `in_texture!(texture, pattern => call(pattern))`: the call with the pattern of a texture.
        macro_rules! in_texture {
            ($texture:expr, $pattern:ident => $call:expr) => {
                match $texture {
                    Texture::Constant($pattern) => $call,
                    $(Texture::$Kind($pattern) => $call),+
                }
            };
        }
    };
}

textures! {
    image::Image,
    checker::Checker,
    noise::Noise,
    product::Product,
    mix::Mix,
    ramp::Ramp,
    vertex_color::VertexColor,
}

/// The key of a texture that replaces a value.
pub const TEXTURE: Parameter = Parameter::new("texture", "The name of a texture.");

/// A kind of texture.
pub trait Texturing: Kind {
    /// The form that the renderer looks up.
    type Pattern: Pattern;

    /// The texture as the renderer looks it up.
    fn compile(&self, compiler: &mut TextureCompiler) -> Result<Self::Pattern, Problem>;
}

/// How a texture varies.
pub trait Pattern {
    /// Whether it needs the colours of vertices.
    const READS_VERTICES: bool = false;

    /// Its properties besides its colours; `textures` holds those that it refers to.
    fn summary(&self, textures: &Textures) -> Summary;

    /// Writes the colour, or the texture to look up in its place, in the lanes `here`. A texture that combines several looks them
    /// up among `textures`.
    fn apply<L: Lanes>(&self, l: L, here: M<L>, at: &TextureCoordinates<L>, textures: &Textures, found: &mut LookupResult<L>);
}

/// Result of a lookup so far.
pub struct LookupResult<L: Lanes> {
    /// The texture that is still to be looked up.
    pub id: U<L>,
    /// The colour.
    pub colour: V<L>,
}

/// Properties of a texture besides its colours.
pub struct Summary {
    /// Mean over the unit square.
    pub mean: [f32; 3],
    /// The largest value of each channel.
    pub maximum: [f32; 3],
    /// In u, in v, and in metres: see [`Steps`].
    pub steps: [f32; 3],
    /// Lookups of other textures that a lookup makes at most: see [`Textures::lookups`].
    pub lookups: u32,
}

impl Summary {
    /// Steps of u and v where the texture itself asks for no finer ones.
    pub const COARSEST: f32 = 1.0 / 64.0;
}

/// The point of a texture lookup.
#[derive(Clone, Copy)]
pub struct TextureCoordinates<'a, L: Lanes> {
    /// Surface coordinates, in [0, 1) on analytic shapes; meshes may exceed it.
    pub u: F<L>,
    /// The second surface coordinate.
    pub v: F<L>,
    /// World-space position, metres.
    pub p: V<L>,
    /// Interpolated colour and opacity of vertices. `None` is white; it stands in scenes without [`vertex_color`] textures.
    pub vertex: Option<&'a [F<L>; 4]>,
}

/// Steps for finite differences of a texture's [height](Textures::height).
pub struct Steps<L: Lanes> {
    /// Step of u.
    pub u: F<L>,
    /// Step of v.
    pub v: F<L>,
    /// Metres; infinite where the texture does not depend on the position.
    pub p: F<L>,
}

/// The textures of a scene; a texture's id is its index.
#[derive(Default)]
pub struct Textures {
    textures: Vec<Texture>,
    means: Vec<[f32; 3]>,
    maxima: Vec<[f32; 3]>,
    steps: Vec<[f32; 4]>,
    lookups: Vec<u32>,
    use_vertices: bool,
}

impl Textures {
    /// Adds a texture and returns its id. Textures that it refers to must have been added before.
    pub fn push(&mut self, texture: Texture) -> u32 {
        fn reads_vertices<P: Pattern>(_: &P) -> bool {
            P::READS_VERTICES
        }
        let Summary { mean, maximum, steps: [u, v, p], lookups } = in_texture!(&texture, pattern => pattern.summary(self));
        self.means.push(mean);
        self.maxima.push(maximum);
        self.steps.push([u, v, p, 0.0]);
        self.lookups.push(lookups);
        self.use_vertices |= in_texture!(&texture, pattern => reads_vertices(pattern));
        self.textures.push(texture);
        self.textures.len() as u32 - 1
    }

    fn summary_of(&self, id: u32) -> Summary {
        let [u, v, p, _] = self.steps[id as usize];
        Summary { mean: self.mean(id), maximum: self.maximum(id), steps: [u, v, p], lookups: self.lookups(id) }
    }

    /// The colour of the textures `id` in the lanes of the mask; black in the others.
    #[simd]
    pub fn colour<L: Lanes>(&self, l: L, id: U<L>, mask: M<L>, at: &TextureCoordinates<L>) -> V<L> {
        let mut found = LookupResult { id, colour: V::splat(l, [0.0; 3]) };
        // Textures stand after those that they refer to: going backwards, one pass follows any nesting.
        for k in (0..self.textures.len()).rev() {
            let here = mask & found.id.is(k as u32);
            if here.any() {
                in_texture!(&self.textures[k], pattern => pattern.apply(l, here, at, self, &mut found));
            }
        }
        found.colour
    }

    /// The luminance of the colour, as a height. Its slope is the difference over [steps](Self::steps) in u and v, where `p`
    /// moves with them.
    #[inline(always)]
    pub fn height<L: Lanes>(&self, l: L, id: U<L>, mask: M<L>, at: &TextureCoordinates<L>) -> F<L> {
        self.colour(l, id, mask, at).dot_with(LUMINANCE)
    }

    /// Steps of finite differences: 1/32 of a texel of an image, 1/32 of a cell of a checker, 1/16 of a cell of the finest octave of
    /// noise, and the minimum of nested textures. Every id must be valid.
    #[inline(always)]
    pub fn steps<L: Lanes>(&self, l: L, id: U<L>) -> Steps<L> {
        let [u, v, p, _] = l.rows(&self.steps, id);
        Steps { u, v, p }
    }

    /// The mean colour. It is exact over the unit square for images, except those turned by other angles than multiples of 90°, and for
    /// checkers of constants. For noise it is the expectation over random gradients; for a checker of textures, their means weighted
    /// by area; for products and mixtures, that of parts that do not depend on each other. It is zero only if the colour is zero
    /// everywhere.
    pub fn mean(&self, id: u32) -> [f32; 3] {
        self.means[id as usize]
    }

    /// The largest value that each channel can take.
    pub fn maximum(&self, id: u32) -> [f32; 3] {
        self.maxima[id as usize]
    }

    /// The largest number of lookups that a lookup makes of other textures: of the parts of products, mixtures and ramps, and of their
    /// parts. The squares of checkers do not count.
    pub fn lookups(&self, id: u32) -> u32 {
        self.lookups[id as usize]
    }

    /// Whether some texture needs the colours of vertices.
    pub fn use_vertices(&self) -> bool {
        self.use_vertices
    }

    /// Number of textures.
    pub fn len(&self) -> usize {
        self.textures.len()
    }

    /// Whether it is empty.
    pub fn is_empty(&self) -> bool {
        self.textures.is_empty()
    }
}

/// A named texture of a scene.
impl Declare for TextureKind {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.one_of(self);
    }
}
