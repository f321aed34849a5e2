//! Meshes against brute force and a reference in f64.
mod dropped;
mod lanes;
mod surface;
mod watertight;

use std::f32::consts::TAU;

use fearless_simd::Fallback;
use glam::{DVec3, Vec3, vec3};
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{
    Mesh, MeshData, NONE, generate,
    leaves::{Filled, Leaf, TriangleLeaves},
    shear::{SIZE, Shears},
};
use noisefall_base::math::{F, Lanes, MAX_LANES, One, V, in_lanes};

type Ray = ([f32; 3], [f32; 3]);

fn unit(rng: &mut SmallRng) -> Vec3 {
    let (z, turn): (f32, f32) = (rng.random_range(-1.0..1.0), rng.random_range(0.0..TAU));
    let r = (1.0 - z * z).sqrt();
    vec3(r * turn.cos(), r * turn.sin(), z)
}

fn point(rng: &mut SmallRng, size: f32) -> Vec3 {
    vec3(rng.random_range(-size..size), rng.random_range(-size..size), rng.random_range(-size..size))
}

/// Triangles at random in a cube, some of them needles, specks or axis-parallel.
fn soup(count: usize, rng: &mut SmallRng) -> MeshData {
    let mut data = MeshData::default();
    for k in 0..count {
        let center = point(rng, 1.0);
        let size = if k % 7 == 0 { 1e-4 } else { 0.3 };
        let flat = if k % 3 == 0 { vec3(1.0, 0.0, 1.0) } else { Vec3::ONE };
        let needle = vec3(0.6, 0.64, 0.48) * size;
        for _ in 0..3 {
            let offset = if k % 5 == 0 { needle * rng.random::<f32>() + point(rng, size * 1e-4) } else { point(rng, size) };
            data.vertices.push((center + offset * flat).to_array());
        }
        data.triangles.push([3 * k as u32, 3 * k as u32 + 1, 3 * k as u32 + 2]);
    }
    data
}

/// A closed bumpy ball about the origin, of radius 0.7 to 1.3.
fn bumpy_ball(columns: usize, rows: usize) -> MeshData {
    let mut data = MeshData { vertices: vec![[0.0, 1.0, 0.0], [0.0, -1.0, 0.0]], ..MeshData::default() };
    let at = |i: usize, j: usize| match j {
        0 => 0,
        j if j == rows => 1,
        j => (2 + (i % columns) * (rows - 1) + j - 1) as u32,
    };
    for (i, j) in (0..columns).flat_map(|i| (1..rows).map(move |j| (i, j))) {
        let (phi, theta) = (TAU * i as f32 / columns as f32, 0.5 * TAU * j as f32 / rows as f32);
        let r = 1.0 + 0.2 * (7.0 * phi).sin() * (9.0 * theta).sin() + 0.1 * (31.0 * phi + 17.0 * theta).sin() * theta.sin();
        data.vertices.push([r * theta.sin() * phi.cos(), r * theta.cos(), -r * theta.sin() * phi.sin()]);
    }
    for (i, j) in (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j))) {
        let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
        data.triangles.extend([[a, b, c], [a, c, d]].into_iter().filter(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0]));
    }
    data
}

/// Rays of many kinds towards a mesh of size about 1.
fn rays(mesh: &Mesh, count: usize, rng: &mut SmallRng) -> Vec<Ray> {
    let mut rays = Vec::new();
    for k in 0..count {
        let corners = mesh.corners(rng.random_range(0..mesh.len() as u32)).map(Vec3::from);
        let [a, b, c] = corners;
        let (s, t): (f32, f32) = (rng.random(), rng.random());
        let on = a + (b - a) * (s * t.sqrt()) + (c - a) * ((1.0 - s) * t.sqrt());
        let along = b - a;
        let axis = [Vec3::X, Vec3::NEG_Y, Vec3::Z][k % 3];
        let (o, d) = match k % 12 {
            0 => (point(rng, 1.5), unit(rng)),
            1 => (point(rng, 1.5), axis),
            2 => (point(rng, 1.5), vec3(-0.0, axis.y + axis.x, 0.0) + axis * 1e-20),
            3 => (a - along * 2.0, along),
            4 => (point(rng, 1.0), a - point(rng, 1.0)),
            5 => {
                let o = point(rng, 2.0);
                (o, [a, a + along * s][k / 12 % 2] - o)
            }
            6 => (on - (along * s + (c - a) * (t - 0.5)).normalize_or(axis), along * s + (c - a) * (t - 0.5)),
            7 => (on, unit(rng)),
            8 => {
                let from = on + unit(rng) * 1e6;
                (from, (on - from).normalize())
            }
            9 => (on + unit(rng) * 1e-6, unit(rng) * 1e-6),
            10 => (on - axis, axis * 1e10),
            _ => (corners[k / 12 % 3] + axis, -axis),
        };
        rays.push((o.to_array(), if d == Vec3::ZERO { axis } else { d }.to_array()));
    }
    rays
}

/// The minimum distance over all triangles, tested one by one.
fn brute_force(mesh: &Mesh, ray: Ray) -> f32 {
    match &mesh.leaves {
        TriangleLeaves::Apart(filled) => least_distance(filled, ray),
        TriangleLeaves::Shared(filled) => least_distance(filled, ray),
    }
}

fn least_distance(filled: &Filled<impl Leaf>, ray: Ray) -> f32 {
    let (o, d) = in_columns(One, &[ray]);
    let shear = Shears::new(One, o, d).lane(0);
    let mut least = f32::INFINITY;
    for leaf in &filled.leaves {
        let sheared = leaf.sheared(Fallback::new(), &shear);
        for place in 0..SIZE {
            let t = sheared.distance(place, &shear);
            least = if t > 0.0 && t < least { t } else { least };
        }
    }
    least
}

/// Distance, infinite if there is none, and triangle, for every ray.
fn closest(mesh: &Mesh, rays: &[Ray]) -> Vec<(f32, u32)> {
    in_lanes!(SimdLevel::best(), l => traced(l, mesh, rays))
}

fn traced<L: Lanes>(l: L, mesh: &Mesh, rays: &[Ray]) -> Vec<(f32, u32)> {
    let mut hits = Vec::new();
    for rays in rays.chunks(L::N) {
        let (o, d) = in_columns(l, rays);
        let (t, triangle) = mesh.closest(l, o, d, l.f(f32::INFINITY));
        hits.extend(t.to_array().into_iter().zip(triangle.to_array()).take(rays.len()));
    }
    hits
}

/// The rays in lanes; unused lanes repeat the last one.
fn in_columns<L: Lanes>(l: L, rays: &[Ray]) -> (V<L>, V<L>) {
    let mut columns = [[0.0; MAX_LANES]; 6];
    for lane in 0..MAX_LANES {
        let (o, d) = rays[lane.min(rays.len() - 1)];
        for axis in 0..3 {
            (columns[axis][lane], columns[3 + axis][lane]) = (o[axis], d[axis]);
        }
    }
    let [ox, oy, oz, dx, dy, dz] = columns;
    (V { x: l.load(&ox), y: l.load(&oy), z: l.load(&oz) }, V { x: l.load(&dx), y: l.load(&dy), z: l.load(&dz) })
}

fn assert_no_hit_is_lost(mesh: &Mesh, rays: &[Ray]) {
    for (ray, (t, _)) in rays.iter().zip(closest(mesh, rays)) {
        assert_eq!(t, brute_force(mesh, *ray), "{ray:?}");
    }
}

fn meshes(rng: &mut SmallRng) -> Vec<Mesh> {
    let mut holed = generate::torus_knot(3000);
    holed.triangles.pop();
    let data = [soup(400, rng), holed, generate::heightfield(24, 1), bumpy_ball(40, 20)];
    data.iter().map(Mesh::new).collect()
}

#[test]
fn leaves_have_pairs_where_almost_all_triangles_share_edges() {
    let are_pairs = |mesh: &Mesh| matches!(mesh.leaves, TriangleLeaves::Shared(_));
    let meshes = meshes(&mut SmallRng::seed_from_u64(7));
    assert_eq!(meshes.iter().map(are_pairs).collect::<Vec<_>>(), [false, true, true, true]);
}

#[test]
fn no_hit_is_lost_to_a_box() {
    let mut rng = SmallRng::seed_from_u64(1);
    for mesh in meshes(&mut rng) {
        assert_no_hit_is_lost(&mesh, &rays(&mesh, 12_000, &mut rng));
    }
}

#[test]
fn no_hit_is_lost_at_any_scale_or_place() {
    let mut rng = SmallRng::seed_from_u64(2);
    for (scale, shift) in [(1e-6, 0.0), (1e6, 0.0), (1e-15, 0.0), (1e10, 0.0), (1.0, 1e4), (1e-3, 1e3), (1e3, -1e6)] {
        let mut data = soup(150, &mut rng);
        data.vertices.iter_mut().flatten().for_each(|x| *x = *x * scale + shift);
        let mesh = Mesh::new(&data);
        let mut rays = rays(&Mesh::new(&soup(150, &mut rng)), 6_000, &mut rng);
        rays.iter_mut().for_each(|ray| ray.0 = ray.0.map(|x| x * scale + shift));
        assert_no_hit_is_lost(&mesh, &rays);
    }
}

/// Distance and smallest barycentric coordinate, where the ray hits the plane of the triangle.
fn oracle(corners: [[f32; 3]; 3], (o, d): Ray) -> Option<(f64, f64, f64)> {
    let [a, b, c] = corners.map(|corner| Vec3::from(corner).as_dvec3());
    let (o, d) = (Vec3::from(o).as_dvec3(), Vec3::from(d).as_dvec3());
    let n = (b - a).cross(c - a);
    let t = (a - o).dot(n) / d.dot(n);
    let p = o + d * t;
    let weight = |b: DVec3, c: DVec3| (b - p).cross(c - p).dot(n) / n.length_squared();
    let least = weight(a, b).min(weight(b, c)).min(weight(c, a));
    let cosine = d.dot(n).abs() / (d.length() * n.length());
    (t > 0.0 && t.is_finite()).then_some((t, least, cosine))
}

#[test]
fn distances_are_those_of_the_oracle() {
    let mut rng = SmallRng::seed_from_u64(3);
    let (mut worst, mut compared) = (0.0f64, 0);
    for mesh in meshes(&mut rng) {
        for _ in 0..4000 {
            let (o, d) = (point(&mut rng, 1.5), unit(&mut rng));
            let ray = (o.to_array(), d.to_array());
            let intersections: Vec<_> = (0..mesh.len() as u32).filter_map(|k| oracle(mesh.corners(k), ray)).collect();
            let clear = |intersection: &&(f64, f64, f64)| intersection.1.abs() > 1e-3 && intersection.2 > 1e-2;
            let doubtful = intersections.iter().any(|intersection| intersection.1 > -1e-3 && !clear(&intersection));
            let nearest = intersections
                .iter()
                .filter(|intersection| intersection.1 > 0.0)
                .map(|intersection| intersection.0)
                .min_by(f64::total_cmp);
            if !doubtful {
                let t = closest(&mesh, &[ray])[0].0;
                assert_eq!(t.is_finite(), nearest.is_some(), "{ray:?}");
                worst = worst.max(nearest.map_or(0.0, |exact| (f64::from(t) - exact).abs()));
                compared += 1;
            }
        }
    }
    println!("{compared} compared, worst difference {worst:.2e}");
    assert!(compared > 10_000 && worst < 3e-5, "{compared} {worst}");
}

#[test]
fn nothing_and_next_to_nothing() {
    let ray = ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]);
    let one = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
    let empty = Mesh::new(&MeshData::default());
    assert!(empty.is_empty() && empty.bounds().is_empty());
    assert_eq!(first(&empty, ray, f32::INFINITY), (f32::INFINITY, NONE));
    let data = MeshData { vertices: one.to_vec(), triangles: vec![[0, 1, 2]], ..MeshData::default() };
    let single = Mesh::new(&data);
    assert_eq!(first(&single, ray, f32::INFINITY), (1.0, 0));
    assert_eq!(first(&single, ([0.0, 0.0, -3.0], [0.0, 0.0, 2.0]), f32::INFINITY), (1.5, 0));
    assert_eq!(first(&single, ([0.0, 0.0, -3.0], [0.0, 0.0, -2.0]), f32::INFINITY).1, NONE);
    // Edges and corners belong to the triangle, from both sides.
    for [x, y] in [[0.0, -1.0], [0.5, 0.0], [-0.5, 0.0], [-1.0, -1.0], [1.0, -1.0], [0.0, 1.0]] {
        for z in [1.0, -1.0] {
            assert_eq!(first(&single, ([x, y, z], [0.0, 0.0, -z]), f32::INFINITY), (1.0, 0), "{x} {y} {z}");
        }
    }
    assert_eq!(first(&single, ray, 1.0), (1.0, NONE));
    assert_eq!(first(&single, ray, 1.0 + f32::EPSILON), (1.0, 0));
    for d in [[0.0; 3], [f32::NAN; 3], [f32::INFINITY, 0.0, 0.0]] {
        assert_eq!(first(&single, (ray.0, d), f32::INFINITY).1, NONE);
    }
}

fn first(mesh: &Mesh, ray: Ray, t_max: f32) -> (f32, u32) {
    let (o, d) = in_columns(One, &[ray]);
    let (t, triangle) = mesh.closest(One, o, d, F(t_max));
    (t.0, triangle.0)
}

#[test]
fn no_hit_on_crowded_needles_is_lost_to_the_boxes_of_their_pieces() {
    let mut rng = SmallRng::seed_from_u64(5);
    let mut data = MeshData::default();
    for k in 0..2000 {
        let (center, along) = (point(&mut rng, 0.5), unit(&mut rng));
        let across = along.any_orthonormal_vector() * 1e-3;
        data.vertices.extend([center - along, center + along, center + across].map(|p| p.to_array()));
        data.triangles.push([3 * k, 3 * k + 1, 3 * k + 2]);
    }
    let mesh = Mesh::new(&data);
    let TriangleLeaves::Apart(filled) = &mesh.leaves else { panic!("they are not in pairs") };
    assert!(filled.leaves.len() * SIZE > 2 * mesh.len() && mesh.len() == 2000, "{} leaves", filled.leaves.len());
    let rays = rays(&mesh, 1200, &mut rng);
    assert_no_hit_is_lost(&mesh, &rays);
    assert_hits_are_on_their_triangles(&mesh, &rays);
}

fn assert_hits_are_on_their_triangles(mesh: &Mesh, rays: &[Ray]) {
    for ((o, d), (t, triangle)) in rays.iter().zip(closest(mesh, rays)).filter(|(_, (_, triangle))| *triangle != NONE) {
        let p = Vec3::from(*o).as_dvec3() + Vec3::from(*d).as_dvec3() * f64::from(t);
        let [a, b, c] = mesh.corners(triangle).map(|corner| Vec3::from(corner).as_dvec3());
        let n = (b - a).cross(c - a).normalize();
        // Behind an edge by no more than the tolerance.
        let beside = [(a, b), (b, c), (c, a)].map(|(from, to)| (p - from).dot((to - from).normalize().cross(n)));
        let off = beside.into_iter().fold((p - a).dot(n).abs(), f64::max);
        assert!(off < 1e-4 * f64::from(1.0 + Vec3::from(*o).length()), "{off}");
    }
}

#[test]
fn hits_are_on_the_triangles_that_are_told() {
    let mut rng = SmallRng::seed_from_u64(6);
    for mesh in meshes(&mut rng) {
        let rays: Vec<Ray> = (0..6000).map(|_| (point(&mut rng, 1.5).to_array(), unit(&mut rng).to_array())).collect();
        assert_hits_are_on_their_triangles(&mesh, &rays);
    }
}

#[test]
fn hills_stand_on_a_grid() {
    let data = generate::heightfield(2, 1);
    let places: Vec<[f32; 2]> = data.vertices.iter().map(|[x, _, z]| [*x, *z]).collect();
    let column = |x: f32| [[x, 1.0], [x, 0.0], [x, -1.0]];
    assert_eq!(places, [column(-1.0), column(0.0), column(1.0)].concat());
    assert_eq!((data.uvs.len(), data.normals.len(), data.triangles.len()), (9, 9, 8));
}

#[test]
fn the_front_of_the_knot_is_outside() {
    let data = generate::torus_knot(2000);
    let vertex = |id: u32| Vec3::from(data.vertices[id as usize]).as_dvec3();
    let sixfold = |triangle: &[u32; 3]| vertex(triangle[0]).dot(vertex(triangle[1]).cross(vertex(triangle[2])));
    let volume = data.triangles.iter().map(sixfold).sum::<f64>() / 6.0;
    assert!(volume > 0.0, "{volume}");
    assert!(data.contains(DVec3::new(0.77, 0.0, 0.0)) && !data.contains(DVec3::ZERO));
}
