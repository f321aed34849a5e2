//! The settings that are studied, by name: as axes of plots and columns of tables.
use crate::{render::settings_text::on_or_off, scene::RenderSettings};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    Estimator,
    Directions,
    Sampler,
    Roulette,
    Cap,
    Reuse,
    Adaptive,
}

impl Setting {
    pub const ALL: [Setting; 7] = [
        Setting::Estimator,
        Setting::Directions,
        Setting::Sampler,
        Setting::Roulette,
        Setting::Cap,
        Setting::Reuse,
        Setting::Adaptive,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Setting::Estimator => "estimator",
            Setting::Directions => "directions",
            Setting::Sampler => "sampler",
            Setting::Roulette => "roulette",
            Setting::Cap => "bounce cap",
            Setting::Reuse => "sharing",
            Setting::Adaptive => "adaptive",
        }
    }

    /// As the command line writes it.
    pub fn value(self, settings: &RenderSettings) -> String {
        match self {
            Setting::Estimator => settings.estimator.name().to_owned(),
            Setting::Directions => settings.directions.name().to_owned(),
            Setting::Sampler => settings.sampler.entry().name.to_owned(),
            Setting::Roulette => settings.roulette.name(),
            Setting::Cap => settings.max_bounces.map_or_else(|| "none".to_owned(), |cap| cap.to_string()),
            Setting::Reuse => settings.reuse.name().to_owned(),
            Setting::Adaptive => on_or_off(settings.adaptive).to_owned(),
        }
    }

    /// Settings with the value that this one has in others.
    pub fn with(self, settings: &RenderSettings, from: &RenderSettings) -> RenderSettings {
        let mut changed = *settings;
        match self {
            Setting::Estimator => changed.estimator = from.estimator,
            Setting::Directions => changed.directions = from.directions,
            Setting::Sampler => changed.sampler = from.sampler,
            Setting::Roulette => changed.roulette = from.roulette,
            Setting::Cap => changed.max_bounces = from.max_bounces,
            Setting::Reuse => changed.reuse = from.reuse,
            Setting::Adaptive => changed.adaptive = from.adaptive,
        }
        changed
    }
}

/// All settings in one line; cap, sharing and adaptive samples only where they are not as usual.
pub fn label(settings: &RenderSettings) -> String {
    let usual = RenderSettings::default();
    let shown = |setting: &Setting| match setting {
        Setting::Cap | Setting::Reuse | Setting::Adaptive => setting.value(settings) != setting.value(&usual),
        _ => true,
    };
    let value = |setting: Setting| match setting {
        Setting::Roulette => format!("roulette {}", setting.value(settings)),
        Setting::Cap => format!("cap {}", setting.value(settings)),
        Setting::Reuse => format!("sharing {}", setting.value(settings)),
        Setting::Adaptive => format!("adaptive {}", setting.value(settings)),
        _ => setting.value(settings),
    };
    let values: Vec<String> = Setting::ALL.into_iter().filter(shown).map(value).collect();
    values.join(", ")
}
