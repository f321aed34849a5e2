//! Lamps without surface: no ray meets them, only light samples find them.
pub mod directional;
pub mod point;
pub mod projector;
pub mod spot;

use crate::declare::{Declare, Parameters};

crate::declare::catalogue! {
    /// A lamp without surface, as a scene describes it.
    pub enum LampKind: Shine, "lamp" {
        point::Point,
        spot::Spot,
        directional::Directional,
        projector::Projector,
    }
}

/// A kind of lamp.
pub trait Shine {}

impl Declare for LampKind {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.one_of(self);
    }
}
