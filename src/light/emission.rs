//! Emission of surfaces: L_e(x, ω_o), the first term of the light transport equation.
use crate::math::{F, Lanes, M, U, V};

/// The side of a surface that emits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The one the normal points to.
    Front,
    Back,
    Both,
}

/// Constant emission of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// W·sr⁻¹·m⁻², linear Rec. 709.
    pub radiance: [f32; 3],
    pub side: Side,
}

/// The emission of all primitives. Emitting primitives come first, so that one comparison tells them from the others.
#[derive(Default)]
pub struct Emitters {
    /// Radiance, and the sign of the emitting side (0: both).
    rows: Vec<[f32; 4]>,
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
        Emitters { rows: emissions.iter().map(row).collect() }
    }

    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The lanes whose primitive emits from one side at least.
    #[inline(always)]
    pub fn emits<L: Lanes>(&self, primitive: U<L>) -> M<L> {
        primitive.below(self.rows.len() as u32)
    }

    /// Emitted radiance in the lanes of `emits`, and those of them that see an emitting side; `cos` is the cosine between the
    /// front normal and the direction to the viewer.
    #[inline(always)]
    pub fn radiance<L: Lanes>(&self, l: L, emits: M<L>, primitive: U<L>, cos: F<L>) -> (V<L>, M<L>) {
        use crate::math::Pick;
        let [x, y, z, side] = l.rows(&self.rows, emits.pick(primitive, l.u(0)));
        (V { x, y, z }, emits & (side * cos).ge(l.f(0.0)))
    }
}
