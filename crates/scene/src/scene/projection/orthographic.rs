//! All rays are parallel.
use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{Projecting, Projection, Seen};
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters, Range},
    math::{Lanes, V},
};

/// All rays are parallel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Orthographic {
    /// Width of the image in the scene, metres.
    pub width: f64,
}

const WIDTHS: Range = Range::log(1e-9, 1e9);

impl Projection {
    /// Parallel rays that show a width in metres.
    pub const fn orthographic(width: f64) -> Projection {
        Projection::Orthographic(Orthographic { width })
    }
}

impl Default for Orthographic {
    fn default() -> Self {
        Orthographic { width: 4.0 }
    }
}

impl Kind for Orthographic {
    const KIND: Parameter = Parameter::new("orthographic", "Parallel projection.");
}

impl Declare for Orthographic {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const WIDTH: Parameter = Parameter::new("width", "Width of the image in the scene.").unit("m").required();
        p.number(&WIDTH, &mut self.width, WIDTHS);
    }
}

impl Projecting for Orthographic {
    fn has_angle(self) -> bool {
        false
    }

    fn takes_lens(self) -> bool {
        false
    }

    fn half_width(self, _: f64) -> f64 {
        self.width / 2.0
    }

    fn middle(self, _: DVec3) -> DVec3 {
        DVec3::ZERO
    }

    fn scale(self, _: f64) -> Option<f64> {
        Some(1.0)
    }

    fn width_at(self, _: f64, _: f64) -> f64 {
        self.width
    }

    fn with_width(self, width: f64) -> Self {
        Orthographic { width }
    }

    fn widened(self, factor: f64) -> Option<Self> {
        Some(Orthographic { width: (self.width * factor).clamp(WIDTHS.least, WIDTHS.most) })
    }

    #[inline(always)]
    fn rays<L: Lanes>(self, l: L, place: V<L>, eye: [f32; 3], forward: [f32; 3]) -> (V<L>, V<L>) {
        (place + eye, V::splat(l, forward))
    }

    #[inline(always)]
    fn seen<L: Lanes>(self, from_eye: V<L>, forward: [f32; 3]) -> Seen<L> {
        let depth = from_eye.dot_with(forward);
        let [x, y, z] = forward.map(|axis| depth * -axis);
        Seen { place: from_eye, way: V { x, y, z }, scale: depth.splat(1.0), visible: depth.above(0.0) }
    }
}
