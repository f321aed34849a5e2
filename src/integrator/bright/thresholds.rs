//! The radiance above which the samples of the pixels of a tile are bright.
use crate::{
    integrator::{
        batch::Batch,
        interrupted::Interrupted,
        slots::{BLOCK, BLOCKS, TILE},
        trace::trace_alone,
        work::Work,
    },
    math::SimdLevel,
    sampling::Sampler,
    scene::{RenderSettings, Reuse},
};

/// Bright samples are this many times as bright as is typical around their pixel. Twice as much and half as much are less efficient where
/// it was tried (`benches/LOG.md`).
const FACTOR: f32 = 8.0;
/// Changes the seed of the pilot, whose samples are thrown away.
const SEED: u32 = 0x5be0_cd19;
/// The brightest part of the samples of a block, which does not count as typical.
const OUTLIERS: f64 = 0.05;
/// What is typical of a block is at least this part of what is typical of the tile.
const LEAST: f32 = 0.1;

/// Thresholds of r + g + b, for each pixel of a tile. They come from a pilot with a seed of its own, so they depend on no sample of the image.
pub struct Thresholds(Vec<f32>);

impl Thresholds {
    /// Those of the tile of `work`.
    pub fn of(level: SimdLevel, work: &Work, batch: &mut Batch, interrupted: &dyn Fn() -> bool) -> Result<Self, Interrupted> {
        let settings = RenderSettings {
            sampler: Sampler::Independent,
            seed: work.settings.seed ^ SEED,
            reuse: Reuse::Off,
            ..*work.settings
        };
        let pilot = Work { settings: &settings, sample: 0, thresholds: None, ..*work };
        trace_alone(level, &pilot, batch, interrupted)?;
        let [width, height] = work.size;
        let at = |x: u32, y: u32| brightness(&batch.radiance()[(y * TILE + x) as usize]).unwrap_or(0.0);
        let places = || (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let mut blocks: [Vec<f32>; BLOCKS] = Default::default();
        places().for_each(|(x, y)| blocks[block_of([x, y])].push(at(x, y)));
        let least = LEAST * typical(blocks.concat());
        let blocks = blocks.map(|block| typical(block).max(least));
        let mut thresholds = vec![0.0; (height * TILE) as usize];
        for (x, y) in places() {
            let [columns, rows] = [(x, width), (y, height)].map(|(x, end)| x.saturating_sub(1)..end.min(x + 2));
            let around = rows.flat_map(|y| columns.clone().map(move |x| at(x, y))).collect();
            thresholds[(y * TILE + x) as usize] = FACTOR * blocks[block_of([x, y])].max(median(around));
        }
        Ok(Thresholds(thresholds))
    }

    /// The same for all pixels.
    #[cfg(test)]
    pub fn uniform(threshold: f32) -> Self {
        Thresholds(vec![threshold; (TILE * TILE) as usize])
    }

    /// The threshold of a pixel, given by its column and row in the tile.
    pub fn at(&self, [x, y]: [u32; 2]) -> f32 {
        self.0[(y * TILE + x) as usize]
    }
}

fn block_of([x, y]: [u32; 2]) -> usize {
    (y / BLOCK * (TILE / BLOCK) + x / BLOCK) as usize
}

/// r + g + b of a valid sample.
pub fn brightness([r, g, b, _]: &[f32; 4]) -> Option<f32> {
    let is_valid = [r, g, b].iter().all(|x| x.is_finite() && **x >= 0.0);
    let sum = r + g + b;
    (is_valid && sum.is_finite()).then_some(sum)
}

/// The mean of all samples but the brightest.
fn typical(mut samples: Vec<f32>) -> f32 {
    samples.sort_unstable_by(f32::total_cmp);
    let kept = &samples[..samples.len() - (samples.len() as f64 * OUTLIERS) as usize];
    if kept.is_empty() { 0.0 } else { kept.iter().sum::<f32>() / kept.len() as f32 }
}

fn median(mut samples: Vec<f32>) -> f32 {
    samples.sort_unstable_by(f32::total_cmp);
    samples[samples.len() / 2]
}
