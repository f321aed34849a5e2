//! A filter that falls linearly to 0.
use serde::{Deserialize, Serialize};

use super::{Filter, Placing, WIDTHS};
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters},
    math::{F, Lanes, Pick},
};

/// Falls linearly to 0 at `radius`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tent {
    /// Half of the width, pixels.
    pub radius: f32,
}

impl Filter {
    /// A tent two pixels wide.
    pub const TENT: Filter = Filter::tent(1.0);

    /// A tent of a radius in pixels.
    pub const fn tent(radius: f32) -> Filter {
        Filter::Tent(Tent { radius })
    }
}

impl Default for Tent {
    fn default() -> Self {
        Tent { radius: 1.0 }
    }
}

impl Kind for Tent {
    const KIND: Parameter = Parameter::new("tent", "Falls linearly from the centre to 0.");

    fn chosen(&mut self, p: &mut dyn Parameters) {
        p.table(&Self::KIND, self);
    }
}

impl Declare for Tent {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const RADIUS: Parameter = Parameter::new("radius", "Radius of the tent.").unit("pixels").required();
        p.single(&RADIUS, &mut self.radius, WIDTHS);
    }
}

impl Placing for Tent {
    #[inline(always)]
    fn place<L: Lanes>(self, _: L, u: F<L>) -> F<L> {
        tent(u) * self.radius + 0.5
    }

    fn density(self, x: f32) -> f32 {
        (1.0 - x.abs() / self.radius).max(0.0) / self.radius
    }

    fn reach(self) -> f32 {
        self.radius
    }

    #[cfg(test)]
    fn distribution(self, x: f64) -> f64 {
        let y = (x / f64::from(self.radius)).clamp(-1.0, 1.0);
        if y < 0.0 { 0.5 * (1.0 + y).powi(2) } else { 1.0 - 0.5 * (1.0 - y).powi(2) }
    }
}

/// The inverse of the distribution function of 1 − |x| on [−1, 1].
#[inline(always)]
fn tent<L: Lanes>(u: F<L>) -> F<L> {
    let left = (u * 2.0).sqrt() - 1.0;
    let right = 1.0 - (2.0 - u * 2.0).sqrt();
    u.below(0.5).pick(left, right)
}
