//! The settings of a study, by name: as axes of plots and columns of tables.
use noisefall_render::render::settings_text::on_or_off;
use noisefall_scene::scene::RenderSettings;

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

    /// The value in the words of the command line.
    pub fn value(self, settings: &RenderSettings) -> String {
        match self {
            Setting::Estimator => settings.estimator.name().to_owned(),
            Setting::Directions => settings.directions.name().to_owned(),
            Setting::Sampler => settings.sampler.name().to_owned(),
            Setting::Roulette => settings.roulette.name(),
            Setting::Cap => settings.max_bounces.map_or_else(|| "none".to_owned(), |cap| cap.to_string()),
            Setting::Reuse => settings.reuse.name().to_owned(),
            Setting::Adaptive => on_or_off(settings.adaptive).to_owned(),
        }
    }

    /// `settings` with the value that this setting has in `from`.
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

/// All settings in one line. Cap, reuse and adaptive sampling are left out if they have their defaults.
pub fn label(settings: &RenderSettings) -> String {
    let shown = |setting: &Setting| setting.is_always_told() || !setting.is_usual(settings);
    joined(Setting::ALL.into_iter().filter(shown), settings)
}

/// The common values of some settings in one line, and a line with the differences of each.
pub fn differing_labels(all: &[RenderSettings]) -> (String, Vec<String>) {
    let Some(first) = all.first() else { return (String::new(), Vec::new()) };
    let differs = |setting: &Setting| all.iter().any(|settings| setting.value(settings) != setting.value(first));
    let is_common = |setting: &Setting| !differs(setting) && (setting.is_always_told() || !setting.is_usual(first));
    let common = joined(Setting::ALL.into_iter().filter(is_common), first);
    (common, all.iter().map(|settings| joined(Setting::ALL.into_iter().filter(differs), settings)).collect())
}

fn joined(settings: impl Iterator<Item = Setting>, of: &RenderSettings) -> String {
    settings.map(|setting| setting.words(of)).collect::<Vec<_>>().join(", ")
}

impl Setting {
    fn is_always_told(self) -> bool {
        !matches!(self, Setting::Cap | Setting::Reuse | Setting::Adaptive)
    }

    fn is_usual(self, settings: &RenderSettings) -> bool {
        self.value(settings) == self.value(&RenderSettings::default())
    }

    /// The value, with the name of the setting if the value alone is ambiguous.
    fn words(self, settings: &RenderSettings) -> String {
        let value = self.value(settings);
        match self {
            Setting::Roulette => format!("roulette {value}"),
            Setting::Cap if settings.max_bounces.is_none() => "no cap".to_owned(),
            Setting::Cap => format!("cap {value}"),
            Setting::Reuse => format!("sharing {value}"),
            Setting::Adaptive => format!("adaptive {value}"),
            _ => value,
        }
    }
}
