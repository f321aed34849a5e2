//! Summary of a finished image: notes, and a line of text or JSON.
use std::path::Path;

use noisefall_base::math::SimdLevel;
use noisefall_formats::import::Remarks;
use noisefall_kernel::measure::{Bias, Comparison};
use noisefall_render::render::{Frame, State, Status};
use noisefall_scene::scene::{Camera, RenderSettings, Scene};
use serde_json::{Value, json};

use super::{figures, output::Output};

/// A rendered image and its figures.
pub struct Done<'a> {
    pub output: &'a Output,
    pub scene: &'a Scene,
    pub scene_path: &'a Path,
    /// Parts of the scene that were not imported exactly.
    pub remarks: &'a Remarks,
    pub settings: &'a RenderSettings,
    pub frame: &'a Frame,
    pub status: &'a Status,
    /// Whether the frame is denoised. The noise of its samples says nothing about it then.
    pub is_denoised: bool,
    pub threads: usize,
    /// Seconds of building the scene and of rendering.
    pub seconds: [f64; 2],
    /// The error against the scene's reference, if it has one.
    pub error: Option<(Comparison, Bias)>,
    /// Message if the image contradicts the scene's reference by more than noise.
    pub contradiction: Option<String>,
    /// Command that replays the first invalid sample.
    pub replay: Option<String>,
}

impl Done<'_> {
    /// Warnings and notes that the user must see.
    pub fn notes(&self, camera: &Camera) -> Vec<String> {
        let Status { invalid_samples, cut_paths, .. } = self.status;
        let mut notes = Vec::new();
        if let Some(replay) = &self.replay {
            notes.push(format!("warning: {invalid_samples} invalid samples were dropped; the first one: {replay}"));
        }
        if self.frame.is_black() {
            notes.push(format!("warning: the image is entirely black: {}", self.scene.why_black(camera, self.settings)));
        }
        if self.status.error_is_lower_bound && !self.is_denoised && !self.frame.is_black() {
            notes.push(
                "warning: few pixels carry the estimated error, so it is a lower bound: light that paths rarely find may be missing from most of \
                 the image. More samples help; `--estimator bidirectional` and `--merging on` find caustics"
                    .to_owned(),
            );
        }
        if *cut_paths > 0 {
            let longest = self.settings.last_bounce();
            notes.push(format!("warning: {cut_paths} paths were cut after {longest} bounces: the image is biased; use roulette"));
        }
        if self.settings.adaptive
            && !self.frame.path_reuse.correlates()
            && self.frame.counts.is_empty()
            && !self.has_light_paths()
        {
            notes.push("warning: `adaptive` is not used: there are few samples, or a pilot found no gain in it".to_owned());
        }
        if let Some(contradiction) = &self.contradiction {
            let why = self.bias().map_or_else(String::new, |why| format!(" (it is biased: {why})"));
            notes.push(format!("warning: {contradiction}{why}"));
        }
        notes
    }

    fn has_light_paths(&self) -> bool {
        let in_force = self.scene.estimator_in_force(self.settings).map_or(self.settings.estimator, |chosen| chosen.estimator);
        in_force.traces_light_paths()
    }

    /// Why the image is biased; `None` if it is not.
    fn bias(&self) -> Option<String> {
        let denoised = self.is_denoised.then(|| "denoised".to_owned());
        let reasons: Vec<String> = denoised.into_iter().chain(self.status.bias(self.settings)).collect();
        (!reasons.is_empty()).then(|| reasons.join(", "))
    }

    pub fn line(&self) -> String {
        let (output, samples) = (self.output, self.frame.sample_counts());
        let [_, seconds] = self.seconds;
        let rate = self.status.samples as f64 / seconds / 1e6;
        let noise = match self.frame.is_black() {
            true => ", no light found".to_owned(),
            false if self.is_denoised => String::new(),
            false => noise_text(self.status),
        };
        let error = self.error.as_ref().map(|(error, _)| format!(", error {:.2} %", 100.0 * error.rel_mse.sqrt()));
        let error = error.unwrap_or_default();
        let bias = self.bias().map_or_else(|| "unbiased".to_owned(), |why| format!("biased: {why}"));
        let end = match &self.status.state {
            State::Done(target) => target.to_string(),
            _ => "interrupted".to_owned(),
        };
        format!("{output}: {samples} in {seconds:.2} s ({rate:.1} M samples/s){noise}{error}, {bias}; {end}")
    }

    pub fn json(&self) -> Value {
        let (frame, status) = (self.frame, self.status);
        let [build_seconds, seconds] = self.seconds;
        let stopped_by = match &status.state {
            State::Done(target) => target.name(),
            _ => "interruption",
        };
        let (comparison, bias) = self.error.as_ref().map(|(comparison, bias)| (comparison, bias)).unzip();
        let mut figures = figures::settings(self.settings);
        figures.extend(figures::error(comparison, bias));
        figures.extend(figures::named([
            // A file name need not be valid Unicode.
            ("scene", json!(self.scene_path.to_string_lossy())),
            ("width", json!(frame.width)),
            ("height", json!(frame.height)),
            ("spp", json!(status.spp)),
            ("mean_spp", json!(frame.sample_counts().mean())),
            ("stopped_by", json!(stopped_by)),
            ("threads", json!(self.threads)),
            ("simd", json!(SimdLevel::best().name())),
            ("version", json!(env!("CARGO_PKG_VERSION"))),
            ("commit", json!(noisefall_render::COMMIT)),
            ("path_reuse", json!(status.path_reuse.name())),
            ("adapts", json!(status.adapts)),
            ("build_seconds", json!(build_seconds)),
            ("seconds", json!(seconds)),
            // Scripts of the first versions read this name.
            ("render_seconds", json!(seconds)),
            ("paths", json!(status.samples)),
            ("paths_per_second", json!(status.samples as f64 / seconds)),
            ("rays", json!(status.rays)),
            ("mean", json!(mean(&frame.radiance))),
            ("rel_mse_estimate", json!(status.rel_mse_estimate.filter(|_| !self.is_denoised))),
            ("rel_mse_is_lower_bound", json!(status.error_is_lower_bound)),
            ("biased", json!(self.bias())),
            ("cut_paths", json!(status.cut_paths)),
            ("dropped_triangles", json!(self.scene.shapes.dropped_triangles())),
            ("invalid_samples", json!(status.invalid_samples)),
            ("replay", json!(self.replay)),
            ("remarks", json!(self.remarks.lines(usize::MAX))),
        ]));
        figures.into()
    }
}

/// The mean radiance of an image per channel.
fn mean(radiance: &[[f32; 3]]) -> [f64; 3] {
    let count = radiance.len().max(1) as f64;
    [0, 1, 2].map(|c| radiance.iter().map(|rgb| f64::from(rgb[c])).sum::<f64>() / count)
}

/// The estimated noise as in ", estimated error 2.50 %"; empty if it is unknown. An estimate that few pixels carry is a lower bound.
pub fn noise_text(status: &Status) -> String {
    let bound = if status.error_is_lower_bound { "≥ " } else { "" };
    status.relative_noise().map_or_else(String::new, |noise| format!(", estimated error {bound}{:.2} %", 100.0 * noise))
}

#[cfg(test)]
mod tests;
