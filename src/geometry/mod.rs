//! Shapes: where a ray first meets one, and the point and normal there.
//!
//! A shape has a number, its *primitive id*; what it is made of and whether it emits is looked up by that number elsewhere.
//!
//! | kind | file | front |
//! |---|---|---|
//! | sphere | `sphere.rs` | outside |
mod sphere;

use self::sphere::Fraction;
pub use self::sphere::{Cone, Sphere, SurfacePoint, sphere_tangents, sphere_uv};
use crate::math::{F, Lanes, Pick, U, V};

/// The primitive id of a ray that meets nothing.
pub const MISS: u32 = u32::MAX;

/// All shapes of a scene, a flat table a kind.
#[derive(Default)]
pub struct Shapes {
    spheres: Vec<Sphere>,
    anchors: Vec<[f32; 4]>,
    normals: Vec<[f32; 4]>,
}

impl Shapes {
    /// Primitive ids are the places in `spheres`.
    pub fn new(spheres: Vec<Sphere>) -> Shapes {
        let (anchors, normals) = spheres.iter().map(|sphere| sphere.rows().into()).unzip();
        Shapes { spheres, anchors, normals }
    }

    /// Distance along o + td, d of unit length, to the first shape, and its primitive id or [`MISS`].
    #[inline(always)]
    pub fn closest<L: Lanes>(&self, l: L, o: V<L>, d: V<L>) -> (F<L>, U<L>) {
        let (mut nearest, mut primitive) = (Fraction::infinite(l), l.u(MISS));
        for (id, sphere) in self.spheres.iter().enumerate() {
            let meeting = sphere.intersect(o, d);
            let nearer = meeting.less(&nearest);
            nearest = nearer.pick(meeting, nearest);
            primitive = nearer.pick(l.u(id as u32), primitive);
        }
        (nearest.value(), primitive)
    }

    /// The directions in which given primitives are seen from `x`.
    #[inline(always)]
    pub fn seen_from<L: Lanes>(&self, l: L, primitive: U<L>, x: V<L>) -> Cone<L> {
        Cone::of_sphere(l.rows(&self.anchors, primitive), l.rows(&self.normals, primitive), x)
    }

    /// The surface at a point `p` of the given primitives, none of which may be [`MISS`].
    #[inline(always)]
    pub fn surface_point<L: Lanes>(&self, l: L, primitive: U<L>, p: V<L>) -> SurfacePoint<L> {
        sphere::surface_point(l.rows(&self.anchors, primitive), l.rows(&self.normals, primitive), p)
    }
}
