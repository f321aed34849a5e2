//! Every type of shape under every kind of transform, against references in f64.
mod coordinates;
mod objects;
mod rays;
mod toward;

use std::f64::consts::PI;

use glam::{DAffine3, DMat3, DVec3};
use rand::{Rng, rngs::SmallRng};

use super::{Motion, Outline, PrimitiveRef, Shape, Shapes, oracle::point_at};
use noisefall_base::math::{F, One, U, V};

/// A shape with a description.
pub struct Case {
    pub name: String,
    pub shape: Shape,
}

impl Case {
    pub fn shapes(&self) -> Shapes {
        shapes(std::slice::from_ref(&self.shape))
    }

    /// The extent of the shape.
    pub fn size(&self) -> f64 {
        self.shape.bounding_sphere().1
    }
}

/// One of each kind, about a metre large, at the origin.
fn kinds() -> Vec<Shape> {
    let flat = |outline, origin, edges| Shape::Flat { outline, origin, edges, mirrored: false };
    vec![
        Shape::sphere(DVec3::ZERO, 0.8),
        flat(Outline::Parallelogram, DVec3::new(-0.7, -0.4, 0.1), [DVec3::new(1.5, 0.1, 0.0), DVec3::new(-0.2, 0.9, 0.3)]),
        flat(Outline::Parallelogram, DVec3::new(-0.5, 0.0, -0.5), [DVec3::new(0.0, 0.0, 1.2), DVec3::new(0.8, 0.0, 0.0)]),
        flat(Outline::Triangle, DVec3::new(-0.5, -0.5, 0.2), [DVec3::new(1.2, 0.1, -0.1), DVec3::new(0.3, 1.0, 0.2)]),
        Shape::disk(DVec3::new(0.1, 0.0, -0.1), DVec3::new(1.0, 2.0, -0.5).normalize(), 0.7),
        Shape::Cuboid { origin: DVec3::new(-0.5, -0.7, -0.3), edges: DMat3::from_diagonal(DVec3::new(1.1, 1.3, 0.7)) },
        Shape::cylinder(DVec3::new(0.0, -0.6, 0.1), DVec3::new(0.2, 0.7, 0.0), 0.4, true),
        Shape::cylinder(DVec3::new(0.0, -0.6, 0.1), DVec3::new(0.2, 0.7, 0.0), 0.4, false),
    ]
}

/// Transforms of every kind: their products of sizes from 10⁻⁴ to 10⁵.
fn transforms() -> Vec<(&'static str, DAffine3)> {
    let turn = DAffine3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 1.1);
    let stretch = DAffine3::from_scale(DVec3::new(0.5, 2.0, 1.2));
    let shear = DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::new(0.6, 1.0, 0.0), DVec3::new(0.0, -0.3, 0.9)));
    let at = |x: f64| DAffine3::from_translation(DVec3::new(0.3, -0.2, 0.5) * x);
    let scale = |s: f64| DAffine3::from_scale(DVec3::splat(s));
    vec![
        ("as it is", DAffine3::IDENTITY),
        ("turned and moved", at(2.0) * turn),
        ("stretched", at(1.0) * turn * stretch),
        ("sheared", turn * shear * stretch),
        ("mirrored", at(1.0) * turn * DAffine3::from_scale(DVec3::new(-1.0, 1.4, 1.0))),
        ("tiny", at(1.0) * turn * stretch * scale(1e-4)),
        ("huge", DAffine3::from_translation(DVec3::new(0.0, -9e4, 1e3)) * turn * stretch * scale(1e5)),
    ]
}

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for shape in kinds() {
        for (how, map) in transforms() {
            let shape = shape.transformed(&map);
            cases.push(Case { name: format!("{} {how}", shape.name()), shape });
        }
    }
    cases
}

static STILL: Motion = Motion(Vec::new());

pub fn shapes(of: &[Shape]) -> Shapes {
    Shapes::new(of.iter().map(|shape| (shape, &STILL)), DVec3::ZERO)
}

pub fn place(primitive: u32) -> PrimitiveRef<One> {
    PrimitiveRef::of(One, U(primitive))
}

pub fn v(a: DVec3) -> V<One> {
    V::splat(One, a.as_vec3().to_array())
}

pub fn exact(v: V<One>) -> DVec3 {
    DVec3::new(v.x.0.into(), v.y.0.into(), v.z.0.into())
}

pub fn unit_vector(rng: &mut SmallRng) -> DVec3 {
    let (z, phi) = (rng.random_range(-1.0..1.0f64), rng.random_range(0.0..2.0 * PI));
    let r = (1.0 - z * z).sqrt();
    DVec3::new(r * phi.cos(), r * phi.sin(), z)
}

pub fn point(rng: &mut SmallRng, piece: &Shape) -> DVec3 {
    point_at(piece, [rng.random_range(0.0..1.0), rng.random_range(0.0..1.0)])
}

pub fn lane(x: F<One>) -> f64 {
    x.0.into()
}
