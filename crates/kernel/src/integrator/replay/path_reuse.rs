//! The sample of a pixel that reuses outliers with its neighbours.
use super::{Replay, SharedLight, radiance_at, work_of};
use crate::integrator::{batch::Batch, outliers::Thresholds, tile_sample::trace, work::Work};
use noisefall_base::math::SimdLevel;
use noisefall_scene::scene::{CameraRays, RenderSettings, Scene};

/// Completes the replay of a path by what its pixel shares.
pub fn share(
    replay: &mut Replay,
    thresholds: &Thresholds,
    scene: &Scene,
    rays: &CameraRays,
    settings: &RenderSettings,
    at: ([u32; 2], u32),
) {
    let (pixel, sample) = at;
    let (work, place) = work_of(scene, rays, settings, pixel, sample);
    let mut batch = Batch::default();
    let traced = trace(SimdLevel::best(), &Work { thresholds: Some(thresholds), ..work }, &mut batch, &|| false);
    debug_assert_eq!(traced, Ok(()));
    let (alone, whole) = (replay.alone.unwrap_or(replay.radiance), radiance_at(&batch, place));
    let (rest, suffix) = replay.shared.as_ref().map_or((alone, [0.0; 3]), |shared| (shared.unshared, shared.kept));
    let n = batch.bright.as_ref().and_then(|found| found.sharers(place));
    let unshared = if n.is_some() { [0.0; 3] } else { rest };
    let kept = [0, 1, 2].map(|c| suffix[c] + n.map_or(0.0, |n| rest[c] / n as f32));
    let from_neighbours = [0, 1, 2].map(|c| (whole[c] - unshared[c] - kept[c]).max(0.0));
    for vertex in &mut replay.vertices {
        vertex.emission.iter_mut().for_each(|emission| emission.shared |= n.is_some());
        vertex.light.iter_mut().for_each(|light| light.shared |= n.is_some());
    }
    (replay.radiance, replay.alone) = (whole, Some(alone));
    replay.shared = Some(SharedLight { unshared, kept, from_neighbours });
}
