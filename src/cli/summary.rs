//! What is said of a finished picture: notes, and a line of text or of JSON.
use std::path::Path;

use noisefall::{
    render::{Frame, State, Status},
    scene::{Camera, RenderSettings, Scene},
};
use serde_json::{Value, json};

use super::output::Output;

/// A rendered picture and its figures.
pub struct Done<'a> {
    pub output: &'a Output,
    pub scene: &'a Scene,
    pub scene_path: &'a Path,
    pub settings: &'a RenderSettings,
    pub frame: &'a Frame,
    pub status: &'a Status,
    pub threads: usize,
    /// To build the scene, and to render.
    pub seconds: [f64; 2],
    /// Against the true picture, if there is one.
    pub rel_mse: Option<f64>,
    /// Why the picture cannot be a sample of the true one, if it cannot.
    pub contradiction: Option<String>,
    /// The command that traces the first invalid sample again.
    pub replay: Option<String>,
}

impl Done<'_> {
    /// Whatever must not go unseen.
    pub fn notes(&self, camera: &Camera) -> Vec<String> {
        let Status { invalid_samples, cut_paths, .. } = self.status;
        let mut notes = Vec::new();
        if let Some(replay) = &self.replay {
            notes.push(format!("warning: {invalid_samples} invalid samples were dropped; the first one: {replay}"));
        }
        if self.frame.is_black() {
            notes.push(format!("note: the picture is entirely black: {}", self.scene.why_black(camera, self.settings)));
        }
        if *cut_paths > 0 {
            let longest = self.settings.last_bounce();
            notes.push(format!(
                "warning: {cut_paths} paths were cut after {longest} bounces: the picture is biased; use roulette"
            ));
        }
        if let Some(contradiction) = &self.contradiction {
            let why = self.status.bias(self.settings).map_or_else(String::new, |why| format!(" (it is biased: {why})"));
            notes.push(format!("warning: {contradiction}{why}"));
        }
        notes
    }

    pub fn line(&self) -> String {
        let (output, samples) = (self.output, self.frame.sample_counts());
        let [_, seconds] = self.seconds;
        let rate = self.status.samples as f64 / seconds / 1e6;
        let noise = if self.frame.is_black() { ", no light found".to_owned() } else { noise_text(self.status) };
        let error = self.rel_mse.map_or_else(String::new, |rel_mse| format!(", true error {:.2} %", 100.0 * rel_mse.sqrt()));
        let bias = self.status.bias(self.settings).map_or_else(|| "unbiased".to_owned(), |why| format!("biased: {why}"));
        let end = match &self.status.state {
            State::Done(target) => target.to_string(),
            _ => "interrupted".to_owned(),
        };
        format!("{output}: {samples} in {seconds:.2} s ({rate:.1} M samples/s){noise}{error}, {bias}; {end}")
    }

    pub fn json(&self) -> Value {
        let (frame, status) = (self.frame, self.status);
        let [build_seconds, render_seconds] = self.seconds;
        let stopped_by = match &status.state {
            State::Done(target) => target.name(),
            _ => "interruption",
        };
        json!({
            // A name need not be text.
            "scene": self.scene_path.to_string_lossy(), "width": frame.width, "height": frame.height,
            "spp": status.spp, "mean_spp": frame.sample_counts().mean(), "stopped_by": stopped_by,
            "threads": self.threads, "seed": self.settings.seed,
            "build_seconds": build_seconds, "render_seconds": render_seconds,
            "paths": status.samples, "rays": status.rays, "invalid_samples": status.invalid_samples,
            "rel_mse_estimate": status.rel_mse_estimate, "cut_paths": status.cut_paths,
            "dropped_triangles": self.scene.shapes.dropped_triangles(), "bias": status.bias(self.settings),
            "reuse": status.shares, "adaptive": status.adapts, "rel_mse": self.rel_mse, "replay": self.replay,
        })
    }
}

/// ", noise 2.50 %".
pub fn noise_text(status: &Status) -> String {
    status.relative_noise().map_or_else(String::new, |noise| format!(", noise {:.2} %", 100.0 * noise))
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use noisefall::{
        render::{Target, image_file::Format},
        scene::built_in,
    };

    use super::*;

    /// Figures that all differ.
    fn status(state: State) -> Status {
        Status {
            generation: 1,
            state,
            spp: 2,
            region_spp: None,
            samples: 10,
            rays: 77,
            elapsed: Duration::from_secs(1),
            rel_mse_estimate: Some(0.0009),
            shares: true,
            adapts: false,
            invalid_samples: 4,
            first_invalid: None,
            cut_paths: 6,
        }
    }

    fn frame(radiance: f32) -> Frame {
        let (radiance, counts) = (vec![[radiance; 3]; 4], vec![2, 3, 2, 3]);
        Frame { width: 4, height: 1, full_resolution: [4, 1], radiance, spp: 2, counts, ..Frame::default() }
    }

    struct Said {
        json: Value,
        line: String,
        notes: Vec<String>,
    }

    fn said(status: &Status, frame: &Frame, settings: RenderSettings) -> Said {
        let (scene, output) = (built_in(), Output::File("out.png".into()));
        let done = Done {
            output: &output,
            scene: &scene,
            scene_path: Path::new("a.toml"),
            settings: &settings,
            frame,
            status,
            threads: 3,
            seconds: [0.25, 0.5],
            rel_mse: Some(0.0004),
            contradiction: None,
            replay: Some("noisefall render a.toml --pixel 1,0".to_owned()),
        };
        Said { json: done.json(), line: done.line(), notes: done.notes(&scene.camera) }
    }

    #[test]
    fn every_figure_stands_under_its_name() {
        let settings = RenderSettings { seed: 8, max_bounces: Some(5), ..RenderSettings::default() };
        let of_time = status(State::Done(Target::Time));
        let line = said(&of_time, &frame(1.0), settings).json;
        let expected = json!({
            "scene": "a.toml", "width": 4, "height": 1, "spp": 2, "mean_spp": 2.5, "stopped_by": "time", "threads": 3, "seed": 8,
            "build_seconds": 0.25, "render_seconds": 0.5, "paths": 10, "rays": 77, "invalid_samples": 4, "rel_mse_estimate": 0.0009,
            "cut_paths": 6, "dropped_triangles": 0, "bias": settings.bias(), "reuse": true, "adaptive": false, "rel_mse": 0.0004,
            "replay": "noisefall render a.toml --pixel 1,0",
        });
        assert_eq!(line, expected);
        assert!(line["bias"].is_string());
        let other = Status { shares: false, adapts: true, cut_paths: 0, ..status(State::Paused) };
        let line = said(&other, &frame(1.0), RenderSettings::default()).json;
        assert_eq!((&line["reuse"], &line["adaptive"], &line["bias"]), (&json!(false), &json!(true), &Value::Null));
        assert_eq!(line["stopped_by"], "interruption");
    }

    #[test]
    fn the_line_says_what_there_is_and_why_no_more() {
        let line = |status: &Status, frame: &Frame| said(status, frame, RenderSettings::default()).line;
        let million = Status { samples: 1_000_000, ..status(State::Done(Target::Samples(2))) };
        assert_eq!(
            line(&million, &frame(1.0)),
            "out.png: 2.5 spp on average (2 to 3) in 0.50 s (2.0 M samples/s), noise 3.00 %, true error 2.00 %, \
             biased: 6 paths cut; stopped at 2 spp"
        );
        let whole = Status { cut_paths: 0, rel_mse_estimate: None, ..status(State::Paused) };
        let even = Frame { counts: Vec::new(), ..frame(0.0) };
        assert_eq!(
            line(&whole, &even),
            "out.png: 2 spp in 0.50 s (0.0 M samples/s), no light found, true error 2.00 %, unbiased; interrupted"
        );
    }

    #[test]
    fn notes_are_about_what_is_wrong_and_nothing_else() {
        let notes = |status: &Status, frame: &Frame| said(status, frame, RenderSettings::default()).notes;
        let all = notes(&status(State::Done(Target::Time)), &frame(0.0));
        assert_eq!(all.len(), 3);
        assert_eq!(all[0], "warning: 4 invalid samples were dropped; the first one: noisefall render a.toml --pixel 1,0");
        assert!(all[1].starts_with("note: the picture is entirely black: "), "{}", all[1]);
        assert!(all[2].starts_with(&format!("warning: 6 paths were cut after {}", RenderSettings::LONGEST_PATH)), "{}", all[2]);
        assert_eq!(notes(&Status { cut_paths: 0, ..status(State::Paused) }, &frame(1.0)).len(), 1);
    }

    #[test]
    fn what_is_on_standard_output_is_named_so() {
        assert_eq!(Output::Stream(Format::Png).to_string(), "standard output");
    }
}
