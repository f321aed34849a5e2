//! Directions towards primitives against their pdf.
use std::{f64::consts::PI, sync::Arc};

use glam::DVec3;
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{Case, exact, kinds, lane, place, shapes, transforms, unit_vector, v};
use crate::geometry::{MISS, MeshData, Nearest, Outline, Shape, Shapes};
use noisefall_base::math::{F, M, One, U, V};

const SAMPLES: usize = 30_000;

/// Functions of directions, whose integrals over the solid angle of a shape are compared.
fn measures(d: DVec3) -> [f64; 4] {
    [1.0, 0.5 + 0.5 * d.x, d.y * d.y, 0.5 + 0.5 * (5.0 * d.z + 2.0 * d.x).sin()]
}

/// Mean and variance of the mean of the integrals.
#[derive(Default)]
struct Estimate {
    sums: [[f64; 2]; 4],
    count: f64,
}

impl Estimate {
    fn add(&mut self, weight: f64, d: DVec3) {
        for (sum, measure) in self.sums.iter_mut().zip(measures(d)) {
            *sum = [sum[0] + weight * measure, sum[1] + (weight * measure).powi(2)];
        }
        self.count += 1.0;
    }

    fn mean(&self, i: usize) -> (f64, f64) {
        let [sum, square] = self.sums[i].map(|sum| sum / self.count);
        (sum, (square - sum * sum).max(0.0) / self.count)
    }
}

/// Whether the first surface along `d` is seen from the front.
fn front(shapes: &Shapes, x: V<One>, d: V<One>) -> Option<bool> {
    let Nearest { t, primitive: U(primitive), .. } = shapes.closest(One, M(true), x, d, F(0.0));
    (primitive != MISS).then(|| shapes.surface_point(One, &place(primitive), x + d * t).n_geometric.dot(d).0 < 0.0)
}

fn assert_match(case: &Case, x: DVec3, rng: &mut SmallRng) {
    let x = v(x);
    for (id, piece) in case.shape.pieces().into_iter().enumerate() {
        let whole = case.shapes();
        let alone = shapes(std::slice::from_ref(&piece));
        let id = &place(id as u32);
        let (mut sampled, mut seen) = (Estimate::default(), Estimate::default());
        let (center, radius) = piece.bounding_sphere();
        let (axis, away) = ((center - exact(x)).normalize(), center.distance(exact(x)));
        // Uniform over a cone around the piece, or everywhere from within its bounding sphere.
        let least = if away > radius { (1.0 - (radius / away).powi(2)).sqrt() - 1e-6 } else { -1.0 };
        for _ in 0..SAMPLES {
            let u = (F(rng.random_range(0.0..1.0f32)), F(rng.random_range(0.0..1.0f32)));
            let toward = whole.toward(One, id, x, u);
            if toward.pdf.0 > 0.0 && front(&alone, x, toward.wi).is_some() {
                let pdf = whole.pdf_toward(One, id, x, toward.wi);
                assert!((pdf.0 / toward.pdf.0 - 1.0).abs() < 1e-3, "{}: {} {}", case.name, pdf.0, toward.pdf.0);
                assert_eq!(front(&alone, x, toward.wi), Some(toward.front.0), "{}", case.name);
                sampled.add(1.0 / lane(toward.pdf), exact(toward.wi));
            } else {
                sampled.add(0.0, DVec3::ZERO);
            }
            let z = rng.random_range(least..1.0f64);
            let beside = axis.cross(unit_vector(rng)).normalize();
            let d = axis * z + beside * (1.0 - z * z).sqrt();
            let hit = front(&alone, x, v(d)).is_some();
            seen.add(if hit { 2.0 * PI * (1.0 - least) } else { 0.0 }, d);
        }
        for i in 0..4 {
            let ((a, var_a), (b, var_b)) = (sampled.mean(i), seen.mean(i));
            let z = (a - b) / (var_a + var_b + (1e-5 * b).powi(2)).sqrt().max(1e-12);
            assert!(z.abs() < 4.5, "{} {}, integral {i}: sampled {a}, seen {b}, z = {z}", case.name, id.primitive.0);
        }
    }
}

#[test]
fn directions_cover_the_visible_part_of_a_shape_as_their_density_says() {
    let mut rng = SmallRng::seed_from_u64(1);
    for shape in kinds() {
        for (how, map) in transforms().into_iter().take(5) {
            let shape = shape.transformed(&map);
            let case = Case { name: format!("{} {how}", shape.name()), shape };
            let (center, size) = case.shape.bounding_sphere();
            for distance in [1.3, 6.0] {
                assert_match(&case, center + unit_vector(&mut rng) * size * distance, &mut rng);
            }
            if case.shape.contains(center) {
                assert_match(&case, center + unit_vector(&mut rng) * size * 0.05, &mut rng);
            }
        }
    }
}

/// From the plane of a flat shape nothing of it is seen, from above its front.
#[test]
fn nothing_has_a_density_where_a_flat_shape_is_seen_from_its_edge() {
    let edges = [DVec3::X, DVec3::Y];
    let flat = |outline| Shape::Flat { origin: DVec3::ZERO, edges, outline, mirrored: false };
    let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let mesh = Shape::mesh(Arc::new(MeshData { vertices, triangles: vec![[0, 1, 2]], ..MeshData::default() }));
    for shape in [flat(Outline::Parallelogram), flat(Outline::Triangle), flat(Outline::Ellipse), mesh] {
        let shapes = shapes(&[shape]);
        let x = V { x: F(3.0), y: F(0.5), z: F(0.0) };
        assert_eq!(shapes.toward(One, &place(0), x, (F(0.4), F(0.3))).pdf.0, 0.0);
        for d in [[-1.0, 0.0, 0.0], [-1.0, 0.1, 0.2]] {
            assert_eq!(shapes.pdf_toward(One, &place(0), x, V::splat(One, d)).0, 0.0);
        }
        for z in [0.5, -0.5] {
            let near = V { x: F(0.2), y: F(0.3), z: F(z) };
            let toward = shapes.toward(One, &place(0), near, (F(0.4), F(0.3)));
            assert_eq!((toward.front.0, toward.pdf.0 > 0.0), (z > 0.0, true), "its front is above, and both sides are seen");
        }
    }
}

/// Rounded directions miss a tube that is 10⁻⁷ of its distance wide, but other strategies ask for their pdf.
#[test]
fn a_sampled_direction_has_a_pdf_where_it_misses_a_thin_tube_by_rounding() {
    let [base, top] = [-0.05, 0.05].map(|x| DVec3::new(x, 1.0, 0.0));
    let shapes = shapes(&[Shape::cylinder(base, top, 1e-7, false)]);
    let mut rng = SmallRng::seed_from_u64(7);
    let mut random = || F(rng.random_range(0.0..1.0f32));
    let ratio = |_| {
        let x = V { x: F(0.1) * random(), y: F(0.0), z: F(0.1) * random() };
        let toward = shapes.toward(One, &place(0), x, (random(), random()));
        shapes.pdf_toward(One, &place(0), x, toward.wi).0 / toward.pdf.0
    };
    let ratios: Vec<f32> = (0..SAMPLES).map(ratio).collect();
    let share = |least: f32| ratios.iter().filter(|ratio| **ratio > least).count() as f64 / ratios.len() as f64;
    assert!(share(0.0) > 0.999 && share(0.1) > 0.9, "{} {}", share(0.0), share(0.1));
}
