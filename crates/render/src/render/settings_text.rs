//! The settings of an image as text: metadata from which a file can be traced and reproduced.
use serde_json::json;

use super::{frame::Frame, tone::Display};
use noisefall_scene::scene::{Camera, RenderSettings, Scene};

/// Everything that an image depends on, and how it is shown.
#[derive(Clone, Copy)]
pub struct ImageOrigin<'a> {
    /// Title of the scene.
    pub title: &'a str,
    /// Text of the scene.
    pub scene: &'a str,
    /// The camera.
    pub camera: &'a Camera,
    /// The settings of the estimate.
    pub settings: &'a RenderSettings,
    /// The display transform.
    pub display: Display,
}

impl ImageOrigin<'_> {
    /// One JSON object in ASCII with all that an image depends on. `remarks` say which part of the image is shown, if that is not
    /// all.
    pub fn text(&self, frame: &Frame, remarks: &[(&str, String)]) -> String {
        let mut text = json!({
            "program": concat!("Noisefall ", env!("CARGO_PKG_VERSION")),
            "title": self.title,
            "scene": self.scene,
            "camera": self.camera,
            "settings": self.settings,
            "display": self.display,
            "spp": frame.spp,
            "mean_spp": frame.sample_counts().mean(),
            "samples": frame.sample_counts().total,
        });
        for (name, remark) in remarks {
            text[*name] = remark.as_str().into();
        }
        ascii(&text.to_string())
    }
}

/// [`ImageOrigin::text`] of an image of a scene.
pub fn settings_text(
    scene: &Scene,
    camera: &Camera,
    settings: &RenderSettings,
    display: Display,
    frame: &Frame,
    remarks: &[(&str, String)],
) -> String {
    ImageOrigin { title: &scene.title, scene: &scene.source, camera, settings, display }.text(frame, remarks)
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

/// The options of `noisefall render` that turn the settings of a scene into these.
pub fn options(settings: &RenderSettings, of_scene: &RenderSettings) -> String {
    settings.differing(of_scene).map(|setting| format!(" --{} {}", setting.option(), setting.value(settings))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::tone::ToneMap;
    use noisefall_scene::{
        sampling::{Directions, Sampler},
        scene::{Estimator, Reuse, Roulette, built_in},
    };

    #[test]
    fn the_text_is_ascii_and_still_says_the_same() {
        let mut scene = built_in();
        scene.title = "ρ = ½, 𝄞".to_owned();
        // Interrupted: two pixels have a sample more.
        let frame = Frame { spp: 3, radiance: vec![[0.0; 3]; 4], counts: vec![3, 4, 3, 4], ..Frame::default() };
        let display = Display { exposure: 1.5, tone_map: ToneMap::Reinhard, ..Display::default() };
        let settings = RenderSettings { seed: 9, ..scene.settings };
        let camera = Camera { resolution: [2, 2], ..scene.camera };
        let text = settings_text(&scene, &camera, &settings, display, &frame, &[("view", "cos θ".to_owned())]);
        assert!(text.is_ascii());
        let back: serde_json::Value = serde_json::from_str(&text).expect("it is JSON");
        for (key, value) in [
            ("title", json!("ρ = ½, 𝄞")),
            ("view", json!("cos θ")),
            ("scene", json!(*scene.source)),
            ("camera", json!(camera)),
            ("settings", json!(settings)),
            ("display", json!(display)),
            ("spp", json!(3)),
            ("mean_spp", json!(3.5)),
            ("samples", json!(14)),
        ] {
            assert_eq!(back[key], value, "{key}");
        }
        assert_eq!((&back["camera"]["resolution"], &back["settings"]["seed"]), (&json!([2, 2]), &json!(9)));
        assert_eq!(back["program"], concat!("Noisefall ", env!("CARGO_PKG_VERSION")));
    }

    #[test]
    fn only_settings_that_differ_from_the_scene_are_options() {
        let scene = RenderSettings { roulette: Roulette::by_throughput_from(1), ..RenderSettings::default() };
        assert_eq!(options(&RenderSettings { roulette: Roulette::Off, ..scene }, &scene), " --roulette off");
        assert_eq!(options(&scene, &RenderSettings::default()), " --roulette throughput:1");
        assert_eq!(options(&scene, &scene), "");
        let changed = RenderSettings { max_bounces: Some(3), seed: 7, ..scene };
        assert_eq!(options(&changed, &scene), " --max-bounces 3 --seed 7");
        assert_eq!(options(&scene, &changed), " --max-bounces none --seed 0");
        let other = RenderSettings {
            sampler: Sampler::Stratified,
            estimator: Estimator::Light,
            directions: Directions::Uniform,
            roulette: Roulette::fixed(0.25),
            reuse: Reuse::Off,
            adaptive: true,
            ..scene
        };
        let all = " --estimator light --directions uniform --sampler stratified --roulette 0.25 --reuse off --adaptive on";
        assert_eq!(options(&other, &scene), all);
        assert!(options(&scene, &other).ends_with(" --reuse auto --adaptive off"));
    }
}
