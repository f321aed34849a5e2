//! The image of exact sums: written, and reported. It is the same whether the sums come from one render or from joined files.
use std::process::ExitCode;

use noisefall_base::quote;
use noisefall_render::{
    render::{
        Display, Frame, Status,
        checkpoint::is_checkpoint_file,
        settings_text::ImageOrigin,
        split::{NoSamples, SampleRanges, SplitPicture},
    },
    render_file::{Counters, Header},
};
use noisefall_scene::{sampling::Sampler, scene::PathReuse};
use serde_json::{Value, json};

use super::{
    figures,
    messages::{Failure, tell},
    output::Output,
};

/// Key of the ranges in the metadata of an image.
const SAMPLES_KEY: &str = "sample_ranges";
/// Key of those that are missing.
const MISSING_KEY: &str = "missing_samples";

/// Samples of an image, and where they go.
pub struct SplitImage<'a> {
    pub output: &'a Output,
    /// The scene, settings and versions that the image depends on.
    pub header: &'a Header,
    pub samples: &'a SampleRanges,
    /// Samples that are missing.
    pub missing: SampleRanges,
    pub json: bool,
}

/// Whether the output is a file of samples.
pub fn is_sample_file(output: &Output) -> bool {
    output.file().is_some_and(is_checkpoint_file)
}

impl SplitImage<'_> {
    /// An empty image.
    pub fn picture(&self) -> Result<SplitPicture, Failure> {
        // For the figures it makes no difference what exactly is shared.
        let shares = self.header.image.as_ref().is_some_and(|image| image.shares);
        let path_reuse = if shares { PathReuse::Suffixes } else { PathReuse::Off };
        let picture = SplitPicture::new(self.header.camera.resolution, self.samples.clone(), path_reuse);
        picture.map_err(|error| error.to_string())
    }

    /// Writes the image of a filled partial render, and prints its line.
    pub fn deliver(&self, picture: SplitPicture, display: Display) -> Result<ExitCode, Failure> {
        let frame = picture.frame();
        let Header { scene, camera, settings, image, .. } = self.header;
        let title = image.as_ref().map_or("", |image| &image.title);
        let origin = ImageOrigin { title, scene: &scene.text, camera, settings, display };
        let mut remarks = vec![(SAMPLES_KEY, self.samples.to_string())];
        remarks.extend((!self.missing.is_empty()).then(|| (MISSING_KEY, self.missing.to_string())));
        let delivered = self.output.write(&frame, &[], display, &origin.text(&frame, &remarks))?;
        if delivered == ExitCode::SUCCESS {
            self.report(Some(&frame))?;
        }
        Ok(delivered)
    }

    /// Prints the line about a file of samples, or about its image.
    pub fn report(&self, frame: Option<&Frame>) -> Result<(), Failure> {
        let Counters { cut_paths, first_invalid, .. } = self.header.counters;
        if let Some([x, y, sample]) = first_invalid {
            tell(&format!(
                "warning: invalid samples were dropped; the first one: `noisefall render {} --pixel {x},{y} --sample {sample}`",
                self.header.scene.name
            ));
        }
        if !self.missing.is_empty() {
            tell(&format!("warning: the samples {} are missing; the metadata of the image say so", self.missing));
        }
        let status = Status { cut_paths, ..Status::default() };
        let bias = status.bias(&self.header.settings);
        let text = if self.json { self.figures(frame, bias.as_deref()).to_string() } else { self.line(frame, bias) };
        self.output.report(&text)
    }

    fn line(&self, frame: Option<&Frame>, bias: Option<String>) -> String {
        let output = self.output.file().map_or_else(|| self.output.to_string(), quote::path);
        let noise = frame.map_or_else(String::new, |frame| self.noise(frame));
        let counts = frame.map_or_else(String::new, |frame| format!(" ({})", frame.sample_counts()));
        let bias = bias.map_or_else(|| "unbiased".to_owned(), |why| format!("biased: {why}"));
        let rendered = format!("rendered in {:.2} s", self.header.counters.seconds);
        format!("{output}: samples {}{counts}{noise}, {bias}; {rendered}", self.samples)
    }

    /// The noise as in ", estimated error at most 2.50 %"; empty if it is unknown.
    fn noise(&self, frame: &Frame) -> String {
        if frame.is_black() {
            return ", no light found".to_owned();
        }
        // Variances of samples are exact for independent ones only.
        let bound = if frame.error_is_lower_bound {
            "≥ "
        } else if Sampler::is_independent(self.header.settings.sampler) {
            ""
        } else {
            "at most "
        };
        frame
            .rel_mse_estimate
            .map_or_else(String::new, |rel_mse| format!(", estimated error {bound}{:.2} %", 100.0 * rel_mse.sqrt()))
    }

    fn figures(&self, frame: Option<&Frame>, bias: Option<&str>) -> Value {
        let Header { scene, camera, settings, counters, .. } = self.header;
        let [width, height] = camera.resolution;
        let mut figures = figures::settings(settings);
        figures.extend(figures::named([
            ("scene", json!(scene.name)),
            ("width", json!(width)),
            ("height", json!(height)),
            ("samples", json!(self.samples.list())),
            ("missing_samples", json!(self.missing.list())),
            ("mean_spp", json!(frame.map(|frame| frame.sample_counts().mean()))),
            ("seconds", json!(counters.seconds)),
            ("rays", json!(counters.rays)),
            ("rel_mse_estimate", json!(frame.and_then(|frame| frame.rel_mse_estimate))),
            ("rel_mse_is_lower_bound", json!(frame.is_some_and(|frame| frame.error_is_lower_bound))),
            ("biased", json!(bias)),
            ("cut_paths", json!(counters.cut_paths)),
            ("program", json!(self.header.program)),
        ]));
        figures.into()
    }
}

/// The message of an image in which pixels have no samples.
pub fn without_samples(output: &Output, error: &NoSamples) -> Failure {
    format!("{output}: {error}")
}
