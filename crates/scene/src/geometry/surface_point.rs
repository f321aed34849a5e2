//! The surface point at a hit.
use noisefall_base::math::{F, Lanes, M, Pick, U, V};

/// A point of a surface in lanes.
#[derive(Clone, Copy)]
pub struct SurfacePoint<L: Lanes> {
    /// The point.
    pub p: V<L>,
    /// Unit geometric normal on the front side.
    pub n_geometric: V<L>,
    /// Offset along the normal that puts the origin of a ray from `p` strictly on that side of the surface.
    pub error: F<L>,
}

impl<L: Lanes> Pick<SurfacePoint<L>> for M<L> {
    #[inline(always)]
    fn pick(self, a: SurfacePoint<L>, b: SurfacePoint<L>) -> SurfacePoint<L> {
        SurfacePoint {
            p: self.pick(a.p, b.p),
            n_geometric: self.pick(a.n_geometric, b.n_geometric),
            error: self.pick(a.error, b.error),
        }
    }
}

/// Surface coordinates.
pub struct Coordinates<L: Lanes> {
    /// To the right and downwards, as images are stored; [0, 1] on shapes other than meshes.
    pub u: F<L>,
    /// The second surface coordinate.
    pub v: F<L>,
}

/// A reference to a primitive, its triangle and a time.
#[derive(Clone, Copy)]
pub struct PrimitiveRef<L: Lanes> {
    /// Primitive id.
    pub primitive: U<L>,
    /// The triangle of a mesh.
    pub element: U<L>,
    /// Time of motion, from 0 to 1.
    pub time: F<L>,
}

impl<L: Lanes> PrimitiveRef<L> {
    /// A reference to primitives that neither have elements nor move.
    #[inline(always)]
    pub fn of(l: L, primitive: U<L>) -> Self {
        PrimitiveRef { primitive, element: l.u(0), time: l.f(0.0) }
    }
}
