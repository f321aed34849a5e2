//! All rays start at the eye.
use glam::DVec3;

use super::{Projecting, Seen};
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters},
    math::{Lanes, V},
};

/// All rays start at the eye.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Perspective;

impl Kind for Perspective {
    const KIND: Parameter = Parameter::new("perspective", "All rays start at the eye.");

    fn chosen(&mut self, _: &mut dyn Parameters) {}
}

impl Declare for Perspective {
    fn parameters(&mut self, _: &mut dyn Parameters) {}
}

impl Projecting for Perspective {
    fn has_angle(self) -> bool {
        true
    }

    fn takes_lens(self) -> bool {
        true
    }

    fn half_width(self, angle: f64) -> f64 {
        (angle.to_radians() / 2.0).tan()
    }

    fn middle(self, forward: DVec3) -> DVec3 {
        forward
    }

    fn scale(self, depth: f64) -> Option<f64> {
        if depth <= 1e-9 { None } else { Some(1.0 / depth) }
    }

    fn width_at(self, distance: f64, angle: f64) -> f64 {
        2.0 * distance * self.half_width(angle)
    }

    fn with_width(self, _: f64) -> Self {
        self
    }

    fn widened(self, _: f64) -> Option<Self> {
        None
    }

    #[inline(always)]
    fn rays<L: Lanes>(self, l: L, place: V<L>, eye: [f32; 3], _: [f32; 3]) -> (V<L>, V<L>) {
        (V::splat(l, eye), place.normalized())
    }

    /// An area of the image at distance 1 and angle θ to the axis has the solid angle cos³ θ, so it shows r² cos³ θ at distance r.
    #[inline(always)]
    fn seen<L: Lanes>(self, from_eye: V<L>, forward: [f32; 3]) -> Seen<L> {
        let depth = from_eye.dot_with(forward);
        let inverse = 1.0 / depth;
        let place = from_eye * inverse;
        // Over the depth |p| = r/depth = 1/cos θ.
        let scale = place.length_squared().sqrt() * inverse * inverse;
        Seen { place, way: -from_eye, scale, visible: depth.above(0.0) }
    }
}
