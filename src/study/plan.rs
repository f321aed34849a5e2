//! What is measured: settings that are combined with each other, and how far each combination is taken.
use std::time::Duration;

use crate::{
    measure::Floor,
    sampling::{Directions, Sampler},
    scene::{Estimator, RenderSettings, Reuse, Roulette},
};

/// The longer side of a picture, in pixels, where nobody says how large it should be.
const LONGER_SIDE: u32 = 256;

/// The values of each setting, all of which are combined. Of an empty list what the scene opens with is taken.
#[derive(Clone, Debug, Default)]
pub struct Lists {
    /// Estimators.
    pub estimators: Vec<Estimator>,
    /// Samplings of directions.
    pub directions: Vec<Directions>,
    /// Samplers.
    pub samplers: Vec<Sampler>,
    /// Kinds of Russian roulette.
    pub roulettes: Vec<Roulette>,
    /// `None` is no cap.
    pub caps: Vec<Option<u32>>,
    /// Path reuse.
    pub reuses: Vec<Reuse>,
    /// Adaptive sampling.
    pub adaptive: Vec<bool>,
}

/// How far each combination is taken.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The settings, all of which are combined.
    pub lists: Lists,
    /// The largest number of samples a pixel.
    pub spp: u32,
    /// A doubling of the samples is not begun if it would end after so much rendering time.
    pub time: Duration,
    /// Renders of each combination, with different seeds.
    pub repeats: u32,
    /// Of relMSE.
    pub floor: Floor,
}

impl Lists {
    /// All combinations, each once.
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

/// Each of the settings with each of the values, each once.
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

/// Where the error is measured: powers of two, and the last number.
pub fn checkpoints(spp: u32) -> Vec<u32> {
    let powers = (0..u32::BITS).map(|power| 1 << power).take_while(|n| *n < spp);
    powers.chain([spp]).collect()
}

/// A resolution of the same shape that is not larger than a study needs.
pub fn study_size(resolution: [u32; 2]) -> [u32; 2] {
    let longer = resolution[0].max(resolution[1]);
    let scaled = |side: u32| (u64::from(side) * u64::from(LONGER_SIDE) + u64::from(longer) / 2) / u64::from(longer);
    if longer <= LONGER_SIDE { resolution } else { resolution.map(|side| scaled(side).max(1) as u32) }
}
