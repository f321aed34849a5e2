//! Clusters of nearby spheres in a list, which are skipped together if no lane's ray comes near. With a tree instead, images of
//! fields of 64 spheres take 1.8 times as long, of 128 1.5 times, of 256 as long, and of 512 0.9 times.
use glam::DVec3;

use super::{
    Shape, Sphere,
    bounding_sphere::BoundingSphere,
    bvh::{Bvh, NONE},
    object::{Kind, Object},
};

/// Maximum number of spheres of a cluster (4 is slower).
const SIZE: usize = 8;
/// Minimum number of spheres of a cluster.
const FEWEST: usize = 3;
/// Minimum number of spheres of a scene for clusters.
const MANY: usize = 16;

/// Spheres, each with its primitive, in the order of primitives.
pub(super) struct Cluster {
    pub bounding_sphere: BoundingSphere,
    pub members: Vec<(u32, Sphere)>,
}

/// Removes the spheres that form clusters from the objects. `near` is a point in the middle of the scene.
pub(super) fn take_clusters(objects: &mut Vec<Object>, near: DVec3) -> Vec<Cluster> {
    let spheres: Vec<usize> = (0..objects.len()).filter(|&object| sphere(&objects[object]).is_some()).collect();
    if spheres.len() < MANY {
        return Vec::new();
    }
    let (_, order) = Bvh::build::<SIZE>(spheres.iter().map(|&object| objects[object].bounds));
    let mut is_taken = vec![false; objects.len()];
    let mut clusters = Vec::new();
    for leaf in order.chunks_exact(SIZE) {
        let mut members: Vec<usize> = leaf.iter().filter(|&&at| at != NONE).map(|&at| spheres[at as usize]).collect();
        members.sort_unstable();
        if members.len() >= FEWEST {
            members.iter().for_each(|&object| is_taken[object] = true);
            let balls: Vec<Ball> = members.iter().filter_map(|&object| sphere(&objects[object])).collect();
            clusters.push(Cluster::new(&balls, near));
        }
    }
    let mut is_taken = is_taken.into_iter();
    objects.retain(|_| is_taken.next() == Some(false));
    clusters
}

/// Primitive, centre and radius.
type Ball = (u32, DVec3, f64);

fn sphere(object: &Object) -> Option<Ball> {
    match object.kind {
        Kind::Analytic { first, shape: Shape::Sphere { center, radius } } => Some((first, *center, *radius)),
        _ => None,
    }
}

impl Cluster {
    fn new(balls: &[Ball], near: DVec3) -> Cluster {
        let corner = |sign: f64, fold: fn(DVec3, DVec3) -> DVec3| balls.iter().map(|(_, c, r)| *c + sign * *r).reduce(fold);
        let (min, max) = (corner(-1.0, DVec3::min).unwrap_or_default(), corner(1.0, DVec3::max).unwrap_or_default());
        let middle = (min + max) / 2.0;
        let reach = balls.iter().map(|(_, center, radius)| center.distance(middle) + radius).fold(0.0, f64::max);
        let members = balls.iter().map(|(first, center, radius)| (*first, Sphere::new(*center, *radius, near))).collect();
        Cluster { bounding_sphere: BoundingSphere::new(middle, reach), members }
    }
}
