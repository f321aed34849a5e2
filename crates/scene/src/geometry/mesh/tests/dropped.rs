//! Degenerate triangles, and copies.
use std::sync::Arc;

use glam::{DAffine3, DVec3};
use rand::{SeedableRng, rngs::SmallRng};

use super::{Mesh, MeshData, TriangleLeaves, assert_no_hit_is_lost, first, generate, rays};
use noisefall_base::progress::Progress;

#[test]
fn degenerate_triangles_are_dropped_and_counted() {
    let mut data = generate::torus_knot(1000);
    let good = data.triangles.len();
    let first = data.vertices.len() as u32;
    let (nan, inf) = ([f32::NAN, 0.0, 0.0], [0.0, f32::INFINITY, 0.0]);
    data.vertices.extend([[0.0; 3], [1.0, 1.0, 1.0], [2.0, 2.0, 2.0], nan, inf, [1e30, 0.0, 0.0], [1e-44, 0.0, 0.0]]);
    let [o, a, b, nan, inf, far, speck] = [0, 1, 2, 3, 4, 5, 6].map(|k| first + k);
    data.triangles.extend([[o, o, a], [a, a, a], [o, a, b], [o, nan, a], [inf, a, 0], [far, a, 0], [o, speck, speck]]);
    // The first ones move the numbers of all others.
    data.triangles.rotate_right(4);
    for mirror in [1.0, -1.0] {
        let map = DAffine3::from_scale(DVec3::new(1.0, 1.0, mirror));
        let mesh = Mesh::build(&Arc::new(data.clone()), &map, &Progress::default()).expect("nobody cancels");
        assert_eq!((mesh.len(), mesh.dropped()), (good, 7));
        let [a, b, c] = data.triangles[4].map(|vertex| data.vertices[vertex as usize]);
        let mirrored = |[x, y, z]: [f32; 3]| [x, y, z * mirror as f32];
        assert_eq!(mesh.corners(0), if mirror > 0.0 { [a, b, c] } else { [a, c, b].map(mirrored) });
    }
}

#[test]
fn many_copies_count_as_one() {
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let list =
        |triangles: &[[u32; 3]]| MeshData { vertices: corners.to_vec(), triangles: triangles.repeat(500), ..MeshData::default() };
    let down = |x: f32, y: f32| ([x, y, 1.0], [0.0, 0.0, -1.0]);
    let alone = Mesh::new(&list(&[[0, 1, 2]]));
    assert_eq!((alone.len(), alone.dropped(), first(&alone, down(0.6, 0.3), f32::INFINITY)), (1, 0, (1.0, 0)));
    let halves = Mesh::new(&list(&[[0, 1, 2], [0, 2, 3]]));
    assert!(matches!(halves.leaves, TriangleLeaves::Shared(_)) && (halves.len(), halves.dropped()) == (2, 0));
    assert_eq!([(0.6, 0.3), (0.3, 0.6)].map(|(x, y)| first(&halves, down(x, y), f32::INFINITY)), [(1.0, 0), (1.0, 1)]);
}

#[test]
fn coinciding_triangles_fit_into_the_tree() {
    let one = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
    let mut data = MeshData { vertices: one.to_vec(), triangles: vec![[0, 1, 2]; 1000], ..MeshData::default() };
    // Sizes that double drive the heuristic into a comb.
    for k in 0..90u32 {
        let x = 2f32.powi(k as i32 - 45);
        data.vertices.extend([[x, 0.0, 0.0], [x, x, 0.0], [x, 0.0, x]]);
        data.triangles.push([3 * k + 3, 3 * k + 4, 3 * k + 5]);
    }
    let mesh = Mesh::new(&data);
    let mut rng = SmallRng::seed_from_u64(4);
    assert_no_hit_is_lost(&mesh, &rays(&mesh, 3000, &mut rng));
}
