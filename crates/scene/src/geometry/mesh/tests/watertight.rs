//! No ray leaves a closed mesh.
use glam::{Vec3, vec3};
use rand::{Rng, SeedableRng, rngs::SmallRng};
use rayon::prelude::*;

use super::{
    super::{Mesh, NONE, generate},
    bumpy_ball, closest, point, unit,
};

/// Number of rays from a point inside, at random and at vertices and edges, that leave a closed mesh without a hit.
fn leaks(mesh: &Mesh, inside: Vec3, count: usize, seed: u64) -> usize {
    let mut rng = SmallRng::seed_from_u64(seed);
    let mut rays = Vec::with_capacity(count);
    for k in 0..count {
        let o = inside + point(&mut rng, 0.01);
        let [a, b, _] = mesh.corners(rng.random_range(0..mesh.len() as u32)).map(Vec3::from);
        let d = match k % 4 {
            0 => unit(&mut rng),
            1 => a - o,
            2 => (a + b) * 0.5 - o,
            _ => a.lerp(b, rng.random()) - o,
        };
        rays.push((o.to_array(), d.to_array()));
    }
    closest(mesh, &rays).iter().filter(|hit| hit.1 == NONE).count()
}

#[test]
fn ten_million_rays_stay_in_closed_meshes() {
    let meshes = [(generate::torus_knot(70_000), vec3(0.77, 0.0, 0.0)), (bumpy_ball(400, 200), Vec3::ZERO)]
        .map(|(data, inside)| (Mesh::new(&data), inside));
    // In parts, so that the processors share them.
    let leaks: usize = (0..20)
        .into_par_iter()
        .map(|part| {
            let (mesh, inside) = &meshes[part % 2];
            leaks(mesh, *inside, 500_000, part as u64)
        })
        .sum();
    assert_eq!(leaks, 0);
}
