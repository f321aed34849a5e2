//! Bounding spheres, tested in all lanes.
use glam::DVec3;

use noisefall_base::math::{Lanes, M, V};

/// A bounding sphere.
pub(super) struct BoundingSphere {
    center: [f32; 3],
    radius_squared: f32,
}

impl BoundingSphere {
    pub fn new(center: DVec3, radius: f64) -> BoundingSphere {
        // Much more than all roundings on the way.
        const SLACK: f64 = 1.0001;
        BoundingSphere { center: center.as_vec3().to_array(), radius_squared: (radius * radius * SLACK) as f32 }
    }

    /// The lanes whose ray o + td, d of unit length, may hit the contents of the sphere.
    #[inline(always)]
    pub fn near<L: Lanes>(&self, o: V<L>, d: V<L>) -> M<L> {
        // Of the distance of the centre: how far it may be off, squared, and more.
        const ROUNDING: f32 = 1e-11;
        let way = o - self.center;
        let distance_squared = way.length_squared();
        let along = way.dot(d);
        let nearest = (way - d * along).length_squared();
        let reach = distance_squared * ROUNDING + self.radius_squared;
        nearest.lt(reach) & (along.below(0.0) | distance_squared.lt(reach))
    }
}
