//! The edges of a triangle.
use noisefall_base::math::{F, Lanes, V};

/// Two edges from one vertex.
pub(super) struct Edges<L: Lanes> {
    pub b: V<L>,
    pub c: V<L>,
    /// The largest component of the three edges.
    pub size: F<L>,
}

impl<L: Lanes> Edges<L> {
    #[inline(always)]
    pub fn of(a: V<L>, b: V<L>, c: V<L>) -> Self {
        let (b, c) = (b - a, c - a);
        Edges { b, c, size: b.max_abs().max(c.max_abs()).max((c - b).max_abs()) }
    }

    /// Edges of a triangle of size 1, whose products neither vanish nor overflow, and their cross product.
    #[inline(always)]
    pub fn scaled(&self) -> (V<L>, V<L>, V<L>) {
        let scale = 1.0 / self.size;
        let (b, c) = (self.b * scale, self.c * scale);
        (b, c, b.cross(c))
    }
}

/// Twice the area of a triangle scaled to size 1, squared; 0, infinite or NaN if it has no normal in f32.
pub(super) fn scaled_area_squared<L: Lanes>(a: V<L>, b: V<L>, c: V<L>) -> F<L> {
    Edges::of(a, b, c).scaled().2.length_squared()
}
