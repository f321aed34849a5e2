//! The queues of one thread, which hold the paths of a batch between stages.
use super::{
    queue::Queue,
    records::{Detail, Hit, Inside, Path, PreviousLobe, PreviousVertex, Shadow},
    shared::Shared,
    slots::SLOTS,
};
use crate::{
    material::Stage,
    math::{F, Lanes, M, MAX_LANES, One, U, V},
};

/// The queues of a thread. Allocated once, reused for every tile.
pub struct Batch {
    /// Paths of this bounce and of the next, alternating.
    pub(super) paths: [Queue; 2],
    /// Stored beside `paths` if lights are sampled.
    pub(super) previous_vertices: [Queue; 2],
    /// Stored beside `previous_vertices` in scenes with conductors and several lights.
    pub(super) previous_lobes: [Queue; 2],
    /// A queue for every type of BSDF.
    pub(super) hits: [Queue; Stage::COUNT],
    /// Stored beside `hits` for types that read it.
    pub(super) details: [Queue; Stage::COUNT],
    pub(super) shadows: Queue,
    /// Stored beside `paths` and `shadows` in scenes with media.
    pub(super) path_media: [Queue; 2],
    pub(super) shadow_media: Queue,
    /// Distance and primitive id of the first surface of every path of this bounce.
    pub(super) t: Vec<f32>,
    pub(super) primitive: Vec<f32>,
    /// The triangle in scenes with meshes.
    pub(super) element: Vec<f32>,
    /// Radiance so far, per slot; then radiance to be shared, per slot.
    pub(super) radiance: Vec<[f32; 4]>,
    pub(super) shared: Shared,
    pub(super) bounce: u32,
    /// Rays traced: path segments, shadow rays and visibility rays of path reuse.
    pub rays: u64,
    /// Paths cut at [`crate::scene::RenderSettings::last_bounce`] in the absence of a cap.
    pub cut_paths: u64,
}

impl Default for Batch {
    fn default() -> Self {
        Batch {
            paths: [Path::<One>::queue(SLOTS), Path::<One>::queue(SLOTS)],
            previous_vertices: [PreviousVertex::<One>::queue(SLOTS), PreviousVertex::<One>::queue(SLOTS)],
            previous_lobes: [PreviousLobe::<One>::queue(SLOTS), PreviousLobe::<One>::queue(SLOTS)],
            hits: std::array::from_fn(|_| Hit::<One>::queue(SLOTS)),
            details: std::array::from_fn(|_| Detail::<One>::queue(SLOTS)),
            shadows: Shadow::<One>::queue(SLOTS),
            path_media: [Inside::<One>::queue(SLOTS), Inside::<One>::queue(SLOTS)],
            shadow_media: Inside::<One>::queue(SLOTS),
            t: vec![0.0; SLOTS + MAX_LANES],
            primitive: vec![0.0; SLOTS + MAX_LANES],
            element: vec![0.0; SLOTS + MAX_LANES],
            radiance: vec![[0.0; 4]; 2 * SLOTS],
            shared: Shared::default(),
            bounce: 0,
            rays: 0,
            cut_paths: 0,
        }
    }
}

impl Batch {
    /// The radiance of every pixel after a trace: of a tile, at row · [`super::TILE`] + column, or of [`super::Blocks`], block by
    /// block, at row · [`super::BLOCK`] + column of the block.
    pub fn radiance(&self) -> &[[f32; 4]] {
        &self.radiance[..SLOTS]
    }

    pub(super) fn current(&self) -> &Queue {
        &self.paths[(self.bounce & 1) as usize]
    }
}

/// Adds light to the slots of the lanes in `mask`.
#[inline(always)]
pub(super) fn add<L: Lanes>(radiance: &mut [[f32; 4]], mask: M<L>, slot: U<L>, light: V<L>) {
    let slot = slot.to_array();
    let [x, y, z] = [light.x, light.y, light.z].map(F::to_array);
    let mut lanes = mask.bits();
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize % MAX_LANES;
        lanes &= lanes - 1;
        let sum = &mut radiance[slot[lane] as usize];
        sum[0] += x[lane];
        sum[1] += y[lane];
        sum[2] += z[lane];
    }
}
