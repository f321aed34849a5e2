//! The surfaces of paths that pixels share, until the stage `reuse`.
use super::{records::Hit, slots::SLOTS};
use noisefall_base::math::{F, Lanes, M, MAX_LANES, Pick, U, V};
use noisefall_scene::geometry::PrimitiveRef;

/// The surface points that are shared, by slot.
pub(super) struct Shared {
    /// The first surfaces: origins of rays, with 1 in lanes that share; normals; albedos.
    pub(super) points: Vec<[f32; 4]>,
    pub(super) normals: Vec<[f32; 4]>,
    pub(super) albedos: Vec<[f32; 4]>,
    /// The second surfaces: positions and primitives; normals, zero if there is none, and triangles.
    pub(super) found: Vec<[f32; 4]>,
    pub(super) found_normals: Vec<[f32; 4]>,
    /// The resulting radiance, row by row of the tile.
    pub(super) radiance: Vec<[f32; 4]>,
}

impl Default for Shared {
    fn default() -> Self {
        let rows = || vec![[0.0; 4]; SLOTS];
        Shared {
            points: rows(),
            normals: rows(),
            albedos: rows(),
            found: rows(),
            found_normals: rows(),
            radiance: vec![[0.0; 4]; 2 * SLOTS],
        }
    }
}

impl Shared {
    pub fn clear(&mut self) {
        self.points.fill([0.0; 4]);
        self.found_normals.fill([0.0; 4]);
    }

    /// Multiplies by the albedo of the first surface, if that is shared.
    pub fn weighted(&self, slot: usize, colour: [f32; 3]) -> [f32; 3] {
        if self.points[slot][3] <= 0.0 {
            return colour;
        }
        let ([r, g, b], albedo) = (colour, self.albedos[slot]);
        [r * albedo[0], g * albedo[1], b * albedo[2]]
    }

    /// Stores the first surface of paths.
    #[inline(always)]
    pub fn keep_first<L: Lanes>(&mut self, l: L, lanes: M<L>, hit: &Hit<L>) {
        put(lanes, hit.slot, hit.p, l.f(1.0), &mut self.points);
        put(lanes, hit.slot, hit.n, l.f(0.0), &mut self.normals);
        put(lanes, hit.slot, hit.colour, l.f(0.0), &mut self.albedos);
    }

    /// The lanes that share their first surface, and its albedo.
    #[inline(always)]
    pub fn first<L: Lanes>(&self, l: L, slot: U<L>) -> (M<L>, V<L>) {
        // Lanes past the end hold stale values.
        let slot = slot & (SLOTS as u32 - 1);
        let [r, g, b, _] = l.rows(&self.albedos, slot);
        (l.rows(&self.points, slot)[3].above(0.0), V { x: r, y: g, z: b })
    }

    /// Stores the second surface of paths, and redirects the radiance from there on to separate slots.
    #[inline(always)]
    pub fn keep_second<L: Lanes>(&mut self, lanes: M<L>, place: &PrimitiveRef<L>, hit: &mut Hit<L>) {
        put(lanes, hit.slot, hit.p, place.primitive.as_real_bits(), &mut self.found);
        put(lanes, hit.slot, hit.n, place.element.as_real_bits(), &mut self.found_normals);
        hit.slot = lanes.pick(hit.slot + SLOTS as u32, hit.slot);
    }
}

/// Writes rows by slot.
#[inline(always)]
pub(super) fn put<L: Lanes>(lanes: M<L>, slot: U<L>, V { x, y, z }: V<L>, w: F<L>, rows: &mut [[f32; 4]]) {
    let slot = slot.to_array();
    let (x, y, z, w) = (x.to_array(), y.to_array(), z.to_array(), w.to_array());
    let mut rest = lanes.bits();
    while rest != 0 {
        let lane = rest.trailing_zeros() as usize % MAX_LANES;
        rest &= rest - 1;
        rows[slot[lane] as usize] = [x[lane], y[lane], z[lane], w[lane]];
    }
}
