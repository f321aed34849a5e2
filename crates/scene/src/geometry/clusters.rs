//! Clusters of nearby spheres in a list, which are skipped together if no lane's ray comes near. With a tree instead, images of
//! fields of 64 spheres take 1.8 times as long, of 128 1.5 times, of 256 as long, and of 512 0.9 times.
use glam::DVec3;

use super::{
    Shape, Sphere,
    bounding_sphere::BoundingSphere,
    bvh::{Bvh, NONE},
    object::{Object, ObjectKind},
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
        ObjectKind::Analytic { first, shape: Shape::Sphere { center, radius, .. } } => Some((first, *center, *radius)),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Motion;

    #[test]
    fn from_the_fewest_spheres_on_there_are_clusters_and_the_first_sphere_counts() {
        // Groups of as many as a cluster holds, far apart.
        let sphere = |i: usize| {
            let center = DVec3::new((i / SIZE * 100) as f64, (i % SIZE / 4) as f64, (i % 4) as f64);
            Shape::sphere(center, 0.4)
        };
        let spheres: Vec<Shape> = (0..MANY).map(sphere).collect();
        let sizes = |count: usize| {
            let object = |(first, shape)| Object {
                bounds: Shape::bounds(shape, &Motion::default()),
                kind: ObjectKind::Analytic { first, shape },
            };
            let mut objects: Vec<Object> = (0..).zip(&spheres[..count]).map(object).collect();
            let clusters = take_clusters(&mut objects, DVec3::ZERO);
            (objects.len(), clusters.iter().map(|cluster| cluster.members.len()).sum::<usize>())
        };
        assert_eq!([sizes(MANY - 1), sizes(MANY)], [(MANY - 1, 0), (0, MANY)]);
    }
}
