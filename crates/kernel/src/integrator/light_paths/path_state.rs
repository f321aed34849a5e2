//! The state of paths from one end, by slot.
use super::partial::Partial;
use crate::integrator::{queue::Register, queues::HitQueues, records::Hit, shared::put, slots::SLOTS};
use noisefall_base::math::{Lanes, M, Pick, U, V};

/// Light passes at the vertex before, and lights were sampled on both of its sides.
const TRANSMITS: f32 = 1.0;
/// Light passes there, and only punctual lights were sampled.
const SELF_LIT: f32 = 2.0;

/// Paths from one end, by slot.
pub struct PathState {
    /// [`Partial`], and the time.
    partials: Vec<[f32; 4]>,
    /// Unit direction to the vertex before.
    back: Vec<[f32; 4]>,
    /// Primitive and triangle.
    places: Vec<[f32; 4]>,
    /// The normal of the vertex before, and [`TRANSMITS`] or [`SELF_LIT`].
    before: Vec<[f32; 4]>,
}

impl Default for PathState {
    fn default() -> Self {
        let rows = || vec![[0.0; 4]; SLOTS];
        PathState { partials: rows(), back: rows(), places: rows(), before: rows() }
    }
}

/// Vertices of paths in a register of hits.
pub struct PathVertex<L: Lanes> {
    pub live: M<L>,
    pub hit: Hit<L>,
    /// Unit direction to the vertex before.
    pub back: V<L>,
    pub partial: Partial<L>,
}

impl PathState {
    /// The vertices in a register of hits.
    #[inline(always)]
    pub fn read<L: Lanes>(&self, l: L, hits: &HitQueues, at: Register<L>) -> PathVertex<L> {
        let hit = Hit::read(l, &hits.hits, at.start);
        let slot = inside(hit.slot);
        let [x, y, z, _] = l.rows(&self.back, slot);
        PathVertex { live: at.live, hit: Hit { slot, ..hit }, back: V { x, y, z }, partial: self.partial(l, slot) }
    }

    #[inline(always)]
    pub fn partial<L: Lanes>(&self, l: L, slot: U<L>) -> Partial<L> {
        let [v, c, ..] = l.rows(&self.partials, inside(slot));
        Partial { v, c }
    }

    #[inline(always)]
    pub fn put_partial<L: Lanes>(&mut self, lanes: M<L>, slot: U<L>, Partial { v, c }: Partial<L>) {
        let zero = v.splat(0.0);
        put(lanes, slot, V { x: v, y: c, z: zero }, zero, &mut self.partials);
    }

    /// Stores where paths have come to.
    #[inline(always)]
    pub fn put_place<L: Lanes>(&mut self, lanes: M<L>, slot: U<L>, back: V<L>, primitive: U<L>, element: U<L>) {
        let zero = back.x.splat(0.0);
        put(lanes, slot, back, zero, &mut self.back);
        put(lanes, slot, V { x: primitive.as_real_bits(), y: element.as_real_bits(), z: zero }, zero, &mut self.places);
    }

    /// Primitives and triangles.
    #[inline(always)]
    pub fn place<L: Lanes>(&self, l: L, slot: U<L>) -> (U<L>, U<L>) {
        let [primitive, element, ..] = l.rows(&self.places, inside(slot));
        (primitive.bits(), element.bits())
    }

    /// Stores the surfaces that paths leave.
    #[inline(always)]
    pub fn put_before<L: Lanes>(&mut self, lanes: M<L>, slot: U<L>, n: V<L>, transmits: M<L>, self_lit: M<L>) {
        let zero = n.x.splat(0.0);
        let sides = self_lit.pick(n.x.splat(SELF_LIT), transmits.pick(n.x.splat(TRANSMITS), zero));
        put(lanes, slot, n, sides, &mut self.before);
    }

    /// The normals of the vertices before, the lanes where light passes there, and those that sample only punctual lights.
    #[inline(always)]
    pub fn before<L: Lanes>(&self, l: L, slot: U<L>) -> (V<L>, M<L>, M<L>) {
        let [x, y, z, sides] = l.rows(&self.before, inside(slot));
        (V { x, y, z }, sides.above(0.0), sides.above(TRANSMITS))
    }
}

/// Slots of lanes past the end are stale.
#[inline(always)]
pub fn inside<L: Lanes>(slot: U<L>) -> U<L> {
    slot & (SLOTS as u32 - 1)
}
