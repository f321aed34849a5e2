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
                "warning: {cut_paths} paths were cut after {longest} reflections: the picture is biased; use roulette"
            ));
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
