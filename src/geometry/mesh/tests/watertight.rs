//! Closed meshes let nothing out.
use glam::{Vec3, vec3};
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{
    super::{Mesh, MeshData, NONE, generate},
    bumpy_ball, closest, point, unit,
};

/// Rays from a point inside, at random and at vertices and edges, that leave a closed mesh unseen.
fn leaks(data: &MeshData, inside: Vec3, count: usize, seed: u64) -> usize {
    let mesh = Mesh::new(data);
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
    closest(&mesh, &rays).iter().filter(|hit| hit.1 == NONE).count()
}

#[test]
fn closed_meshes_are_watertight() {
    let knot = generate::torus_knot(20_000);
    let on_the_knot = vec3(0.77, 0.0, 0.0);
    assert_eq!(leaks(&knot, on_the_knot, 500_000, 5), 0);
    assert_eq!(leaks(&bumpy_ball(200, 100), Vec3::ZERO, 500_000, 6), 0);
}

#[test]
#[ignore = "ten million rays: by hand"]
fn closed_meshes_are_watertight_at_length() {
    assert_eq!(leaks(&generate::torus_knot(70_000), vec3(0.77, 0.0, 0.0), 5_000_000, 7), 0);
    assert_eq!(leaks(&bumpy_ball(400, 200), Vec3::ZERO, 5_000_000, 8), 0);
}
