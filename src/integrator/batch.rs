//! What one thread works on: the samples of one tile at one sample index, and the queues they travel through.
use super::{
    queue::Queue,
    reuse::{self, Shared},
};
use crate::{
    math::{F, Lanes, M, MAX_LANES, One, U, V},
    record,
    sampling::{Dimension, Stream},
    scene::{CameraRays, Estimator, RenderSettings, Scene, surface::Stage},
};

/// A tile is at most this many pixels wide and high; its pixels are the slots of a batch, in the order of [`Work::place`].
pub const TILE: u32 = 32;
pub(super) const SLOTS: usize = (TILE * TILE) as usize;

record! {
    /// A path on its way to the next surface.
    Path {
        o: V,
        /// Unit.
        d: V,
        /// Product of f cos/p and of the roulette's weights so far.
        throughput: V,
        slot: U,
    }
}

record! {
    /// Where a path comes from, for the weight of a light that it runs into: see [`super::weight`].
    Past {
        /// Shading normal on the viewer's side.
        n: V,
        /// Density of the path's direction, per solid angle.
        pdf: F,
        flags: U,
    }
}

/// Flag of [`Past`]: no light sample could have had the direction.
pub(super) const DELTA: u32 = 1;
/// Flag of [`Past`]: light was looked for on both sides of the surface.
pub(super) const TRANSMITS: u32 = 2;

record! {
    /// The media that a path is in, innermost in the lowest byte. Kept beside paths and light samples in scenes with media.
    Inside {
        media: U,
    }
}

record! {
    /// A path at a surface that reflects.
    Hit {
        /// Where the next ray starts: the surface point, moved off the surface by its error.
        p: V,
        /// Unit geometric normal on the side the path arrived from.
        n: V,
        /// Albedo or reflectance.
        colour: V,
        throughput: V,
        slot: U,
    }
}

record! {
    /// What shading needs to know besides where a surface is more than diffuse.
    Detail {
        /// Unit, towards the viewer.
        wo: V,
        /// Unit shading normal on the side the path arrived from.
        n: V,
        alpha: F,
        /// How far [`Hit::p`] was moved.
        error: F,
        /// Word of the surface (see [`crate::scene::surface`]), with its flag `FRONT` where the path arrived at the front.
        surface: U,
        /// Media on the side the path arrived from, and the one inside the surface.
        media: U,
        medium: U,
    }
}

record! {
    /// A light sample that is seen if the first surface along its ray is the target.
    Shadow {
        o: V,
        d: V,
        /// What it adds to its pixel then.
        radiance: V,
        target: U,
        slot: U,
    }
}

/// What a batch computes: sample number `sample` of the pixels of one tile.
#[derive(Clone, Copy)]
pub struct Work<'a> {
    pub scene: &'a Scene,
    pub rays: &'a CameraRays,
    pub settings: &'a RenderSettings,
    /// Pixel coordinates of the tile's upper left corner.
    pub origin: [u32; 2],
    /// Width and height of the tile, at most [`TILE`].
    pub size: [u32; 2],
    pub sample: u32,
}

impl Work<'_> {
    /// The pixels of slots, packed as the sampler wants them: y·2¹⁶ + x.
    #[inline(always)]
    pub(super) fn pixel<L: Lanes>(&self, slot: U<L>) -> U<L> {
        let (x, y) = self.place(slot);
        ((y + self.origin[1]) << 16) + (x + self.origin[0])
    }

    /// The same sample of all pixels of the tile that this begins in.
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
            return reuse::place(slot, self.sample);
        }
        (slot & (TILE - 1), slot >> TILE.trailing_zeros())
    }

    /// Whether pixels share what their paths find.
    #[inline(always)]
    pub(super) fn shares(&self) -> bool {
        self.scene.shares(self.rays, self.settings)
    }

    /// Whether media tint what passes through them.
    #[inline(always)]
    pub(super) fn has_media(&self) -> bool {
        !self.scene.surfaces.media.is_empty()
    }

    /// When the samples of slots are taken, from 0 when the shutter opens to 1 when it closes; 0 where nothing moves.
    #[inline(always)]
    pub(super) fn time<L: Lanes>(&self, l: L, slot: U<L>) -> F<L> {
        if !self.rays.take_time {
            return l.f(0.0);
        }
        Stream::new(self.settings.sampler, self.settings.seed, self.pixel(slot), self.sample).one(Dimension::TIME)
    }

    /// Whether light is looked for besides being run into.
    #[inline(always)]
    pub(super) fn samples_lights(&self) -> bool {
        self.settings.estimator != Estimator::Path && !self.scene.lights.is_empty()
    }
}

/// The queues of a thread. Made once, used for every tile.
pub struct Batch {
    /// Paths of this bounce and of the next, in turn.
    pub(super) paths: [Queue; 2],
    /// Kept beside `paths` when lights are sampled.
    pub(super) pasts: [Queue; 2],
    /// A queue for every kind of bsdf.
    pub(super) hits: [Queue; Stage::COUNT],
    /// Kept beside `hits` for kinds that read it.
    pub(super) details: [Queue; Stage::COUNT],
    pub(super) shadows: Queue,
    /// Kept beside `paths` and `shadows` in scenes with media.
    pub(super) path_media: [Queue; 2],
    pub(super) shadow_media: Queue,
    /// Distance and primitive id of the first surface of every path of this bounce.
    pub(super) t: Vec<f32>,
    pub(super) primitive: Vec<f32>,
    /// The triangle in scenes with meshes.
    pub(super) element: Vec<f32>,
    /// Radiance gathered so far, a slot; then what paths found that is to be shared.
    pub(super) radiance: Vec<[f32; 4]>,
    pub(super) shared: Shared,
    pub(super) bounce: u32,
    /// Rays traced: path segments and shadow rays.
    pub rays: u64,
    /// Paths cut at [`RenderSettings::last_bounce`] without a cap that says so.
    pub cut_paths: u64,
}

impl Default for Batch {
    fn default() -> Self {
        Batch {
            paths: [Path::<One>::queue(SLOTS), Path::<One>::queue(SLOTS)],
            pasts: [Past::<One>::queue(SLOTS), Past::<One>::queue(SLOTS)],
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
    /// The radiance of every pixel of the tile after a trace, at row · [`TILE`] + column.
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
