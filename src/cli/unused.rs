//! Notes on settings that a render does not use.
use noisefall_render::render::{path_reuse::resolved, threads::Threads};
use noisefall_scene::scene::{CameraRays, RenderSettings, Reuse, Scene};

use super::messages::tell;

/// Tells which settings have no effect, before the render begins. What pixels share is decided first, if a setting depends on that: a render
/// of the same scene does not decide again.
pub fn tell_unused(threads: &Threads, scene: &Scene, rays: &CameraRays, settings: &RenderSettings) {
    let is_asked = settings.adaptive || settings.merging || settings.reuse != Reuse::Auto;
    if is_asked {
        let resolved = threads.install(|| resolved(scene, rays, settings));
        scene.unused_settings(rays, settings, &resolved).iter().for_each(|note| tell(&format!("warning: {note}")));
    }
}
