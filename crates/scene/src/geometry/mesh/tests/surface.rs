//! Points, normals and offsets.
use fearless_simd::Fallback;
use glam::Vec3;
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{
    super::{
        Mesh, MeshData, generate,
        leaves::{Filled, Leaf, TriangleLeaves},
        shear::{SIZE, Shears},
    },
    soup, unit,
};
use noisefall_base::math::{One, U, V};

#[test]
fn rays_that_leave_a_surface_do_not_meet_it() {
    let mut rng = SmallRng::seed_from_u64(9);
    for shift in [0.0, 3.0, 1e3] {
        let mut data = soup(500, &mut rng);
        data.vertices.iter_mut().flatten().for_each(|x| *x += shift);
        assert_left(&Mesh::new(&data), 1.0, &mut rng);
        // Pairs are tested by corners in another order.
        let mut data = generate::torus_knot(1000);
        data.vertices.iter_mut().flatten().for_each(|x| *x += shift);
        assert_left(&Mesh::new(&data), 1.0, &mut rng);
    }
    // Near the origin of coordinates points are almost exact, and what is rounded is the rest of the triangle.
    let mut data = soup(500, &mut rng);
    for corners in data.vertices.chunks_exact_mut(3) {
        let first = Vec3::from(corners[0]);
        corners.iter_mut().for_each(|corner| *corner = (Vec3::from(*corner) - first).to_array());
    }
    assert_left(&Mesh::new(&data), 1e-6, &mut rng);
}

/// Rays to all sides, many of them along the surface, from points of all triangles no farther from their first vertex than
/// `extent` times their size.
fn assert_left(mesh: &Mesh, extent: f32, rng: &mut SmallRng) {
    match &mesh.leaves {
        TriangleLeaves::Apart(filled) => assert_left_by(mesh, filled, extent, rng),
        TriangleLeaves::Shared(filled) => assert_left_by(mesh, filled, extent, rng),
    }
}

fn assert_left_by(mesh: &Mesh, filled: &Filled<impl Leaf>, extent: f32, rng: &mut SmallRng) {
    let slots: Vec<u32> = (0..(filled.leaves.len() * SIZE) as u32).collect();
    let slot_of = |triangle: u32| slots.iter().copied().find(|slot| filled.triangle(*slot) == triangle);
    let slot_of: Vec<u32> = (0..mesh.len() as u32).map(|triangle| slot_of(triangle).expect("a leaf has it")).collect();
    for k in 0..200_000u32 {
        let triangle = k % mesh.len() as u32;
        let [a, b, c] = mesh.corners(triangle).map(Vec3::from);
        let (s, t): (f32, f32) = (rng.random(), rng.random::<f32>().sqrt() * extent);
        let near = a + (b - a) * (s * t) + (c - a) * ((1.0 - s) * t);
        let at = mesh.surface_point(One, U(triangle), V::splat(One, near.to_array()));
        let n = Vec3::from(at.n_geometric.lane(0));
        let grazing = [1.0, 1e-2, 1e-4, 1e-6, 0.0][k as usize % 5];
        let across = unit(rng).cross(n).normalize();
        let d = (across + n * rng.random_range(-grazing..=grazing)).normalize();
        let side = if n.dot(d) < 0.0 { -1.0 } else { 1.0 };
        let o = Vec3::from(at.p.lane(0)) + n * (side * at.error.0);
        let shear = Shears::new(One, V::splat(One, o.to_array()), V::splat(One, d.to_array())).lane(0);
        let slot = slot_of[triangle as usize] as usize;
        let t = filled.leaves[slot / SIZE].sheared(Fallback::new(), &shear).distance(slot % SIZE, &shear);
        assert!(t.is_nan() || t <= 0.0, "{t:e} {o} {d} {n} error {:e} at {a} {b} {c}", at.error.0);
    }
}

#[test]
fn points_lie_on_their_triangles() {
    let mut rng = SmallRng::seed_from_u64(10);
    let mesh = Mesh::new(&generate::torus_knot(2000));
    for triangle in 0..mesh.len() as u32 {
        let [a, b, c] = mesh.corners(triangle).map(Vec3::from);
        let (s, t): (f32, f32) = (rng.random(), rng.random());
        let (beta, gamma) = (s * t.sqrt(), (1.0 - s) * t.sqrt());
        let on = a + (b - a) * beta + (c - a) * gamma;
        let n = (b - a).as_dvec3().cross((c - a).as_dvec3()).normalize();
        let at = mesh.surface_point(One, U(triangle), V::splat(One, (on + n.as_vec3() * 1e-6).to_array()));
        let p = Vec3::from(at.p.lane(0));
        assert!((p - on).length() < 1e-6 && n.dot((p - a).as_dvec3()).abs() < 1e-7, "{p} {on}");
        assert!((Vec3::from(at.n_geometric.lane(0)).as_dvec3() - n).length() < 1e-5);
        assert!((at.barycentrics[0].0 - beta).abs() < 1e-3 && (at.barycentrics[1].0 - gamma).abs() < 1e-3);
        assert!(at.error.0 < 3e-6, "{}", at.error.0);
        let normal = Vec3::from(mesh.interpolated_normal(One, U(triangle), at.barycentrics).lane(0));
        assert!(normal.length() < 1.001 && normal.as_dvec3().dot(n) > 0.0, "the front is outside");
    }
}

#[test]
fn colours_of_vertices_are_interpolated_and_1_without_them() {
    let colours = vec![[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 0.5], [0.0, 0.0, 1.0, 0.0]];
    let bare = MeshData {
        vertices: vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 4.0, 0.0]],
        triangles: vec![[0, 1, 2]],
        ..MeshData::default()
    };
    let coloured = Mesh::new(&MeshData { colours, ..bare.clone() });
    let at = |mesh: &Mesh, p: [f32; 3]| mesh.vertex_colour(One, U(0), V::splat(One, p)).map(|x| x.0);
    for (p, expected) in [
        ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 1.0]),
        ([2.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.5]),
        ([0.0, 4.0, 0.0], [0.0, 0.0, 1.0, 0.0]),
        ([0.5, 1.0, 0.0], [0.5, 0.25, 0.25, 0.625]),
        // Beside the triangle by rounding.
        ([-1e-6, 2.0, 1e-6], [0.5, 0.0, 0.5, 0.5]),
    ] {
        let found = at(&coloured, p);
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5 && (0.0..=1.0).contains(a)), "{p:?}: {found:?}");
        assert_eq!(at(&Mesh::new(&bare), p), [1.0; 4]);
    }
}
