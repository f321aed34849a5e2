//! Figures under the names that `render --json`, `compare --json` and `study.csv` share. `docs/figures.schema.json` describes
//! them.
use noisefall_kernel::measure::{Bias, Comparison};
use noisefall_render::render::settings_text::on_or_off;
use noisefall_scene::scene::RenderSettings;
use serde_json::{Map, Value, json};

pub type Figures = Map<String, Value>;

/// Figures from pairs of name and value.
pub fn named<const N: usize>(pairs: [(&str, Value); N]) -> Figures {
    pairs.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// The settings, which samples depend on besides scene and camera, in the words of the command line.
pub fn settings(settings: &RenderSettings) -> Figures {
    named([
        ("estimator", json!(settings.estimator.name())),
        ("directions", json!(settings.directions.name())),
        ("sampler", json!(settings.sampler.name())),
        ("roulette", json!(settings.roulette.name())),
        ("roulette_start", json!(settings.roulette.first_bounce())),
        ("max_bounces", json!(settings.max_bounces)),
        ("reuse", json!(settings.reuse.name())),
        ("adaptive", json!(on_or_off(settings.adaptive))),
        ("seed", json!(settings.seed)),
    ])
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
