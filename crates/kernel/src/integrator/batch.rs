//! The queues of one thread, which hold the paths of a batch between stages.
use super::{
    crossings::Crossings,
    first_hits::FirstHits,
    light_paths::{paths::LightPaths, splat::Splat},
    outliers::OutlierBuffers,
    queues::{HitQueues, PathQueues, ShadowQueues},
    shared::Shared,
    slots::SLOTS,
};
use noisefall_base::math::{Lanes, M, MAX_LANES, U, V};
use noisefall_scene::material::Stage;

/// The queues of a thread. Allocated once, reused for every tile.
pub struct Batch {
    /// Paths of this bounce and of the next, alternating.
    pub(super) paths: [PathQueues; 2],
    /// The first surface of every path of this bounce.
    pub(super) first_hits: FirstHits,
    /// By stage of shading.
    pub(super) hits: [HitQueues; Stage::COUNT],
    pub(super) shadows: ShadowQueues,
    /// Radiance so far, per slot; then radiance to be shared, per slot.
    pub(super) radiance: Vec<[f32; 4]>,
    pub(super) shared: Shared,
    /// Used where crossings count as bounces.
    pub(super) crossings: Crossings,
    pub(super) bounce: u32,
    /// Rays traced: path segments, shadow rays and visibility rays of path reuse.
    pub rays: u64,
    /// Light that the light paths bring to any pixel, after a trace with such paths.
    pub splats: Vec<Splat>,
    /// Queues of bidirectional paths, after the first trace with such paths.
    pub(super) light_paths: Option<Box<LightPaths>>,
    /// Buffers of outlier reuse, after the first trace with it.
    pub(super) bright: Option<Box<OutlierBuffers>>,
    /// Paths cut at [`noisefall_scene::scene::RenderSettings::last_bounce`] in the absence of a cap.
    pub cut_paths: u64,
}

impl Default for Batch {
    fn default() -> Self {
        Batch {
            paths: Default::default(),
            first_hits: FirstHits::default(),
            hits: Default::default(),
            shadows: ShadowQueues::default(),
            radiance: vec![[0.0; 4]; 2 * SLOTS],
            shared: Shared::default(),
            crossings: Crossings::default(),
            bounce: 0,
            rays: 0,
            splats: Vec::new(),
            light_paths: None,
            bright: None,
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

    /// The paths of this bounce.
    pub(super) fn current(&self) -> &PathQueues {
        &self.paths[(self.bounce & 1) as usize]
    }
}

/// Adds light to the slots of the lanes in `mask`.
#[inline(always)]
pub(super) fn add<L: Lanes>(radiance: &mut [[f32; 4]], mask: M<L>, slot: U<L>, light: V<L>) {
    let slot = slot.to_array();
    let (x, y, z) = (light.x.to_array(), light.y.to_array(), light.z.to_array());
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
