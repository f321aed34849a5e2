//! What the choice of a light knows of an emitting piece: where it is, how much it may send, and to which side.
use std::f64::consts::PI;

use glam::DVec3;

use super::emission::{Emission, Side};
use crate::{geometry::Shape, math::colour::luminance};

/// An emitting piece of a shape, within a sphere.
pub(super) struct Bound {
    pub center: DVec3,
    pub radius: f64,
    /// Largest projected area over π.
    pub size: f64,
    /// Unit normal of the front; only flat pieces have one.
    pub normal: Option<DVec3>,
    /// Luminance of the front and of the back.
    pub front: f32,
    pub back: f32,
}

impl Bound {
    pub fn new(piece: &Shape, emission: &Emission) -> Bound {
        let (center, radius) = piece.bounding_sphere();
        let (size, normal) = match piece {
            Shape::Flat { edges: [a, b], mirrored, .. } => {
                let across = a.cross(*b).normalize() * if *mirrored { -1.0 } else { 1.0 };
                (piece.area().unwrap_or(0.0) / PI, Some(across))
            }
            _ => (radius * radius, None),
        };
        let light = luminance(emission.mean);
        let (front, back) = match emission.side {
            Side::Front => (light, 0.0),
            Side::Back => (0.0, light),
            Side::Both => (light, light),
        };
        Bound { center, radius, size, normal, front, back }
    }
}
