//! Settings in one line: labels of curves, rows and images.
use noisefall_scene::scene::{RenderSettings, Setting};

/// The settings in one line. Those with their defaults are left out, except for those that say how light is estimated.
pub fn label(settings: &RenderSettings) -> String {
    joined(RenderSettings::axes().filter(|setting| setting.is_told(settings)), settings)
}

/// The common values of some settings in one line, and a line with the differences of each.
pub fn differing_labels(all: &[RenderSettings]) -> (String, Vec<String>) {
    let Some(first) = all.first() else { return (String::new(), Vec::new()) };
    let differs = |setting: &Setting| all.iter().any(|settings| setting.differs(settings, first));
    let common = joined(RenderSettings::axes().filter(|setting| setting.is_told(first) && !differs(setting)), first);
    (common, all.iter().map(|settings| joined(RenderSettings::axes().filter(differs), settings)).collect())
}

fn joined(settings: impl Iterator<Item = Setting>, of: &RenderSettings) -> String {
    settings.map(|setting| setting.labelled_value(of)).collect::<Vec<_>>().join(", ")
}
