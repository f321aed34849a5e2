//! Many shapes of every type, static and moving: the tree finds the same hits as brute force.
use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{cases, exact, shapes, unit_vector, v};
use crate::geometry::{
    Expression, Isosurface, MISS, Motion, Nearest, Outline, Shape, Shapes, TransformStep, Turns,
    mesh::generate,
    sphere_field,
    transform::{LaneTransform, StaticTransform},
};
use noisefall_base::math::{F, Lanes, M, MAX_LANES, One, SimdLevel, U, V, in_lanes};

/// Every kind under every transform that keeps its size, meshes and isosurfaces, about a cube: every third one moves.
fn crowd(rng: &mut SmallRng) -> Vec<(Shape, Motion)> {
    let knot = Shape::mesh(Arc::new(generate::torus_knot(300)));
    let expression = Expression::parse("x^2 + y^2 + z^2 - 0.8").expect("an expression");
    let ball = Shape::Isosurface { surface: Arc::new(Isosurface::new(expression, [-1.0; 3], [1.0; 3])), map: DAffine3::IDENTITY };
    let kinds: Vec<Shape> = cases().into_iter().map(|case| case.shape).filter(|shape| shape.bounding_sphere().1 < 5.0).collect();
    let kinds: Vec<Shape> = kinds.into_iter().chain([knot, ball]).collect();
    let mut crowd = Vec::new();
    for i in 0..300 {
        let at = unit_vector(rng) * rng.random_range(1.0..10.0);
        let turn = DAffine3::from_axis_angle(unit_vector(rng), rng.random_range(0.0..6.0));
        let map = DAffine3::from_translation(at) * turn * DAffine3::from_scale(DVec3::splat(rng.random_range(0.1..0.6)));
        let steps = [
            TransformStep::Translate(unit_vector(rng)),
            TransformStep::Rotate { axis: unit_vector(rng), turns: Turns::from_degrees(rng.random_range(-108.0..108.0)) },
            TransformStep::Scale(DVec3::new(1.3, 0.8, 1.1)),
            TransformStep::Matrix(DAffine3::from_translation(unit_vector(rng) * 0.1)),
        ];
        let motion = Motion(if i % 3 == 0 { steps[..1 + i / 3 % 4].to_vec() } else { Vec::new() });
        crowd.push((kinds[i % kinds.len()].transformed(&map), motion));
    }
    crowd
}

/// The bound on the rounding has a size and no sign.
#[test]
fn a_map_and_the_opposite_one_round_alike() {
    let turn = DMat3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 1.1);
    let rounding = |matrix| {
        LaneTransform::new(One, &StaticTransform::new(&DAffine3::from_mat3(matrix)), &[], F(0.0)).rounding(v(DVec3::ONE)).0
    };
    assert_eq!(rounding(-turn), rounding(turn));
}

/// Distance to the nearest shape by brute force.
fn one_by_one(alone: &[Shapes], o: V<One>, d: V<One>, time: f32) -> Option<f32> {
    let meet = |shapes: &Shapes| shapes.closest(One, M(true), o, d, F(time));
    let distances = alone.iter().map(meet).filter(|nearest| nearest.primitive.0 != MISS).map(|nearest| nearest.t.0);
    distances.min_by(f32::total_cmp)
}

#[test]
fn the_tree_finds_the_nearest_of_all_shapes() {
    let mut rng = SmallRng::seed_from_u64(1);
    let crowd = crowd(&mut rng);
    let of = |crowd: &[(Shape, Motion)]| Shapes::new(crowd.iter().map(|(shape, motion)| (shape, motion)), DVec3::ZERO);
    let all = of(&crowd);
    assert!(all.has_tree());
    let alone: Vec<Shapes> = crowd.chunks(1).map(of).collect();
    let (mut o, mut met) = (v(DVec3::ZERO), 0);
    for i in 0..6000 {
        let (d, time) = (v(unit_vector(&mut rng)), rng.random_range(0.0..1.0));
        let Nearest { t, primitive: U(primitive), .. } = all.closest(One, M(true), o, d, F(time));
        let expected = one_by_one(&alone, o, d, time);
        let found = (primitive != MISS).then_some(t.0);
        // Fractions are compared here, quotients there.
        let same = match (found, expected) {
            (Some(a), Some(b)) => (a - b).abs() <= 2.0 * f32::EPSILON * b,
            (a, b) => a == b,
        };
        assert!(same, "{found:?} for {expected:?}, ray {i}: o {} d {} time {time}", exact(o), exact(d));
        met += usize::from(found.is_some());
        // On from the surface, or anew: from the middle, or from far away.
        o = match found {
            Some(t) => o + d * F(t),
            None => v(unit_vector(&mut rng) * [0.0, 8.0, 1e3][i % 3]),
        };
    }
    assert!(met > 1500, "{met}");
}

/// Some rays in lanes, of which some have none, against the same rays alone.
fn assert_lanes_agree_with_single_rays<L: Lanes>(l: L, all: &Shapes, rng: &mut SmallRng) {
    let rays: [[V<One>; 2]; MAX_LANES] = std::array::from_fn(|_| [v(unit_vector(rng) * 3.0), v(unit_vector(rng))]);
    let times: [f32; MAX_LANES] = std::array::from_fn(|_| rng.random_range(0.0..1.0));
    let is_live: [f32; MAX_LANES] = std::array::from_fn(|_| f32::from(rng.random::<u32>() % 4 > 0));
    let [o, d] = [0, 1].map(|i| {
        let column = |of: fn(&V<One>) -> f32| l.load(&rays.map(|ray| of(&ray[i])));
        V { x: column(|v| v.x.0), y: column(|v| v.y.0), z: column(|v| v.z.0) }
    });
    let found = all.closest(l, l.load(&is_live).above(0.0), o, d, l.load(&times));
    let (t, primitive, element) = (found.t.to_array(), found.primitive.to_array(), found.element.to_array());
    for (lane, [o, d]) in rays.into_iter().enumerate().take(L::N).filter(|(lane, _)| is_live[*lane] > 0.0) {
        let alone = all.closest(One, M(true), o, d, F(times[lane]));
        assert_eq!((t[lane], primitive[lane]), (alone.t.0, alone.primitive.0));
        assert!(alone.primitive.0 == MISS || element[lane] == alone.element.0);
    }
}

#[test]
fn rays_in_lanes_agree_with_single_rays() {
    let mut rng = SmallRng::seed_from_u64(2);
    let crowd = crowd(&mut rng);
    let all = Shapes::new(crowd.iter().map(|(shape, motion)| (shape, motion)), DVec3::ZERO);
    for level in SimdLevel::available() {
        for _ in 0..300 {
            in_lanes!(level, l => assert_lanes_agree_with_single_rays(l, &all, &mut rng));
        }
    }
}

/// A unit square at this height, and a larger one in the same plane.
fn punctual_in_ceiling() -> [Shape; 2] {
    let square = |half: f64| Shape::Flat {
        outline: Outline::Parallelogram,
        origin: DVec3::new(-half, 20.0, -half),
        edges: [DVec3::X * 2.0 * half, DVec3::Z * 2.0 * half],
        mirrored: false,
    };
    [square(1.0), square(30.0)]
}

#[test]
fn of_surfaces_that_coincide_the_first_one_is_met_with_a_tree_and_without() {
    let still = Motion::default();
    let crowd: Vec<Shape> = sphere_field(600, DVec3::splat(-2.0), DVec3::splat(4.0), 1);
    for order in [[0, 1], [1, 0]] {
        for count in [0, 100, crowd.len()] {
            let pair = order.map(|i| punctual_in_ceiling()[i].clone());
            let shapes: Vec<Shape> = pair.into_iter().chain(crowd[..count].iter().cloned()).collect();
            let shapes = Shapes::new(shapes.iter().map(|shape| (shape, &still)), DVec3::ZERO);
            assert_eq!(shapes.has_tree(), count == crowd.len());
            let met = shapes.closest(One, M(true), v(DVec3::new(0.1, 10.0, 0.3)), v(DVec3::Y), F(0.0)).primitive.0;
            assert_eq!(met, 0, "{order:?}");
        }
    }
}

#[test]
fn a_sun_does_not_widen_the_boxes_of_a_crowd() {
    let still = Motion::default();
    let mut shapes = sphere_field(500, DVec3::splat(-2.0), DVec3::splat(4.0), 1);
    shapes.insert(0, Shape::sphere(DVec3::new(0.0, 1.5e11, 0.0), 7e8));
    let all = Shapes::new(shapes.iter().map(|shape| (shape, &still)), DVec3::ZERO);
    assert!(all.tree_reach() < 10.0, "{}", all.tree_reach());
    assert_eq!(all.closest(One, M(true), v(DVec3::new(0.0, 3.0, 0.0)), v(DVec3::Y), F(0.0)).primitive.0, 0);
}

/// Spheres in a grid that touch, some of them twice or ten times.
fn touching() -> Vec<Shape> {
    let mut spheres = Vec::new();
    for i in 0..60 {
        let center = DVec3::new(f64::from(i % 4), f64::from(i / 4 % 4), f64::from(i / 16)) - 1.5;
        let times = if i == 21 { 10 } else { 1 + i % 3 / 2 };
        spheres.extend((0..times).map(|_| Shape::sphere(center, 0.5)));
    }
    spheres
}

#[test]
fn clusters_agree_with_single_spheres() {
    let mut rng = SmallRng::seed_from_u64(7);
    let field = sphere_field(100, DVec3::splat(-2.0), DVec3::splat(4.0), 1);
    for spheres in [field, touching()] {
        let all = shapes(&spheres);
        assert!(!all.has_tree());
        let alone: Vec<Shapes> = spheres.iter().map(|sphere| shapes(std::slice::from_ref(sphere))).collect();
        let mut hits = 0;
        for i in 0..4000 {
            let o = v(unit_vector(&mut rng) * [0.3, 4.0, 300.0][i % 3]);
            let target = DVec3::from_array([0; 3].map(|_| rng.random_range(-2.0..2.0)));
            let d = v((target - exact(o)).normalize());
            let found = all.closest(One, M(true), o, d, F(0.0));
            let distances = alone.iter().map(|sphere| sphere.closest(One, M(true), o, d, F(0.0)).t.0);
            let (first, t) = distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).expect("spheres");
            assert_eq!(found.t.0, t, "ray {i}");
            if t < f32::INFINITY {
                hits += 1;
                assert_eq!(found.primitive.0, first as u32, "ray {i}: of spheres that coincide the first");
            }
        }
        assert!(hits > 500, "{hits}");
    }
}

#[test]
fn the_sphere_around_a_sheared_box_ends_at_its_farthest_corner_whichever_it_is() {
    for [s, t] in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
        let edges = DMat3::from_cols(DVec3::X, DVec3::new(0.5 * s, 1.0, 0.0), DVec3::new(0.5 * t, 0.2 * s * t, 1.0));
        let origin = DVec3::new(1.0, 2.0, 3.0);
        let (center, radius) = Shape::Cuboid { origin, edges }.bounding_sphere();
        let corner = |i: i32| origin + edges * DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2));
        let farthest = (0..8).map(|i| corner(i).distance(center)).fold(0.0, f64::max);
        assert!((radius - farthest).abs() < 1e-12, "{radius} {farthest}");
    }
}
