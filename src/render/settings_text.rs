//! The settings of a picture as text: what a file carries, so that it can be traced back and made again.
use serde_json::json;

use super::tone::Display;
use crate::scene::{Camera, RenderSettings, Scene};

/// One JSON object, in ASCII, with all that a picture depends on. `remarks` say what of it is shown, where that is not all.
pub fn settings_text(
    scene: &Scene,
    camera: &Camera,
    settings: &RenderSettings,
    display: Display,
    spp: u32,
    remarks: &[(&str, String)],
) -> String {
    let mut text = json!({
        "program": concat!("Noisefall ", env!("CARGO_PKG_VERSION")),
        "title": scene.title,
        "scene": scene.source,
        "camera": camera,
        "settings": settings,
        "display": display,
        "spp": spp,
    });
    for (name, remark) in remarks {
        text[*name] = remark.as_str().into();
    }
    ascii(&text.to_string())
}

/// JSON with every character beyond ASCII escaped: EXR has no Unicode text.
fn ascii(json: &str) -> String {
    let mut text = String::with_capacity(json.len());
    for c in json.chars() {
        if c.is_ascii() {
            text.push(c);
        } else {
            c.encode_utf16(&mut [0; 2]).iter().for_each(|unit| text.push_str(&format!("\\u{unit:04x}")));
        }
    }
    text
}

/// The options of `noisefall render` that turn the settings a scene opens with into these.
pub fn options(settings: &RenderSettings, of_scene: &RenderSettings) -> String {
    let mut options = String::new();
    let mut option = |differs: bool, name: &str, value: String| {
        if differs {
            options.push_str(&format!(" --{name} {value}"));
        }
    };
    option(settings.sampler != of_scene.sampler, "sampler", settings.sampler.entry().name.to_owned());
    option(settings.estimator != of_scene.estimator, "estimator", settings.estimator.name().to_owned());
    option(settings.directions != of_scene.directions, "directions", settings.directions.name().to_owned());
    option(settings.roulette != of_scene.roulette, "roulette", settings.roulette.name());
    let cap = settings.max_bounces.map_or_else(|| "none".to_owned(), |cap| cap.to_string());
    option(settings.max_bounces != of_scene.max_bounces, "max-bounces", cap);
    option(settings.reuse != of_scene.reuse, "reuse", settings.reuse.name().to_owned());
    option(settings.adaptive != of_scene.adaptive, "adaptive", if settings.adaptive { "on" } else { "off" }.to_owned());
    option(settings.seed != of_scene.seed, "seed", settings.seed.to_string());
    options
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Roulette, built_in};

    #[test]
    fn the_text_is_ascii_and_still_says_the_same() {
        let mut scene = built_in();
        scene.title = "ρ = ½, 𝄞".to_owned();
        let text = settings_text(&scene, &scene.camera, &scene.settings, Display::default(), 3, &[("view", "cos θ".to_owned())]);
        assert!(text.is_ascii());
        let back: serde_json::Value = serde_json::from_str(&text).expect("it is JSON");
        assert_eq!((&back["title"], &back["view"]), (&json!("ρ = ½, 𝄞"), &json!("cos θ")));
    }

    #[test]
    fn only_what_differs_from_the_scene_is_an_option() {
        let scene = RenderSettings { roulette: Roulette::Throughput { start: 1 }, ..RenderSettings::default() };
        assert_eq!(options(&scene, &scene), "");
        let changed = RenderSettings { max_bounces: Some(3), seed: 7, ..scene };
        assert_eq!(options(&changed, &scene), " --max-bounces 3 --seed 7");
    }
}
