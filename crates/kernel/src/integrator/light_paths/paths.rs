//! The data of bidirectional paths, by slot, and the queues of their stages.
use super::{
    grid::Grid,
    path_state::PathState,
    records::{CameraRay, Connection, DirectSample},
    vertices::LightVertices,
};
use crate::integrator::{queue::Queue, queues::HitQueues, slots::SLOTS};
use noisefall_base::math::{MAX_LANES, One};
use noisefall_scene::material::Stage;

/// The numbers and queues of bidirectional paths. Allocated when the first batch of them is traced.
pub struct LightPaths {
    pub light_subpath: PathState,
    pub camera_subpath: PathState,
    /// Flux of the light paths where they start, and the reciprocal of the light density there.
    pub fluxes: Vec<[f32; 4]>,
    /// Their lights, and the places there: primitives and triangles.
    pub sources: Vec<[f32; 4]>,
    pub vertices: LightVertices,
    /// The places of the vertices, if they are merged, and the vertices near those of a register.
    pub grid: Grid,
    pub near: [Vec<u32>; MAX_LANES],
    pub direct: Queue,
    pub joins: Queue,
    /// Connections and the hits at their vertices of lights, by stage of shading there.
    pub connections: Vec<(Queue, HitQueues)>,
}

impl Default for LightPaths {
    fn default() -> Self {
        LightPaths {
            light_subpath: PathState::default(),
            camera_subpath: PathState::default(),
            fluxes: vec![[0.0; 4]; SLOTS],
            sources: vec![[0.0; 4]; SLOTS],
            vertices: LightVertices::default(),
            grid: Grid::default(),
            near: Default::default(),
            direct: DirectSample::<One>::queue(SLOTS),
            joins: CameraRay::<One>::queue(SLOTS),
            connections: (0..Stage::COUNT).map(|_| (Connection::<One>::queue(SLOTS), HitQueues::default())).collect(),
        }
    }
}

impl LightPaths {
    /// Empties the queues, which an interrupted batch may have left filled.
    pub fn clear(&mut self) {
        self.direct.clear();
        self.joins.clear();
        self.connections.iter_mut().for_each(|(queue, hits)| {
            queue.clear();
            hits.clear();
        });
    }
}
