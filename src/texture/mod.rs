//! Textures: colours that vary over a surface.
//!
//! | type | file | varies over | parameters |
//! |---|---|---|---|
//! | image | `image.rs` | u, v | an image, repeated |
//! | checker | `checker.rs` | u, v | two textures, cells per unit of u and v |
//! | noise | `noise.rs` | the world-space position | cells per metre, octaves, two colours |
//!
//! A new type is one file, one variant of [`Texture`] with its arms in [`Textures`], and one row here.
pub mod checker;
pub mod image;
pub mod noise;
#[cfg(test)]
mod tests;

pub use self::image::{Edge, ImageTexture};
use crate::math::{F, Lanes, M, Pick, U, V, colour::LUMINANCE};

/// One texture. Colours are linear Rec. 709.
pub enum Texture {
    Constant([f32; 3]),
    Image(ImageTexture),
    /// `even` and `odd` are ids of other textures; `scale` is the number of cells per unit of u and of v.
    Checker {
        even: u32,
        odd: u32,
        scale: f32,
    },
    /// `scale` is the number of cells of the first octave per metre.
    Noise {
        scale: f32,
        octaves: u32,
        low: [f32; 3],
        high: [f32; 3],
    },
}

/// The point of a texture lookup.
#[derive(Clone, Copy)]
pub struct TextureCoordinates<L: Lanes> {
    /// Surface coordinates, in [0, 1) on analytic shapes; meshes may exceed it.
    pub u: F<L>,
    pub v: F<L>,
    /// World-space position, metres.
    pub p: V<L>,
}

/// Steps for finite differences of a texture's [height](Textures::height).
pub struct Steps<L: Lanes> {
    pub u: F<L>,
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
}

impl Textures {
    /// Adds a texture and returns its id. Textures that it refers to must have been added before.
    pub fn push(&mut self, texture: Texture) -> u32 {
        let (mean, maximum, steps) = self.summary(&texture);
        self.means.push(mean);
        self.maxima.push(maximum);
        self.steps.push(steps);
        self.textures.push(texture);
        self.textures.len() as u32 - 1
    }

    /// Mean and maximum of the colour, and the row of `steps`.
    fn summary(&self, texture: &Texture) -> ([f32; 3], [f32; 3], [f32; 4]) {
        /// The largest step in u and v, if the texture itself needs no finer one.
        const COARSEST: f32 = 1.0 / 64.0;
        let either = |a: [f32; 3], b: [f32; 3], op: fn(f32, f32) -> f32| [op(a[0], b[0]), op(a[1], b[1]), op(a[2], b[2])];
        match texture {
            Texture::Constant(colour) => (*colour, *colour, [COARSEST, COARSEST, f32::INFINITY, 0.0]),
            Texture::Image(image) => (image.mean(), image.maximum(), [image.step_u(), image.step_v(), f32::INFINITY, 0.0]),
            Texture::Checker { even, odd, scale } => {
                let (even, odd) = (*even as usize, *odd as usize);
                let share = checker::even_share(*scale);
                let [[eu, ev, ep, _], [ou, ov, op, _]] = [self.steps[even], self.steps[odd]];
                let step = checker::step(*scale);
                let steps = [eu.min(ou).min(step), ev.min(ov).min(step), ep.min(op), 0.0];
                let mean = either(self.means[even].map(|x| x * share), self.means[odd].map(|x| x * (1.0 - share)), |a, b| a + b);
                (mean, either(self.maxima[even], self.maxima[odd], f32::max), steps)
            }
            Texture::Noise { scale, octaves, low, high } => {
                let mean = either(*low, *high, |a, b| 0.5 * (a + b));
                (mean, either(*low, *high, f32::max), [COARSEST, COARSEST, noise::step(*scale, *octaves), 0.0])
            }
        }
    }

    /// The colours of the textures `id` in the lanes of the mask; black in the others.
    #[inline(always)]
    pub fn colour<L: Lanes>(&self, l: L, id: U<L>, mask: M<L>, at: &TextureCoordinates<L>) -> V<L> {
        let mut id = id;
        let mut colour = V::splat(l, [0.0; 3]);
        // What a checker refers to stands before it: going backwards, one pass follows any nesting.
        for k in (0..self.textures.len()).rev() {
            let here = mask & id.is(k as u32);
            if !here.any() {
                continue;
            }
            match &self.textures[k] {
                Texture::Constant(constant) => colour = here.pick(V::splat(l, *constant), colour),
                Texture::Image(image) => colour = here.pick(image.colour(l, at.u, at.v, Edge::Repeat), colour),
                Texture::Checker { even, odd, scale } => {
                    id = here.pick(checker::is_even(at.u, at.v, *scale).pick(l.u(*even), l.u(*odd)), id);
                }
                Texture::Noise { scale, octaves, low, high } => {
                    let t = noise::fraction(at.p, *scale, *octaves);
                    colour = here.pick(V::splat(l, *low) * (1.0 - t) + V::splat(l, *high) * t, colour);
                }
            }
        }
        colour
    }

    /// The luminance of the colour, as a height. Its slope is the difference over [steps](Self::steps) in u and v, where `p`
    /// moves with them.
    #[inline(always)]
    pub fn height<L: Lanes>(&self, l: L, id: U<L>, mask: M<L>, at: &TextureCoordinates<L>) -> F<L> {
        self.colour(l, id, mask, at).dot_with(LUMINANCE)
    }

    /// Steps of finite differences: half a texel of an image, 1/32 of a cell of a checker, 1/16 of a cell of the finest octave of
    /// noise, and the minimum of nested textures. Every id must be valid.
    #[inline(always)]
    pub fn steps<L: Lanes>(&self, l: L, id: U<L>) -> Steps<L> {
        let [u, v, p, _] = l.rows(&self.steps, id);
        Steps { u, v, p }
    }

    /// The mean colour. It is exact over the unit square for images and checkers of constants. For noise it is the expectation
    /// over random gradients; for a checker of textures, their means weighted by area. It is zero only if the colour is zero
    /// everywhere.
    pub fn mean(&self, id: u32) -> [f32; 3] {
        self.means[id as usize]
    }

    /// The largest value that each channel can take.
    pub fn maximum(&self, id: u32) -> [f32; 3] {
        self.maxima[id as usize]
    }

    pub fn len(&self) -> usize {
        self.textures.len()
    }

    pub fn is_empty(&self) -> bool {
        self.textures.is_empty()
    }
}
