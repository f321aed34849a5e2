//! Emission of surfaces: L_e(x, ω_o), the first term of the light transport equation.
//!
//! Each kind of emission is one file and one line of the catalogue below.
pub mod radiance;
pub mod texture;

use crate::texture::{TextureCompiler, TextureCoordinates, Textures};
use noisefall_base::{
    declare::Problem,
    math::{F, Lanes, M, Pick, U, V},
};

noisefall_base::declare::catalogue! {
    /// The emission of an object as a scene describes it.
    pub enum EmissionSource: Emit, "emission" {
        radiance::Radiance,
        texture::Texture,
    }
}

/// A kind of emission.
pub trait Emit {
    /// The emission, with its radiance times `scale`.
    fn compile(&self, scale: f32, side: Side, textures: &TextureCompiler) -> Result<Emission, Problem>;
}

/// The side of a surface that emits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The side of the normal.
    Front,
    /// The back.
    Back,
    /// Both sides.
    Both,
}

/// Emission of a surface, W·sr⁻¹·m⁻², linear Rec. 709.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// Radiance; with a texture, its factor.
    pub radiance: [f32; 3],
    /// Mean radiance; with a texture, over its unit square.
    pub mean: [f32; 3],
    /// Id of its texture, if it has one.
    pub texture: Option<u32>,
    /// The sides that emit.
    pub side: Side,
    /// Whether its far side can be seen through the surface.
    pub translucent: bool,
}

impl Emission {
    /// Whether both are the same, bit for bit.
    pub fn is_same(&self, other: &Emission) -> bool {
        let bits = |emission: &Emission| [emission.radiance, emission.mean].map(|rgb| rgb.map(f32::to_bits));
        bits(self) == bits(other) && (self.texture, self.side, self.translucent) == (other.texture, other.side, other.translucent)
    }
}

/// The emission of all primitives. Emitting primitives come first, so a single comparison identifies them.
#[derive(Default)]
pub struct Emitters {
    /// Radiance, and the sign of the emitting side (0: both).
    rows: Vec<[f32; 4]>,
    /// Id of the texture plus 1 as bits, 0 for none; empty when no emission varies.
    textures: Vec<[f32; 4]>,
    translucent: bool,
}

impl Emitters {
    /// Emission of the primitives 0, 1, 2, … ; later ones do not emit.
    pub fn new(emissions: &[Emission]) -> Emitters {
        let row = |emission: &Emission| {
            let [r, g, b] = emission.radiance;
            let sign = match emission.side {
                Side::Front => 1.0,
                Side::Back => -1.0,
                Side::Both => 0.0,
            };
            [r, g, b, sign]
        };
        let texture = |emission: &Emission| [f32::from_bits(emission.texture.map_or(0, |id| id + 1)), 0.0, 0.0, 0.0];
        let vary = emissions.iter().any(|emission| emission.texture.is_some());
        Emitters {
            rows: emissions.iter().map(row).collect(),
            textures: if vary { emissions.iter().map(texture).collect() } else { Vec::new() },
            translucent: emissions.iter().any(|emission| emission.translucent),
        }
    }

    /// Whether nothing emits.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Number of primitives that emit: the first ones.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// The lanes whose primitive emits from at least one side.
    #[inline(always)]
    pub fn emits<L: Lanes>(&self, primitive: U<L>) -> M<L> {
        primitive.below(self.rows.len() as u32)
    }

    /// The emitted radiance in the lanes of `emits`, and the mask of those that see an emitting side. `cos` is the cosine between
    /// the front normal and the direction to the viewer.
    #[inline(always)]
    pub fn radiance<L: Lanes>(&self, l: L, emits: M<L>, primitive: U<L>, cos: F<L>) -> (V<L>, M<L>) {
        let [x, y, z, side] = l.rows(&self.rows, emits.pick(primitive, l.u(0)));
        (V { x, y, z }, emits & (side * cos).ge(l.f(0.0)))
    }

    /// The sign of the emitting side: 1 for the front, −1 for the back, 0 for both.
    #[inline(always)]
    pub fn side<L: Lanes>(&self, l: L, primitive: U<L>) -> F<L> {
        let [.., side] = l.rows(&self.rows, primitive);
        side
    }

    /// Whether the far side of some emitter can be seen through it: see [`Emission::translucent`].
    pub fn are_translucent(&self) -> bool {
        self.translucent
    }

    /// Whether any emission is textured.
    pub fn vary(&self) -> bool {
        !self.textures.is_empty()
    }

    /// The factor by which the texture multiplies radiance in the lanes of `emits`; 1 without a texture. To be called only if
    /// some [vary](Emitters::vary).
    #[inline(always)]
    pub fn variation<L: Lanes>(
        &self,
        l: L,
        textures: &Textures,
        emits: M<L>,
        primitive: U<L>,
        at: &TextureCoordinates<L>,
    ) -> V<L> {
        let [id, ..] = l.rows(&self.textures, emits.pick(primitive, l.u(0)));
        let textured = emits & !id.bits().is(0);
        textured.pick(textures.colour(l, id.bits() + u32::MAX, textured, at), V::splat(l, [1.0; 3]))
    }
}
