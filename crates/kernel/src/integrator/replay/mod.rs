//! Replays one sample vertex by vertex. It is exactly the sample of the renderer, because samples are pure functions of their
//! index.
//!
//! The path is traced with one lane, and a [`Follower`] reads the queues between the stages. It computes all other terms with the
//! functions of the stages, so every term is that of the estimator, bit for bit.
mod bidirectional;
mod follower;
mod light;
mod path_reuse;
mod samples;
mod terms;
mod throughput;
mod visible;

use serde::Serialize;

use self::{bidirectional::bidirectional, follower::Follower};
pub use self::{
    bidirectional::{BidirectionalSample, PathPoint, StrategyTerm},
    samples::pixel_samples,
    terms::{EmitterHit, End, LightOutcome, Reflection, SampledLight, SharedLight, Surface, Vertex},
    visible::seen_by_camera,
};
use super::{
    batch::Batch,
    outlier_reuse::thresholds,
    slots::{SLOTS, TILE},
    trace::trace_in,
    work::Work,
};
use noisefall_base::math::{One, SimdLevel, U};
use noisefall_scene::scene::{CameraRays, Estimator, RenderSettings, Reuse, Scene};

/// A path, replayed.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Replay {
    /// The sample's estimate of the pixel's radiance.
    pub radiance: [f32; 3],
    /// The estimate by this path alone, if pixels reuse paths; with light paths, as `mis` weights it.
    pub alone: Option<[f32; 3]>,
    /// The paths that pixels share in this sample, if they do.
    pub shared: Option<SharedLight>,
    /// The bidirectional paths, if there are light paths and nothing is merged.
    pub bidirectional: Option<BidirectionalSample>,
    /// Vertices of the camera path in order. The contributions of their emission and of their light samples add up to the
    /// radiance, or to `alone` if there is one.
    pub vertices: Vec<Vertex>,
    /// Reason of the end of the path.
    pub end: End,
}

/// Replays sample number `sample` of a pixel. With light paths, the radiance lacks what other samples bring to the pixel.
pub fn replay(scene: &Scene, rays: &CameraRays, settings: &RenderSettings, pixel: [u32; 2], sample: u32) -> Replay {
    if scene.traces_light_paths(settings) {
        let from_camera = RenderSettings { estimator: Estimator::Mis, reuse: Reuse::Off, ..*settings };
        let replay = replay(scene, rays, &from_camera, pixel, sample);
        let (work, place) = work_of(scene, rays, settings, pixel, sample);
        let mut batch = Batch::default();
        let bidirectional = bidirectional(&work, &mut batch);
        return Replay { radiance: radiance_at(&batch, place), alone: Some(replay.radiance), bidirectional, ..replay };
    }
    let one = Work::tile(scene, rays, settings, pixel, [1, 1], sample);
    let work = if one.shares() { one.whole_tile() } else { one };
    let [x, y] = place_in(&work, pixel);
    let is_here = |slot: &u32| {
        let (column, row) = work.place::<One>(U(*slot));
        (column.0, row.0) == (x, y)
    };
    let slot = (0..SLOTS as u32).find(is_here).unwrap_or(0);
    let mut follower = Follower::new(slot);
    let mut batch = Batch::default();
    let finished = trace_in(One, &work, &mut batch, &|| false, &mut follower);
    debug_assert_eq!(finished, Ok(()));
    let alone = work.shares().then_some(follower.radiance);
    let end = follower.vertices.last().map_or(End::default(), |last| end_at(scene, settings, last));
    let radiance = radiance_at(&batch, [x, y]);
    let shared = follower.unshared_and_kept.map(|[unshared, kept]| {
        let from_neighbours = [0, 1, 2].map(|c| (radiance[c] - unshared[c] - kept[c]).max(0.0));
        SharedLight { unshared, kept, from_neighbours }
    });
    let mut replay = Replay { radiance, alone, shared, bidirectional: None, vertices: follower.vertices, end };
    if let Ok(Some(thresholds)) = thresholds(SimdLevel::best(), &one.whole_tile(), &mut batch, &|| false) {
        path_reuse::share(&mut replay, &thresholds, scene, rays, settings, (pixel, sample));
    }
    replay
}

/// The reason why a vertex is the last one.
fn end_at(scene: &Scene, settings: &RenderSettings, last: &Vertex) -> End {
    let (Some(object), Some(surface)) = (last.object, &last.surface) else { return End::LeftScene };
    let material = scene.material(&scene.objects[object as usize]);
    match &last.reflection {
        Some(Reflection { weight, .. }) if *weight == [0.0; 3] => End::NoWeight,
        Some(Reflection { survives: false, survival, .. }) if *survival < 1.0 => End::Roulette,
        Some(Reflection { survives: false, .. }) => End::Vanished,
        Some(_) => End::Normals,
        None if last.bounce < settings.last_bounce() => match material {
            None => End::NoMaterial,
            Some(material) if material.one_sided && !surface.front => End::BlackFromBehind,
            Some(_) => End::Black,
        },
        None if settings.max_bounces.is_some() => End::Cap,
        None => End::TooLong,
    }
}

/// The work that takes a sample of a pixel, and the pixel's column and row in it. Pixels that share need the paths of the whole tile.
fn work_of<'a>(
    scene: &'a Scene,
    rays: &'a CameraRays,
    settings: &'a RenderSettings,
    pixel: [u32; 2],
    sample: u32,
) -> (Work<'a>, [u32; 2]) {
    let one = Work::tile(scene, rays, settings, pixel, [1, 1], sample);
    let work = if scene.path_reuse(rays, settings).correlates() { one.whole_tile() } else { one };
    (work, place_in(&work, pixel))
}

/// Column and row of a pixel in its tile.
fn place_in(work: &Work, pixel: [u32; 2]) -> [u32; 2] {
    [0, 1].map(|axis| pixel[axis] - work.origin[axis])
}

/// The radiance of a pixel of a traced tile.
fn radiance_at(batch: &Batch, [x, y]: [u32; 2]) -> [f32; 3] {
    let [r, g, b, _] = batch.radiance()[(y * TILE + x) as usize];
    [r, g, b]
}
