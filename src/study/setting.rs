//! The settings that are studied, by name: as axes of plots and columns of tables.
use crate::scene::RenderSettings;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    Estimator,
    Directions,
    Sampler,
    Roulette,
    Cap,
}

impl Setting {
    pub const ALL: [Setting; 5] = [Setting::Estimator, Setting::Directions, Setting::Sampler, Setting::Roulette, Setting::Cap];

    pub fn name(self) -> &'static str {
        match self {
            Setting::Estimator => "estimator",
            Setting::Directions => "directions",
            Setting::Sampler => "sampler",
            Setting::Roulette => "roulette",
            Setting::Cap => "bounce cap",
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
        }
        changed
    }
}

/// All settings in one line; a cap only where there is one.
pub fn label(settings: &RenderSettings) -> String {
    let shown = |setting: &Setting| *setting != Setting::Cap || settings.max_bounces.is_some();
    let value = |setting: Setting| match setting {
        Setting::Roulette => format!("roulette {}", setting.value(settings)),
        Setting::Cap => format!("cap {}", setting.value(settings)),
        _ => setting.value(settings),
    };
    let values: Vec<String> = Setting::ALL.into_iter().filter(shown).map(value).collect();
    values.join(", ")
}
