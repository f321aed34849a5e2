//! The plan of a study: lists of settings to combine, and the limits of each run.
use std::time::Duration;

use noisefall_kernel::measure::Floor;
use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::{Estimator, RenderSettings, Reuse, Roulette},
};

/// Default length of the longer side of an image, pixels.
const LONGER_SIDE: u32 = 256;

/// The values of each setting, which are all combined. An empty list stands for the scene's value.
#[derive(Clone, Debug, Default)]
pub struct Lists {
    /// Estimators.
    pub estimators: Vec<Estimator>,
    /// Direction samplings.
    pub directions: Vec<Directions>,
    /// Samplers.
    pub samplers: Vec<Sampler>,
    /// Russian roulettes.
    pub roulettes: Vec<Roulette>,
    /// Bounce caps; `None` is no cap.
    pub caps: Vec<Option<u32>>,
    /// Path reuse.
    pub reuses: Vec<Reuse>,
    /// Adaptive sampling.
    pub adaptive: Vec<bool>,
}

/// Settings and limits of the runs.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The settings to combine.
    pub lists: Lists,
    /// The largest number of samples per pixel.
    pub spp: u32,
    /// Longest rendering time of a run. A doubling of the samples that would end later is not begun.
    pub time: Duration,
    /// Runs of each combination, with different seeds.
    pub repeats: u32,
    /// Floor of relMSE.
    pub floor: Floor,
}

impl Lists {
    /// All different combinations.
    pub fn combinations(&self, base: RenderSettings) -> Vec<RenderSettings> {
        let mut all = vec![base];
        combine(&mut all, &self.estimators, |estimator, of| RenderSettings { estimator, ..of });
        combine(&mut all, &self.directions, |directions, of| RenderSettings { directions, ..of });
        combine(&mut all, &self.samplers, |sampler, of| RenderSettings { sampler, ..of });
        combine(&mut all, &self.roulettes, |roulette, of| RenderSettings { roulette, ..of });
        combine(&mut all, &self.caps, |max_bounces, of| RenderSettings { max_bounces, ..of });
        combine(&mut all, &self.reuses, |reuse, of| RenderSettings { reuse, ..of });
        combine(&mut all, &self.adaptive, |adaptive, of| RenderSettings { adaptive, ..of });
        all
    }
}

/// Combines all settings with all values, without duplicates.
fn combine<V: Copy>(all: &mut Vec<RenderSettings>, values: &[V], with: impl Fn(V, RenderSettings) -> RenderSettings) {
    if values.is_empty() {
        return;
    }
    let mut combined = Vec::new();
    for settings in std::mem::take(all) {
        for value in values {
            let settings = with(*value, settings);
            if !combined.contains(&settings) {
                combined.push(settings);
            }
        }
    }
    *all = combined;
}

/// Sample counts at which the error is measured: powers of two, and `spp` itself.
pub fn checkpoints(spp: u32) -> Vec<u32> {
    let powers = (0..u32::BITS).map(|power| 1 << power).take_while(|n| *n < spp);
    powers.chain([spp]).collect()
}

/// A resolution of the same aspect ratio, scaled down to the default size of a study.
pub fn study_size(resolution: [u32; 2]) -> [u32; 2] {
    let longer = resolution[0].max(resolution[1]);
    let scaled = |side: u32| (u64::from(side) * u64::from(LONGER_SIDE) + u64::from(longer) / 2) / u64::from(longer);
    if longer <= LONGER_SIDE { resolution } else { resolution.map(|side| scaled(side).max(1) as u32) }
}
