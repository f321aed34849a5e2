//! Bounds of an emitting piece or a light for light selection: its position, power and emitting side.
use std::f64::consts::PI;

use glam::DVec3;

use super::{
    emission::{Emission, Side},
    punctual_light::{PunctualBound, PunctualLight},
};
use crate::geometry::{Motion, Shape};
use noisefall_base::math::colour::luminance;

/// Bounds of an emitting piece of a shape: a sphere, its size and its sides.
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
    pub moves: bool,
}

impl Bound {
    /// Bounds a piece over its whole motion.
    pub fn new(piece: &Shape, motion: &Motion, emission: &Emission) -> Bound {
        let moves = !motion.0.is_empty();
        let (center, radius) = piece.swept_sphere(motion);
        let (size, normal) = match piece {
            _ if moves => (radius * radius, None),
            Shape::Flat { outline, edges: [a, b], mirrored, .. } => {
                let across = a.cross(*b);
                let side = if *mirrored { -1.0 } else { 1.0 };
                (across.length() * outline.area() / PI, Some(across.normalize() * side))
            }
            _ => (radius * radius, None),
        };
        let light = luminance(emission.mean);
        let (front, back) = match emission.side {
            _ if emission.translucent => (light, light),
            Side::Front => (light, 0.0),
            Side::Back => (0.0, light),
            Side::Both => (light, light),
        };
        Bound { center, radius, size, normal, front, back, moves }
    }

    /// Bounds a punctual light; `None` if it is infinitely far away.
    pub fn of_punctual(punctual_light: &PunctualLight) -> Option<Bound> {
        let PunctualBound { position, axis, light } = punctual_light.bound()?;
        Some(Bound { center: position, radius: 0.0, size: 1.0 / PI, normal: axis, front: light, back: 0.0, moves: false })
    }
}
