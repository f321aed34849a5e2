//! The outliers of a tile.
use super::replays::Replays;

/// Buffers of outlier reuse beside the queues of a batch. Allocated by the first trace that shares.
#[derive(Default)]
pub struct OutlierBuffers {
    pub samples: Vec<Outlier>,
    pub replays: Replays,
    /// The radiance of the tile, while the batch traces replays.
    pub radiance: Vec<[f32; 4]>,
}

/// A outlier of a pixel.
#[derive(Clone, Copy)]
pub struct Outlier {
    /// The pixel, by column and row in the tile.
    pub place: [u32; 2],
    pub radiance: [f32; 4],
    /// Number of pixels that share it.
    pub n: u32,
}

impl OutlierBuffers {
    /// The number of pixels that share the sample of a pixel; `None` if it is not bright.
    pub fn sharers(&self, place: [u32; 2]) -> Option<u32> {
        self.samples.iter().find(|sample| sample.place == place).map(|sample| sample.n)
    }
}
