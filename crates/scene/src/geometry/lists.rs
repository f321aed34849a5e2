//! Static analytic shapes, in a list for each type, which every ray tests one by one.
use glam::DVec3;

use super::{MISS, Shape, Sphere, clusters::Cluster, cuboid::Cuboid, flat::Flat, fraction::Fraction, quadric::Quadric};
use noisefall_base::math::{F, Lanes, Pick, U, V};

/// Shapes, each with its primitive id or that of its first piece. Absent types cost nothing.
#[derive(Default)]
pub(super) struct Lists {
    spheres: Vec<(u32, Sphere)>,
    clusters: Vec<Cluster>,
    flats: Vec<(u32, Flat)>,
    cuboids: Vec<(u32, Cuboid)>,
    /// Ellipsoids and open cylinders.
    quadrics: Vec<(u32, Quadric)>,
    /// With caps.
    cylinders: Vec<(u32, Quadric)>,
}

/// A shape of [`Lists`] by its index.
#[derive(Clone, Copy)]
pub(super) enum Listed {
    Sphere(u32),
    Flat(u32),
    Cuboid(u32),
    Quadric(u32),
    Cylinder(u32),
}

impl Lists {
    /// Adds an analytic shape, whose first piece is primitive `first`. `near` is a point in the middle of the scene.
    pub fn push(&mut self, first: u32, shape: &Shape, near: DVec3) -> Listed {
        match shape {
            Shape::Sphere { center, radius, .. } => {
                Listed::Sphere(append(&mut self.spheres, first, Sphere::new(*center, *radius, near)))
            }
            Shape::Flat { outline, origin, edges, mirrored } => {
                let flat = Flat::new(*outline, *origin, *edges, *mirrored, near);
                Listed::Flat(append(&mut self.flats, first, flat))
            }
            Shape::Cuboid { origin, edges } => {
                Listed::Cuboid(append(&mut self.cuboids, first, Cuboid::new(*origin, *edges, near)))
            }
            Shape::Cylinder { capped: true, .. } => {
                Listed::Cylinder(append(&mut self.cylinders, first, Quadric::new(shape, true, near)))
            }
            Shape::Ellipsoid { .. } | Shape::Cylinder { .. } => {
                Listed::Quadric(append(&mut self.quadrics, first, Quadric::new(shape, false, near)))
            }
            Shape::Mesh { .. } | Shape::Isosurface { .. } => unreachable!("not an analytic shape"),
        }
    }

    /// Sets the clusters of spheres, in addition to single ones.
    pub fn set_clusters(&mut self, clusters: Vec<Cluster>) {
        self.clusters = clusters;
    }

    /// Whether all shapes are spheres.
    pub fn are_spheres(&self) -> bool {
        self.flats.is_empty() && self.cuboids.is_empty() && self.quadrics.is_empty() && self.cylinders.is_empty()
    }

    /// [`Lists::closest`] for lists with only spheres.
    #[inline(always)]
    pub fn closest_sphere<L: Lanes>(&self, l: L, o: V<L>, d: V<L>) -> (F<L>, U<L>) {
        let nearest = self.nearest_sphere(l, o, d);
        (nearest.t.value(), nearest.primitive)
    }

    /// The nearest intersection with a sphere.
    #[inline(always)]
    fn nearest_sphere<L: Lanes>(&self, l: L, o: V<L>, d: V<L>) -> NearestListed<L> {
        let mut nearest = NearestListed::none(l);
        for (id, sphere) in &self.spheres {
            if let Some(t) = sphere.intersect(o, d) {
                nearest.meet(t, l.u(*id));
            }
        }
        for Cluster { bounding_sphere, members } in &self.clusters {
            let near = bounding_sphere.near(o, d);
            if !near.any() {
                continue;
            }
            for (id, sphere) in members {
                if let Some(t) = sphere.intersect(o, d) {
                    // The surface that a lane meets must not depend on the other lanes, which have led here.
                    nearest.meet_in_any_order(l, t.only(near), *id);
                }
            }
        }
        nearest
    }

    /// Distance along o + td, d of unit length, to the first surface, and its primitive or [`MISS`].
    #[inline(always)]
    pub fn closest<L: Lanes>(&self, l: L, o: V<L>, d: V<L>) -> (F<L>, U<L>) {
        let mut nearest = self.nearest_sphere(l, o, d);
        for (id, flat) in &self.flats {
            nearest.meet(flat.intersect(o, d), l.u(*id));
        }
        for (first, cuboid) in &self.cuboids {
            let (t, face) = cuboid.intersect(l, o, d);
            nearest.meet(t, face + *first);
        }
        for (id, quadric) in &self.quadrics {
            nearest.meet(quadric.intersect(l, o, d), l.u(*id));
        }
        for (first, cylinder) in &self.cylinders {
            let (t, piece) = cylinder.intersect_solid(l, o, d);
            nearest.meet(t, piece + *first);
        }
        (nearest.t.value(), nearest.primitive)
    }

    /// Distance to one shape, NaN for a miss, and the primitive.
    #[inline(always)]
    pub fn meet<L: Lanes>(&self, l: L, which: Listed, o: V<L>, d: V<L>) -> (F<L>, U<L>) {
        let (t, primitive) = match which {
            Listed::Sphere(place) => {
                let (id, sphere) = &self.spheres[place as usize];
                (sphere.intersect(o, d).unwrap_or(Fraction::none(l)), l.u(*id))
            }
            Listed::Flat(place) => {
                let (id, flat) = &self.flats[place as usize];
                (flat.intersect(o, d), l.u(*id))
            }
            Listed::Cuboid(place) => {
                let (first, cuboid) = &self.cuboids[place as usize];
                let (t, face) = cuboid.intersect(l, o, d);
                (t, face + *first)
            }
            Listed::Quadric(place) => {
                let (id, quadric) = &self.quadrics[place as usize];
                (quadric.intersect(l, o, d), l.u(*id))
            }
            Listed::Cylinder(place) => {
                let (first, cylinder) = &self.cylinders[place as usize];
                let (t, piece) = cylinder.intersect_solid(l, o, d);
                (t, piece + *first)
            }
        };
        (t.value(), primitive)
    }
}

fn append<T>(list: &mut Vec<(u32, T)>, first: u32, shape: T) -> u32 {
    list.push((first, shape));
    list.len() as u32 - 1
}

/// The nearest intersection so far.
struct NearestListed<L: Lanes> {
    t: Fraction<L>,
    primitive: U<L>,
}

impl<L: Lanes> NearestListed<L> {
    #[inline(always)]
    fn none(l: L) -> Self {
        NearestListed { t: Fraction::infinite(l), primitive: l.u(MISS) }
    }

    #[inline(always)]
    fn meet(&mut self, t: Fraction<L>, primitive: U<L>) {
        let nearer = t.less(&self.t);
        self.t = nearer.pick(t, self.t);
        self.primitive = nearer.pick(primitive, self.primitive);
    }
    /// Adds primitives in any order: of coincident surfaces, the one with the lowest id counts.
    #[inline(always)]
    fn meet_in_any_order(&mut self, l: L, t: Fraction<L>, primitive: u32) {
        let is_first = t.equals(&self.t) & !self.primitive.below(primitive.saturating_add(1));
        let nearer = t.less(&self.t) | is_first;
        self.t = nearer.pick(t, self.t);
        self.primitive = nearer.pick(l.u(primitive), self.primitive);
    }
}
