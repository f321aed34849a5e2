//! The work of a batch: one sample of each pixel of a tile, or of some blocks of pixels.
use fearless_simd_macros::simd;

use super::Stream;
use super::{
    outliers::{Replays, Thresholds},
    slots::{BLOCK, BLOCKS, SLOTS, TILE, place_in_groups},
};
use noisefall_base::math::{F, Lanes, M, U};
use noisefall_scene::{
    sampling::Dimension,
    scene::{CameraRays, RenderSettings, Scene},
};

/// The work of a batch: sample index `sample` of the pixels of one tile, or a sample of the pixels of some blocks.
#[derive(Clone, Copy)]
pub struct Work<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The rays of the camera.
    pub rays: &'a CameraRays,
    /// How it is rendered.
    pub settings: &'a RenderSettings,
    /// Pixel coordinates of the tile's upper left corner.
    pub origin: [u32; 2],
    /// Width and height of the tile, at most [`TILE`].
    pub size: [u32; 2],
    /// Index of the sample.
    pub sample: u32,
    /// Blocks of the tile to compute instead of the whole tile. Always `None` with path reuse, which needs whole tiles.
    pub blocks: Option<&'a Blocks>,
    /// Pixels of the tile to compute instead of the whole tile, with the random numbers of others.
    pub replays: Option<&'a Replays>,
    /// Above these, samples are shared between pixels; `None` if they are not.
    pub thresholds: Option<&'a Thresholds>,
}

/// Up to [`BLOCKS`] blocks, each with its own sample index.
#[derive(Default)]
pub struct Blocks {
    /// Bits of a row: the pixel in the upper left corner, y·2¹⁶ + x, and the sample index.
    rows: [[f32; 4]; BLOCKS],
    count: usize,
}

impl Blocks {
    /// Adds the block whose upper left corner is at this pixel.
    pub fn push(&mut self, [x, y]: [u32; 2], sample: u32) {
        self.rows[self.count] = [(y << 16) + x, sample, 0, 0].map(f32::from_bits);
        self.count += 1;
    }
}

impl Blocks {
    /// Whether there is no room for another block.
    pub fn is_full(&self) -> bool {
        self.count == BLOCKS
    }

    /// Corners and sample indices of the blocks.
    pub fn iter(&self) -> impl Iterator<Item = ([u32; 2], u32)> {
        self.rows[..self.count].iter().map(|[corner, sample, ..]| {
            let corner = corner.to_bits();
            ([corner & 0xffff, corner >> 16], sample.to_bits())
        })
    }
}

impl<'a> Work<'a> {
    /// The work of a sample of a whole tile.
    pub fn tile(
        scene: &'a Scene,
        rays: &'a CameraRays,
        settings: &'a RenderSettings,
        origin: [u32; 2],
        size: [u32; 2],
        sample: u32,
    ) -> Self {
        Work { scene, rays, settings, origin, size, sample, blocks: None, replays: None, thresholds: None }
    }

    /// The tile or its blocks: corners, width and height, and sample indices.
    pub fn parts(&self) -> Vec<([u32; 2], [u32; 2], u32)> {
        let Some(blocks) = self.blocks else { return vec![(self.origin, self.size, self.sample)] };
        let end = [0, 1].map(|axis| self.origin[axis] + self.size[axis]);
        let size = |corner: [u32; 2]| [0, 1].map(|axis| BLOCK.min(end[axis] - corner[axis]));
        blocks.iter().map(|(corner, sample)| (corner, size(corner), sample)).collect()
    }

    /// Number of slots to fill.
    pub(super) fn slots(&self) -> u32 {
        match (self.blocks, self.replays) {
            (Some(blocks), _) => blocks.count as u32 * BLOCK * BLOCK,
            (None, Some(replays)) => replays.len() as u32,
            (None, None) if self.shares() => SLOTS as u32,
            (None, None) => self.size[1] * TILE,
        }
    }

    /// The pixels of slots in the format of the sampler: y·2¹⁶ + x.
    #[inline(always)]
    pub(super) fn pixel<L: Lanes>(&self, l: L, slot: U<L>) -> U<L> {
        if let Some(blocks) = self.blocks {
            let [corner, _] = blocks.rows(l, slot);
            return corner + in_block(slot);
        }
        if let Some(replays) = self.replays {
            return replays.at(l, slot)[0];
        }
        let (x, y) = self.place(slot);
        ((y + self.origin[1]) << 16) + (x + self.origin[0])
    }

    /// The slots whose `pixel` lies inside the tile.
    #[inline(always)]
    pub(super) fn inside<L: Lanes>(&self, pixel: U<L>) -> M<L> {
        let ([left, top], [width, height]) = (self.origin, self.size);
        (pixel & 0xffff).below(left + width) & (pixel >> 16).below(top + height)
    }

    /// The random numbers of slots.
    #[inline(always)]
    pub(super) fn stream<L: Lanes>(&self, l: L, slot: U<L>) -> Stream<L> {
        let RenderSettings { sampler, seed, .. } = *self.settings;
        if let Some(blocks) = self.blocks {
            let [corner, sample] = blocks.rows(l, slot);
            return Stream::new(sampler, seed, corner + in_block(slot), sample);
        }
        let pixel = self.replays.map_or_else(|| self.pixel(l, slot), |replays| replays.at(l, slot)[1]);
        Stream::new(sampler, seed, pixel, l.u(self.sample))
    }

    /// Returns the work of this sample for all pixels of the tile in which it begins.
    pub(super) fn whole_tile(self) -> Self {
        let origin = self.origin.map(|x| x / TILE * TILE);
        let size = [0, 1].map(|axis| TILE.min(self.rays.resolution[axis] - origin[axis]));
        Work { origin, size, ..self }
    }

    /// Column and row of slots within their tile.
    #[inline(always)]
    pub(super) fn place<L: Lanes>(&self, slot: U<L>) -> (U<L>, U<L>) {
        let slot = slot & (SLOTS as u32 - 1);
        if self.shares() {
            return place_in_groups(slot, self.sample);
        }
        (slot & (TILE - 1), slot >> TILE.trailing_zeros())
    }

    /// Whether pixels reuse path suffixes.
    #[inline(always)]
    pub(super) fn shares(&self) -> bool {
        self.scene.shares(self.rays, self.settings)
    }

    /// Number of light paths for every sample of a pixel.
    pub(super) fn light_paths_of_image(&self) -> f32 {
        let [width, height] = self.rays.resolution;
        width as f32 * height as f32
    }

    /// Whether there are absorbing media.
    #[inline(always)]
    pub(super) fn has_media(&self) -> bool {
        !self.scene.surfaces.media.is_empty()
    }

    /// The times of the samples of slots, from 0 to 1; 0 if nothing moves.
    #[inline(always)]
    pub(super) fn time<L: Lanes>(&self, l: L, slot: U<L>) -> F<L> {
        if !self.rays.take_time() {
            return self.rays.moment(l);
        }
        self.sampled_time(l, slot)
    }

    /// The times of the samples of slots if something moves.
    #[simd]
    fn sampled_time<L: Lanes>(&self, l: L, slot: U<L>) -> F<L> {
        self.rays.time(l, self.stream(l, slot).one(Dimension::TIME))
    }

    /// Whether light samples depend on lobes; emitter hits then need them for their pdf.
    #[inline(always)]
    pub(super) fn weights_lights_by_lobe(&self) -> bool {
        self.settings.estimator.compares() && self.scene.weights_lights_by_lobe()
    }

    /// Whether surfaces sample a light. Punctual lights are sampled by all estimators, because no ray can hit them.
    #[inline(always)]
    pub(super) fn samples_lights(&self) -> bool {
        let lights = &self.scene.lights;
        (self.settings.estimator.samples_lights() && !lights.is_empty()) || !lights.punctual_lights.is_empty()
    }

    /// Whether emitter hits are weighted, because light samples could have found the same light.
    #[inline(always)]
    pub(super) fn weights_hits(&self) -> bool {
        self.settings.estimator.samples_lights() && self.scene.lights.can_be_hit()
    }
}

impl Blocks {
    /// Corners and sample indices of the blocks of slots.
    #[inline(always)]
    fn rows<L: Lanes>(&self, l: L, slot: U<L>) -> [U<L>; 2] {
        // Lanes past the end hold stale values.
        let block = (slot >> (2 * BLOCK.trailing_zeros())) & (BLOCKS as u32 - 1);
        let [corner, sample, _, _] = l.rows(&self.rows, block);
        [corner.bits(), sample.bits()]
    }
}

/// Row and column of slots within their block, packed like pixels.
#[inline(always)]
fn in_block<L: Lanes>(slot: U<L>) -> U<L> {
    const BITS: u32 = BLOCK.trailing_zeros();
    ((slot & ((BLOCK - 1) << BITS)) << (16 - BITS)) + (slot & (BLOCK - 1))
}
