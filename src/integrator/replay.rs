//! One sample again, vertex by vertex: exactly the one the renderer took, because samples are pure functions of their number.
use serde::Serialize;

use super::{
    batch::{Batch, Hit, Path, Work},
    trace::{Observer, trace_in},
};
use crate::{
    geometry::MISS,
    math::{Lanes, One},
    scene::{CameraRays, RenderSettings, Scene},
};

/// A path, replayed.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Replay {
    /// The sample's estimate of the pixel's radiance.
    pub radiance: [f32; 3],
    pub vertices: Vec<Vertex>,
}

/// One segment of a path and the surface at its end.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Vertex {
    pub bounce: u32,
    pub origin: [f32; 3],
    pub direction: [f32; 3],
    /// Product of f cos/p and roulette weights up to this segment.
    pub throughput: [f32; 3],
    /// Distance along the direction; absent when the path leaves the scene.
    pub distance: Option<f32>,
    /// Number of the object met.
    pub object: Option<u32>,
    /// Normal on the path's side, when the surface reflects.
    pub normal: Option<[f32; 3]>,
    /// The sum of radiance after this vertex.
    pub radiance: [f32; 3],
}

/// Replays sample number `sample` of a pixel.
pub fn replay(scene: &Scene, rays: &CameraRays, settings: &RenderSettings, pixel: [u32; 2], sample: u32) -> Replay {
    let work = Work { scene, rays, settings, origin: pixel, size: [1, 1], sample };
    let mut batch = Batch::default();
    let mut replay = Replay::default();
    let finished = trace_in(One, &work, &mut batch, &|| false, &mut replay);
    debug_assert_eq!(finished, Ok(()));
    let [r, g, b, _] = batch.radiance()[0];
    replay.radiance = [r, g, b];
    replay
}

impl Observer for Replay {
    fn at_surfaces(&mut self, work: &Work, batch: &Batch) {
        let path = Path::read(One, batch.current(), 0);
        let primitive = Some(One.load(&batch.primitive).bits().0).filter(|id| *id != MISS);
        let object = primitive.map(|id| work.scene.owners[id as usize]);
        let [r, g, b, _] = batch.radiance[0];
        self.vertices.push(Vertex {
            bounce: batch.bounce,
            origin: path.o.lane(0),
            direction: path.d.lane(0),
            throughput: path.throughput.lane(0),
            distance: object.map(|_| batch.t[0]),
            object,
            normal: batch.hits.iter().find(|hits| !hits.is_empty()).map(|hits| Hit::read(One, hits, 0).n.lane(0)),
            radiance: [r, g, b],
        });
    }
}
