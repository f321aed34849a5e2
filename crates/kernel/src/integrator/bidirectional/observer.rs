//! Observers of bidirectional paths, for replays.
use super::scatter::Scattered;
use crate::integrator::{interaction::SurfaceInteraction, surface::Arrival};
use noisefall_base::math::{F, Lanes, M, U, V};
use noisefall_scene::light::RaySample;

/// The end that a path starts at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::integrator) enum PathStart {
    Light,
    Camera,
}

/// Contribution of a strategy (s, t).
pub(in crate::integrator) struct Term<L: Lanes> {
    pub s: U<L>,
    pub t: u32,
    /// The estimate of the strategy alone: what arrives where `seen`, elsewhere what would arrive if nothing lay between.
    pub light: V<L>,
    /// The factor of `light` in the sample.
    pub weight: F<L>,
    /// The lanes where some light arrives.
    pub seen: M<L>,
    /// Pdf of the light sample if s = 1, per area on surfaces, per solid angle towards the environment; of lights, a probability.
    pub light_pdf: F<L>,
}

/// Observes the paths of a batch; `()` does nothing.
pub(in crate::integrator) trait Observer<L: Lanes> {
    /// Rays leave the lights.
    fn emitted(&mut self, _starts: M<L>, _ray: &RaySample<L>) {}

    /// Paths arrive at surfaces, at angles with these cosines.
    fn arrived(
        &mut self,
        _start: PathStart,
        _hit: M<L>,
        _arrival: &Arrival<L>,
        _interaction: &SurfaceInteraction<L>,
        _cos: F<L>,
    ) {
    }

    /// Camera paths leave the scene.
    fn left(&mut self, _miss: M<L>, _arrival: &Arrival<L>) {}

    /// Paths go on.
    fn scattered(&mut self, _start: PathStart, _goes_on: M<L>, _sample: &Scattered<L>) {}

    /// Strategies find light. With t = 1, [`Observer::joined`] tells what is visible.
    fn found(&mut self, _lanes: M<L>, _term: &Term<L>) {}

    /// These fractions of the light of vertices that were connected to the camera arrive at these places of the image.
    fn joined(&mut self, _fraction: F<L>, _place: [F<L>; 2]) {}
}

impl<L: Lanes> Observer<L> for () {}
