//! Figures under the names that `render --json`, `compare --json` and `study.csv` share. `docs/figures.schema.json` describes
//! them.
use noisefall_base::declare::Datum;
use noisefall_kernel::measure::{Bias, Comparison};
use noisefall_scene::scene::{RenderSettings, Setting};
use serde_json::{Map, Value, json};

pub type Figures = Map<String, Value>;

/// Figures from pairs of name and value.
pub fn named<const N: usize>(pairs: [(&str, Value); N]) -> Figures {
    pairs.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// The settings, which samples depend on besides scene and camera, in the words of the command line.
pub fn settings(settings: &RenderSettings) -> Figures {
    let figure = |setting: Setting| match setting.datum(settings) {
        Datum::Count(count) => json!(count),
        datum => json!(datum.to_string()),
    };
    let mut figures: Figures =
        RenderSettings::TABLE.map(|setting| (setting.key().to_owned(), figure(setting))).into_iter().collect();
    figures.insert("roulette_start".to_owned(), json!(settings.roulette.first_bounce()));
    figures
}

/// The errors of an image against its reference; all null without one.
pub fn error(comparison: Option<&Comparison>, bias: Option<&Bias>) -> Figures {
    named([
        ("rmse", json!(comparison.map(|comparison| comparison.rmse))),
        ("rel_mse", json!(comparison.map(|comparison| comparison.rel_mse))),
        ("bias", json!(bias.map(|bias| bias.mean))),
        ("bias_standard_error", json!(bias.and_then(|bias| bias.standard_error))),
        ("bias_in_standard_errors", json!(bias.and_then(|bias| bias.z))),
        ("exact_samples", json!(bias.map(|bias| bias.is_exact))),
        ("heavy_tails", json!(bias.map(|bias| bias.has_heavy_tails))),
    ])
}
