//! Presets of the estimator: the textbook one for experiments, and the fastest one.
use egui::Ui;
use noisefall_scene::scene::{Changes, Estimator, RenderSettings, Reuse, Setting};

use crate::viewer::widgets::style::row;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preset {
    /// The textbook estimator: pixels are independent and have the same number of samples.
    Teaching,
    /// The most efficient settings by trials of the scene.
    Fastest,
}

const PRESETS: [(Preset, &str, &str); 2] = [
    (
        Preset::Teaching,
        "Teaching",
        "Turns off path reuse, adaptive sampling, merging and Auto. The other settings stay as they are.",
    ),
    (
        Preset::Fastest,
        "Fastest",
        "The estimator and the path reuse that short trials find to be the most efficient in this scene, Owen-scrambled Sobol points, \
         BSDF directions and roulette by throughput.",
    ),
];

impl Preset {
    /// The settings with this preset in force. Cap and seed stay: they decide what is estimated, and not how fast.
    pub fn applied_to(self, settings: &RenderSettings) -> RenderSettings {
        match self {
            Preset::Teaching => {
                let is_chosen = settings.estimator == Estimator::Auto;
                let estimator = if is_chosen { Estimator::default() } else { settings.estimator };
                RenderSettings { estimator, reuse: Reuse::Off, adaptive: false, merging: false, ..*settings }
            }
            Preset::Fastest => {
                let fastest = RenderSettings { estimator: Estimator::Auto, ..RenderSettings::default() };
                let is_kept = |setting: &Setting| setting.changes != Changes::Estimate;
                RenderSettings::TABLE
                    .into_iter()
                    .filter(is_kept)
                    .fold(fastest, |fastest, setting| setting.with(&fastest, settings))
            }
        }
    }

    /// The preset that is in force.
    pub fn of(settings: &RenderSettings) -> Option<Preset> {
        PRESETS.into_iter().map(|(preset, _, _)| preset).find(|preset| preset.applied_to(settings) == *settings)
    }
}

/// Shows the presets and marks the one in force.
pub fn show(ui: &mut Ui, settings: &mut RenderSettings) {
    row(ui, "Preset", "Applies a set of settings. The marked one is in force.", |ui, _| {
        ui.horizontal(|ui| {
            let in_force = Preset::of(settings);
            for (preset, name, doc) in PRESETS {
                if ui.selectable_label(in_force == Some(preset), name).on_hover_text(doc).clicked() {
                    *settings = preset.applied_to(settings);
                }
            }
            if in_force.is_none() {
                ui.weak("Custom").on_hover_text("The settings below match neither preset.");
            }
        });
    });
}

#[cfg(test)]
mod tests {
    use noisefall_scene::{sampling::Sampler, scene::Roulette};

    use super::*;

    #[test]
    fn a_preset_that_is_applied_is_in_force_and_keeps_other_settings() {
        let own = RenderSettings {
            estimator: Estimator::Light,
            sampler: Sampler::Stratified,
            roulette: Roulette::Off,
            max_bounces: Some(5),
            count_crossings: true,
            adaptive: true,
            seed: 7,
            ..RenderSettings::default()
        };
        assert_eq!(Preset::of(&own), None);
        let taught = Preset::Teaching.applied_to(&own);
        assert_eq!(taught, RenderSettings { reuse: Reuse::Off, adaptive: false, ..own });
        let fast = Preset::Fastest.applied_to(&own);
        assert_eq!(Preset::Teaching.applied_to(&fast).estimator, Estimator::Mis);
        assert_eq!((fast.max_bounces, fast.count_crossings, fast.seed), (Some(5), true, 7));
        assert_eq!((fast.estimator, fast.reuse, fast.adaptive), (Estimator::Auto, Reuse::Auto, false));
        for preset in [Preset::Teaching, Preset::Fastest] {
            assert_eq!(Preset::of(&preset.applied_to(&own)), Some(preset));
        }
        assert_eq!(Preset::of(&RenderSettings::default()), None, "another estimator may be faster than MIS");
    }
}
