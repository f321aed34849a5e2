//! Punctual lights: no ray meets them, only light samples find them.
//!
//! The direction of a sample is a delta distribution. It has no pdf, so its MIS weight is 1, and it is taken even by the estimator
//! `path`, which could not see these lights otherwise. A sample arrives if the first surface along its ray is at least as far away as
//! the light, or if there is none. No tolerance is needed: no surface belongs to the light.
//!
//! | file | holds |
//! |---|---|
//! | `point.rs`, `spot.rs`, `directional.rs`, `projector.rs` | the kinds: description, parameters, compiled light |
//! | `falloff.rs` | how spots fall off |
//! | `compiled.rs` | a compiled light |
//! | `row.rs` | its numbers, as the renderer reads them |
//! | `beam.rs` | the light at points, in lanes |
//! | `table.rs` | all lights of a scene |
//! | `plain.rs` | the light of the simplest kind with the power of another one |
mod beam;
mod compiled;
pub mod directional;
mod falloff;
mod plain;
pub mod point;
pub mod projector;
mod row;
mod slide;
pub mod spot;
mod table;
#[cfg(test)]
mod tests;

use glam::{DAffine3, DVec3};

pub(super) use self::{beam::Beam, compiled::PunctualBound, row::PunctualRows};
pub use self::{
    compiled::{Picture, PunctualLight},
    table::{PunctualLights, PunctualRay},
};
use noisefall_base::declare::{Declare, Parameters, Problem, Resources};

/// Largest number of directional lights of a scene. They have no position, so they are weighted one by one beside the light tree.
pub const MOST_DIRECTIONAL: usize = 40;

noisefall_base::declare::catalogue! {
    /// A punctual light, as a scene describes it.
    pub enum PunctualLightKind: Shine, "light" {
        point::Point,
        spot::Spot,
        directional::Directional,
        projector::Projector,
    }
}

/// A kind of light.
pub trait Shine {
    /// The light after a transform. Positions, targets and directions are transformed; intensities and angles are not.
    fn compile(&self, map: &DAffine3, resources: &Resources) -> Result<PunctualLight, Problem>;

    /// The light without its files, so that it can be checked without reading them; `None` if it has none.
    fn without_files(&self) -> Option<PunctualLightKind> {
        None
    }

    /// Where the light stands before its transform; `None` if it is infinitely far away.
    fn position(&self) -> Option<DVec3>;

    /// Its points and directions after a map that does not mirror, by their keys.
    fn moved(&self, map: &DAffine3) -> Vec<(&'static str, DVec3)>;

    /// A light of this kind that stands at `position`, shines on `target`, and has about the irradiance `irradiance` there, W/m².
    fn placed(&self, position: DVec3, target: DVec3, irradiance: f64) -> PunctualLightKind;
}

/// The radiant intensity that has an irradiance over a distance, to three digits.
fn intensity(position: DVec3, target: DVec3, irradiance: f64) -> f64 {
    let exact = irradiance * position.distance_squared(target);
    format!("{exact:.2e}").parse().unwrap_or(exact)
}

impl Declare for PunctualLightKind {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.one_of(self);
    }
}
