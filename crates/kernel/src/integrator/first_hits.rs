//! The first surface of every path of a bounce, in the order of the paths' queue.
use super::slots::SLOTS;
use noisefall_base::math::{Lanes, MAX_LANES, U};
use noisefall_scene::geometry::Nearest;

/// The first surfaces of paths.
pub(super) struct FirstHits {
    t: Vec<f32>,
    primitive: Vec<f32>,
    /// The triangle, in scenes with meshes.
    element: Vec<f32>,
    /// The row of the surface, in scenes with blends.
    row: Vec<f32>,
}

impl Default for FirstHits {
    fn default() -> Self {
        // Registers are stored whole, so the last one may reach past the end.
        let column = || vec![0.0; SLOTS + MAX_LANES];
        FirstHits { t: column(), primitive: column(), element: column(), row: column() }
    }
}

impl FirstHits {
    /// Stores the first surfaces of the paths from index `at` on.
    #[inline(always)]
    pub fn put<L: Lanes>(&mut self, at: usize, nearest: &Nearest<L>, has_elements: bool) {
        nearest.t.store(&mut self.t[at..]);
        nearest.primitive.as_real_bits().store(&mut self.primitive[at..]);
        if has_elements {
            nearest.element.as_real_bits().store(&mut self.element[at..]);
        }
    }

    /// Stores the rows of the first surfaces: see [`noisefall_scene::scene::surface::Surfaces`].
    #[inline(always)]
    pub fn put_rows<L: Lanes>(&mut self, at: usize, rows: U<L>) {
        rows.as_real_bits().store(&mut self.row[at..]);
    }

    /// The rows of the first surfaces, in scenes with blends.
    #[inline(always)]
    pub fn rows<L: Lanes>(&self, l: L, at: usize) -> U<L> {
        l.load(&self.row[at..]).bits()
    }

    /// The first surfaces of the paths from index `at` on, with element 0 unless `has_elements`.
    #[inline(always)]
    pub fn get<L: Lanes>(&self, l: L, at: usize, has_elements: bool) -> Nearest<L> {
        Nearest {
            t: l.load(&self.t[at..]),
            primitive: l.load(&self.primitive[at..]).bits(),
            element: if has_elements { l.load(&self.element[at..]).bits() } else { l.u(0) },
        }
    }
}
