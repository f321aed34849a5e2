//! Light paths, which bounces and paths of pixels do not show.
use noisefall_scene::scene::{RenderSettings, Scene};

/// Whether the render takes light paths, too. Instruments then show the camera paths, as MIS weights them.
pub fn are_traced(scene: &Scene, settings: &RenderSettings) -> bool {
    let in_force = scene.estimator_in_force(settings).map_or(settings.estimator, |in_force| in_force.estimator);
    in_force.traces_light_paths()
}
