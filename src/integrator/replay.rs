//! One sample again, vertex by vertex: exactly the one the renderer took, because samples are pure functions of their number.
use serde::Serialize;

use super::{
    batch::{Batch, Hit, Path},
    queue::Queue,
    trace::{Observer, trace_in},
    work::{SLOTS, TILE, Work},
};
use crate::{
    geometry::MISS,
    math::{Lanes, One, U},
    scene::{CameraRays, RenderSettings, Scene},
};

/// A path, replayed.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Replay {
    /// The sample's estimate of the pixel's radiance.
    pub radiance: [f32; 3],
    /// What the path alone would have made of it, where pixels share what their paths find.
    pub alone: Option<[f32; 3]>,
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
    let one = Work::tile(scene, rays, settings, pixel, [1, 1], sample);
    let shares = one.shares();
    // What is shared needs the paths of the whole tile.
    let work = if shares { one.whole_tile() } else { one };
    let [x, y] = [pixel[0] - work.origin[0], pixel[1] - work.origin[1]];
    let is_here = |slot: &u32| {
        let (column, row) = work.place::<One>(U(*slot));
        (column.0, row.0) == (x, y)
    };
    let slot = (0..SLOTS as u32).find(is_here).unwrap_or(0);
    let mut follower = Follower { slot, vertices: Vec::new() };
    let mut batch = Batch::default();
    let finished = trace_in(One, &work, &mut batch, &|| false, &mut follower);
    debug_assert_eq!(finished, Ok(()));
    let [r, g, b, _] = batch.radiance()[(y * TILE + x) as usize];
    let alone = shares.then(|| batch.shared.alone(&batch.shared.radiance, slot as usize));
    Replay { radiance: [r, g, b], alone, vertices: follower.vertices }
}

/// Writes down the path of one slot.
struct Follower {
    slot: u32,
    vertices: Vec<Vertex>,
}

impl Follower {
    /// Where the slot is in a queue, if it is there.
    fn find(&self, queue: &Queue, slot: impl Fn(usize) -> U<One>) -> Option<usize> {
        (0..queue.len()).find(|at| slot(*at).0 % SLOTS as u32 == self.slot)
    }
}

impl Observer for Follower {
    fn at_surfaces(&mut self, work: &Work, batch: &Batch) {
        let paths = batch.current();
        let Some(at) = self.find(paths, |at| Path::read(One, paths, at).slot) else { return };
        let path = Path::read(One, paths, at);
        let primitive = Some(One.load(&batch.primitive[at..]).bits().0).filter(|id| *id != MISS);
        let object = primitive.map(|id| work.scene.owners[id as usize]);
        let normal = |hits: &Queue| {
            let at = self.find(hits, |at| Hit::read(One, hits, at).slot)?;
            Some(Hit::read(One, hits, at).n.lane(0))
        };
        let slot = self.slot as usize;
        let [r, g, b, _] = batch.radiance[slot];
        // Beyond that the albedo of the first surface is left out of what is shared only.
        let shared = work.shares() && (batch.bounce == 1 || path.slot.0 as usize >= SLOTS);
        self.vertices.push(Vertex {
            bounce: batch.bounce,
            origin: path.o.lane(0),
            direction: path.d.lane(0),
            throughput: if shared { batch.shared.weighted(slot, path.throughput.lane(0)) } else { path.throughput.lane(0) },
            distance: object.map(|_| batch.t[at]),
            object,
            normal: batch.hits.iter().find_map(normal),
            radiance: if work.shares() { batch.shared.alone(&batch.radiance, slot) } else { [r, g, b] },
        });
    }
}
