//! The plan of a study: lists of settings to combine, and the limits of each run.
use std::time::Duration;

use noisefall_kernel::measure::Floor;
use noisefall_scene::scene::{RenderSettings, Setting};

/// Default length of the longer side of an image, pixels.
const LONGER_SIDE: u32 = 256;

/// The values of each setting, which are all combined. A setting without a list has the scene's value.
#[derive(Clone, Debug, Default)]
pub struct Lists(Vec<(Setting, Vec<RenderSettings>)>);

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
    /// Sets the list of a setting to its values in these settings. An empty list stands for the scene's value.
    pub fn with(mut self, setting: Setting, values: impl IntoIterator<Item = RenderSettings>) -> Lists {
        self.0.retain(|(known, _)| *known != setting);
        self.0.push((setting, values.into_iter().collect()));
        self
    }

    /// Replaces each list that `others` has, too.
    pub fn replaced_by(self, others: Lists) -> Lists {
        others.0.into_iter().fold(self, |lists, (setting, values)| lists.with(setting, values))
    }

    /// All different combinations, in the order of the table of settings.
    pub fn combinations(&self, base: RenderSettings) -> Vec<RenderSettings> {
        RenderSettings::axes().fold(vec![base], |all, setting| match self.0.iter().find(|(of, _)| *of == setting) {
            Some((_, values)) if !values.is_empty() => combined(&all, setting, values),
            _ => all,
        })
    }
}

/// Combines all settings with all values, without duplicates.
fn combined(all: &[RenderSettings], setting: Setting, values: &[RenderSettings]) -> Vec<RenderSettings> {
    let mut combined = Vec::new();
    for settings in all.iter().flat_map(|settings| values.iter().map(|value| setting.with(settings, value))) {
        if !combined.contains(&settings) {
            combined.push(settings);
        }
    }
    combined
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
