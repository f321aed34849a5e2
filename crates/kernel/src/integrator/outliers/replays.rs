//! Samples of some pixels with the random numbers of others.
use crate::integrator::slots::SLOTS;
use noisefall_base::math::{Lanes, Pick, U};

/// Up to as many pixels as a tile has, each with the pixel whose random numbers it takes.
pub struct Replays {
    /// Bits of a row: pixel and source of the random numbers, both as y·2¹⁶ + x.
    rows: Vec<[f32; 4]>,
    count: usize,
}

impl Default for Replays {
    fn default() -> Self {
        Replays { rows: vec![[0.0; 4]; SLOTS], count: 0 }
    }
}

impl Replays {
    /// Forgets all pixels.
    pub fn clear(&mut self) {
        self.count = 0;
    }

    /// Adds a pixel, and the pixel whose random numbers it takes.
    pub fn push(&mut self, pixel: [u32; 2], source: [u32; 2]) {
        let packed = |[x, y]: [u32; 2]| f32::from_bits((y << 16) + x);
        self.rows[self.count] = [packed(pixel), packed(source), 0.0, 0.0];
        self.count += 1;
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Number of pixels.
    pub fn len(&self) -> usize {
        self.count
    }

    /// The pixels of slots, and those whose random numbers they take. Slots past the end have pixels outside of any image.
    #[inline(always)]
    pub fn at<L: Lanes>(&self, l: L, slot: U<L>) -> [U<L>; 2] {
        let slot = slot & (SLOTS as u32 - 1);
        let [pixel, source, ..] = l.rows(&self.rows, slot);
        let is_filled = slot.below(self.count as u32);
        [is_filled.pick(pixel.bits(), l.u(u32::MAX)), source.bits()]
    }
}
