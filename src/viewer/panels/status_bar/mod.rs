//! The line below the image: progress, noise, bias, and the pixel under the pointer.
mod trouble;

use std::time::Duration;

use egui::{Color32, Label, RichText};
use noisefall_base::declare::capitalised;
use noisefall_render::render::{Budget, RenderRequest, State, Status};
use noisefall_scene::scene::{Camera, Estimator, EstimatorInForce, RenderSettings};

use super::pixel_readout::Pixel;
use crate::viewer::background::{display_image::ReferenceComparison, opened_scene::OpenedScene};
use crate::viewer::widgets::{counted::counted, palette::Palette, quotation::with_quotation_marks};

/// Width of a window that has room for all figures, points.
const WIDE: f32 = 1000.0;

/// The figures of the line.
pub struct StatusBar<'a> {
    pub opened: Option<&'a OpenedScene>,
    pub is_opening: bool,
    pub is_studying: bool,
    pub camera: &'a Camera,
    pub settings: &'a RenderSettings,
    /// The estimator that renders, where it is not the one of the settings.
    pub in_force: Option<EstimatorInForce>,
    pub budget: &'a Budget,
    pub status: &'a Status,
    /// The last request to the renderer.
    pub request: Option<&'a RenderRequest>,
    pub why_black: Option<&'a str>,
    pub comparison: Option<ReferenceComparison>,
    /// Relative noise of the reference itself, if it is known.
    pub reference_noise: Option<f64>,
    /// Why the image cannot be compared with the reference of the scene.
    pub mismatch: Option<String>,
    pub pixel: Option<Pixel<'a>>,
    /// The view shows a filtered image.
    pub is_denoised: bool,
}

impl StatusBar<'_> {
    /// Shows the line. Returns whether the list of remarks is asked for.
    pub fn show(&self, ui: &mut egui::Ui) -> bool {
        let mut asks = false;
        ui.horizontal(|ui| {
            let (colour, state) = self.state_text(ui);
            let (dot, _) = ui.allocate_exact_size(egui::vec2(10.0, 10.0), egui::Sense::hover());
            ui.painter().circle_filled(dot.center(), 4.5, colour);
            let reached = if let State::Done(target) = self.status.state { format!(": {target}") } else { String::new() };
            ui.label(RichText::new(state).strong())
                .on_hover_text(format!("Shows what the renderer does, or the target that it has reached{reached}."));
            if self.opened.is_none() {
                return;
            }
            ui.separator();
            if let Err(error) = self.camera.check() {
                ui.label(RichText::new("Invalid camera. The last image is shown.").color(ui.warning()))
                    .on_hover_text(with_quotation_marks(&error.to_string()));
                return;
            }
            self.estimator_label(ui);
            self.progress_labels(ui);
            // A narrow window has room for one error, and the true one says more.
            if !is_narrow(ui) || self.comparison.is_none() || self.why_black.is_some() {
                self.noise_label(ui);
            }
            self.truth_label(ui);
            ui.separator();
            self.bias_label(ui);
            self.trouble_label(ui);
            asks = self.remarks_link(ui);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                // Less room shows no number. The text is cut where it would lie over what is at the left.
                const WIDTH: f32 = 160.0;
                if ui.available_width() > WIDTH {
                    self.pixel_label(ui);
                }
            });
        });
        asks
    }

    /// The estimator that renders. It is marked where the settings name another one that this scene does not allow. A narrow window
    /// leaves the word to the tooltip.
    fn estimator_label(&self, ui: &mut egui::Ui) {
        let chosen = self.settings.estimator;
        let Some(in_force) = &self.in_force else {
            ui.label(chosen.title()).on_hover_text(chosen.word().doc);
            ui.separator();
            return;
        };
        let (title, doc) = (in_force.estimator.title(), in_force.estimator.word().doc);
        let text = if chosen == Estimator::Auto {
            RichText::new(if is_narrow(ui) { title.to_owned() } else { format!("{title} (Auto)") })
        } else {
            RichText::new(format!("{title} ({} unavailable)", chosen.title())).color(ui.warning())
        };
        ui.label(text).on_hover_text(format!("{in_force}.\n{doc}"));
        ui.separator();
    }

    /// Samples, speed and time. A narrow window has room for the samples only.
    fn progress_labels(&self, ui: &mut egui::Ui) {
        let status = self.status;
        let target = self.budget.max_spp.map_or_else(String::new, |most| format!(" / {most}"));
        let region = status.region_spp.map_or_else(String::new, |spp| format!(", {spp} in the region"));
        let (samples, speed) = (format!("{}{target} spp", status.spp), status.samples_per_second() / 1e6);
        let (speed, time) = (format!("{speed:.1} M samples/s"), clock(status.elapsed));
        const SAMPLES: &str = "Samples per pixel N so far, and the target";
        if is_narrow(ui) {
            ui.label(samples).on_hover_text(format!("{SAMPLES}{region}\n{speed}\n{time}"));
        } else {
            ui.label(samples + &region).on_hover_text(SAMPLES);
            ui.separator();
            ui.label(speed).on_hover_text("Million camera samples that the renderer takes per second.");
            ui.separator();
            ui.label(time).on_hover_text("Rendering time of the image so far.");
        }
        ui.separator();
    }

    /// The number of things that were not imported exactly. Returns whether it was clicked.
    fn remarks_link(&self, ui: &mut egui::Ui) -> bool {
        let Some(opened) = self.opened.filter(|opened| !opened.remarks.is_empty()) else { return false };
        ui.separator();
        ui.link(counted(opened.remarks.len(), "remark"))
            .on_hover_text("Lists what could not be imported exactly from the file.")
            .clicked()
    }

    fn state_text(&self, ui: &egui::Ui) -> (Color32, String) {
        let (good, warning) = (ui.good(), ui.warning());
        let (colour, text) = match self.status.state {
            _ if self.is_opening => (warning, "Opening"),
            _ if self.is_studying => (warning, "Studying"),
            _ if self.camera.check().is_err() => (warning, "Invalid settings"),
            State::Idle => (Color32::GRAY, "No scene"),
            State::Running => (good, "Running"),
            State::Paused => (warning, "Paused"),
            State::Done(_) if is_narrow(ui) => (good, "Done"),
            State::Done(target) => return (good, capitalised(&target.to_string())),
            State::Failed(_) => (ui.bad(), "Failed"),
        };
        (colour, text.to_owned())
    }

    fn noise_label(&self, ui: &mut egui::Ui) {
        if let Some(why) = self.why_black {
            ui.label(RichText::new("no light found yet").color(ui.warning()))
                .on_hover_text(format!("All samples are black: {}.", with_quotation_marks(why)));
            return;
        }
        let text = self.status.relative_noise().map_or_else(|| "–".to_owned(), percent);
        let bound = if self.status.error_is_lower_bound { "≥ " } else { "" };
        let tail = if self.status.error_is_lower_bound {
            " Few pixels carry this error (≥): paths rarely find the light that causes it, and the error may be several times larger."
        } else {
            ""
        };
        ui.label(format!("estimated error {bound}{text}")).on_hover_text(format!(
            "The root of relMSE, the mean of (x − r)²/(r² + 0.01 · mean r²) over pixels x with true radiance r. It is \
             estimated from the change of the image as the sample count doubles. It is unavailable until enough samples have hit a light.{tail}",
        ));
    }

    fn truth_label(&self, ui: &mut egui::Ui) {
        if let Some(rel_mse) = self.comparison.map(|comparison| comparison.rel_mse) {
            let doc = "Root of relMSE, the mean of (x − r)²/(r² + 0.01 · mean r²), against the reference r: that of the scene, or the one that you rendered or opened.";
            let own = self
                .reference_noise
                .map_or_else(String::new, |noise| format!(" The reference has an estimated error of {}.", percent(noise)));
            ui.label(format!("error {}", percent(rel_mse.sqrt()))).on_hover_text(format!("{doc}{own}"));
        } else if let Some(mismatch) = &self.mismatch {
            ui.label(RichText::new("error unknown").color(ui.warning())).on_hover_text(with_quotation_marks(mismatch));
        }
    }

    fn bias_label(&self, ui: &mut egui::Ui) {
        if self.is_denoised {
            let text = RichText::new("biased: denoised").color(ui.warning());
            ui.label(text).on_hover_text("The view filters the image. The samples are not changed.");
            return;
        }
        let (text, doc) = match self.status.bias(self.settings) {
            None => (
                RichText::new("unbiased").color(ui.good()),
                "The image converges to the solution of the light transport equation.",
            ),
            Some(why) => (
                RichText::new(format!("biased: {why}")).color(ui.warning()),
                "The image differs from the solution of the light transport equation, for the reason named.",
            ),
        };
        ui.add(Label::new(text).truncate()).on_hover_text(doc);
    }

    fn pixel_label(&self, ui: &mut egui::Ui) {
        let readout = self.pixel.and_then(|pixel| pixel.readout());
        if let Some(readout) = readout {
            let text = Label::new(RichText::new(&readout.text).monospace()).truncate();
            ui.add(text).on_hover_text(format!("{}\n{}", readout.text, readout.doc));
        }
    }
}

fn is_narrow(ui: &egui::Ui) -> bool {
    ui.ctx().content_rect().width() < WIDE
}

fn percent(x: f64) -> String {
    let digits = if x < 0.001 { 3 } else { usize::from(x < 0.1) + 1 };
    format!("{:.digits$} %", 100.0 * x)
}

fn clock(time: Duration) -> String {
    let seconds = time.as_secs();
    match seconds {
        0..60 => format!("{:.1} s", time.as_secs_f64()),
        60..3600 => format!("{}:{:02} min", seconds / 60, seconds % 60),
        _ => format!("{}:{:02}:{:02} h", seconds / 3600, seconds / 60 % 60, seconds % 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_and_times_are_said_with_the_digits_that_count() {
        assert_eq!([0.5, 0.0512, 0.000_123].map(percent), ["50.0 %", "5.12 %", "0.012 %"]);
        assert_eq!(
            [59.94, 61.0, 3599.0].map(|seconds| clock(Duration::from_secs_f64(seconds))),
            ["59.9 s", "1:01 min", "59:59 min"]
        );
        assert_eq!(clock(Duration::from_secs(2 * 3600 + 3 * 60 + 4)), "2:03:04 h");
    }
}
