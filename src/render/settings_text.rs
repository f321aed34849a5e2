//! The settings of a picture as text: what a file carries, so that it can be traced back and made again.
use serde_json::json;

use super::tone::Display;
use crate::scene::{Camera, RenderSettings, Roulette, Scene};

/// One JSON object with all that a picture depends on.
pub fn settings_text(scene: &Scene, camera: &Camera, settings: &RenderSettings, display: Display, spp: u32) -> String {
    json!({
        "program": concat!("Noisefall ", env!("CARGO_PKG_VERSION")),
        "title": scene.title,
        "scene": scene.source,
        "camera": camera,
        "settings": settings,
        "display": display,
        "spp": spp,
    })
    .to_string()
}

/// The settings as options of `noisefall render`.
pub fn options(settings: &RenderSettings) -> String {
    let directions = match settings.directions {
        crate::sampling::Directions::Uniform => "uniform",
        crate::sampling::Directions::Cosine => "cosine",
    };
    let roulette = match settings.roulette {
        Roulette::Off => "off".to_owned(),
        Roulette::Fixed(p) => p.to_string(),
        Roulette::Throughput { .. } => "throughput".to_owned(),
    };
    let cap = settings.max_bounces.map_or_else(|| "none".to_owned(), |cap| cap.to_string());
    format!(
        "--sampler {} --directions {directions} --roulette {roulette} --max-bounces {cap} --seed {}",
        settings.sampler.entry().name,
        settings.seed
    )
}
