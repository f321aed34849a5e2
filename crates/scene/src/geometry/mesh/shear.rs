//! One ray against several triangles: first all at once, then the possible hits one by one and exactly.
//!
//! The test of S. Woop, C. Benthin and I. Wald, "Watertight Ray/Triangle Intersection", JCGT 2013: the vertices are translated so
//! that the ray starts at the origin, and sheared so that it runs along the axis z of d's largest component. The remaining
//! question is whether the origin lies in a triangle of the plane: u = c × b, v = a × c and w = b × a have one sign. A vertex is
//! rounded in the same way in all its triangles, and an edge function is the exact negative of the neighbour's, so a ray that
//! hits an edge or vertex of a closed mesh hits at least one of the triangles there.
//!
//! In f32 a product's rounding is monotonic: u computed is never on the wrong side of 0, but may be 0. So the first stage, which
//! accepts 0 on either side, loses nothing. The second stage handles the one or two remaining triangles per ray. It computes
//! products of two f32 exactly and so has the signs of u, v and w: it hits exactly the sheared triangle. Its distance is the mean
//! of the vertices' distances, weighted by u, v and w.
//!
//! So the test is exact except for the rounding of vertices. Let a and b be the distances of a vertex from the ray's origin along
//! x and z, s the slope of the ray, and u = ε/2. The error of its position fl(fl(a) − fl(fl(s) fl(b))) is u |a| + 3 u |s b| + u
//! (|a| + |b|), which is at most u (2 |a| + 4 |b|), because |s| ≤ 1; the error along z is u |b|.
use fearless_simd::{Simd, SimdBase, SimdMask, f32x8};

use noisefall_base::math::{Lanes, M, MAX_LANES, Pick, V};

/// Number of triangles that are tested at once, and that a leaf has at most.
pub(super) const SIZE: usize = 8;

/// The rays o + td of several lanes, prepared for the test of triangles.
pub(super) struct Shears {
    /// The axis of the largest component of d.
    z: [u32; MAX_LANES],
    /// The origin, along the axes that follow z, and z last.
    origin: [[f32; MAX_LANES]; 3],
    /// Distance along the first two axes per unit along z.
    slope: [[f32; MAX_LANES]; 2],
    /// The component of d along z.
    depth: [f32; MAX_LANES],
}

/// One ray, prepared for the test of triangles.
pub(super) struct Shear {
    pub axes: [usize; 3],
    origin: [f32; 3],
    slope: [f32; 2],
    depth: f32,
}

/// The components in a cyclic order that ends with x, with y or with z.
#[inline(always)]
fn turned<L: Lanes>(v: V<L>, x_last: M<L>, y_last: M<L>) -> V<L> {
    V {
        x: x_last.pick(v.y, y_last.pick(v.z, v.x)),
        y: x_last.pick(v.z, y_last.pick(v.x, v.y)),
        z: x_last.pick(v.x, y_last.pick(v.y, v.z)),
    }
}

/// The axes by the one that comes last. A constant would be written to the stack for every leaf.
static AXES: [[usize; 3]; 3] = [[1, 2, 0], [2, 0, 1], [0, 1, 2]];

impl Shears {
    #[inline(always)]
    pub fn new<L: Lanes>(l: L, o: V<L>, d: V<L>) -> Shears {
        let (x, y, z) = (d.x.abs(), d.y.abs(), d.z.abs());
        let is_x = y.lt(x) & z.lt(x);
        let is_y = !is_x & z.lt(y);
        let (o, d) = (turned(o, is_x, is_y), turned(d, is_x, is_y));
        let mut shears = Shears {
            z: is_x.pick(l.u(0), is_y.pick(l.u(1), l.u(2))).to_array(),
            origin: [[0.0; MAX_LANES]; 3],
            slope: [[0.0; MAX_LANES]; 2],
            depth: d.z.to_array(),
        };
        o.x.store(&mut shears.origin[0]);
        o.y.store(&mut shears.origin[1]);
        o.z.store(&mut shears.origin[2]);
        (d.x / d.z).store(&mut shears.slope[0]);
        (d.y / d.z).store(&mut shears.slope[1]);
        shears
    }

    #[inline(always)]
    pub fn lane(&self, lane: usize) -> Shear {
        Shear {
            axes: AXES[self.z[lane] as usize],
            origin: [self.origin[0][lane], self.origin[1][lane], self.origin[2][lane]],
            slope: [self.slope[0][lane], self.slope[1][lane]],
            depth: self.depth[lane],
        }
    }
}

impl Shear {
    /// A vertex of each triangle, by axis, sheared.
    #[inline(always)]
    pub fn apply<S: Simd>(&self, [x, y, z]: [f32x8<S>; 3]) -> [f32x8<S>; 3] {
        let (x, y, z) = (x - self.origin[0], y - self.origin[1], z - self.origin[2]);
        [x - z * self.slope[0], y - z * self.slope[1], z]
    }
}

/// The vertices of the triangles of a leaf, sheared for a ray; by corner, then axis.
pub(super) struct Sheared<S: Simd> {
    pub corners: [[f32x8<S>; 3]; 3],
}

impl<S: Simd> Sheared<S> {
    /// The triangles that the line of the ray may hit, as bits; they include all that it hits.
    #[inline(always)]
    pub fn candidates(&self, s: S) -> u32 {
        let [[ax, ay, _], [bx, by, _], [cx, cy, _]] = self.corners;
        let u = cx * by - cy * bx;
        let v = ax * cy - ay * cx;
        let w = bx * ay - by * ax;
        let zero = f32x8::splat(s, 0.0);
        let inside = u.min(v).min(w).simd_ge(zero) | u.max(v).max(w).simd_le(zero);
        inside.to_bitmask() as u32
    }

    /// Distance to the triangle in slot `place`, in units of d; NaN if the line of the ray misses it.
    #[inline(always)]
    pub fn distance(&self, place: usize, ray: &Shear) -> f32 {
        let [ax, ay, az] = self.vertex(0, place);
        let [bx, by, bz] = self.vertex(1, place);
        let [cx, cy, cz] = self.vertex(2, place);
        let u = cx * by - cy * bx;
        let v = ax * cy - ay * cx;
        let w = bx * ay - by * ax;
        let inside = ((u >= 0.0) & (v >= 0.0) & (w >= 0.0)) | ((u <= 0.0) & (v <= 0.0) & (w <= 0.0));
        let distance = (u * az + v * bz + w * cz) / ((u + v + w) * f64::from(ray.depth));
        if inside { distance as f32 } else { f32::NAN }
    }

    #[inline(always)]
    fn vertex(&self, corner: usize, place: usize) -> [f64; 3] {
        let [x, y, z] = &self.corners[corner];
        let place = place % SIZE;
        [f64::from(x[place]), f64::from(y[place]), f64::from(z[place])]
    }
}
