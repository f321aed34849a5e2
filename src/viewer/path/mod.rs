//! The path inspector: the samples of a pixel, and single paths vertex by vertex.
mod copying;
mod drawing;
mod findings;
mod histogram;
mod projection;
mod table;

use egui::{RichText, ScrollArea, Ui, scroll_area::ScrollBarVisibility};
use noisefall::math::colour::luminance;

pub(super) use self::copying::Form;
pub use self::findings::Inspector;
use self::findings::MOST_SAMPLES;
use super::{app::App, canvas::Tool, dock::Tab, look::Inks, number};

impl App {
    /// A click on the picture.
    pub(super) fn click(&mut self, pixel: [u32; 2]) {
        if self.tool == Tool::Inspect {
            self.dock = Some(Tab::Path);
        }
        if self.dock == Some(Tab::Path) {
            self.inspector.look_at(pixel);
        }
    }

    /// Has what the inspector shows found, while it is open.
    pub(super) fn inspect(&mut self) {
        if let Some(wish) = self.link.wish().filter(|_| self.dock == Some(Tab::Path)) {
            let spp = self.shown.as_ref().map_or(1, |frame| frame.spp);
            self.inspector.search(wish, spp);
        }
    }

    pub(super) fn path_tab(&mut self, ui: &mut Ui) {
        let Some(pixel) = self.inspector.pixel else {
            ui.label("Click a pixel of the picture to see its samples and the paths they came by.");
            if ui.button("The pixel in the middle").clicked() {
                let middle = self.camera.resolution.map(|side| side / 2);
                self.inspector.look_at(middle);
            }
            return;
        };
        egui::Panel::left("pixel").resizable(false).exact_size(312.0).show(ui, |ui| {
            ScrollArea::vertical().show(ui, |ui| self.pixel_column(ui, pixel));
        });
        if let Some(failure) = self.inspector.failure() {
            let text = format!("{failure}: please report it, with the command in the line below.");
            ui.label(RichText::new(text).color(ui.bad()));
            return;
        }
        let Some((sample, replay)) = self.inspector.replay() else {
            ui.weak("Tracing the samples of this pixel …");
            return;
        };
        let objects = self.link.wish().map_or(&[][..], |wish| &wish.scene.objects);
        egui::Frame::new().inner_margin(egui::Margin { left: 8, ..egui::Margin::ZERO }).show(ui, |ui| {
            table::heading(ui, sample, replay);
            let bars = ScrollBarVisibility::AlwaysVisible;
            ScrollArea::both().auto_shrink(false).scroll_bar_visibility(bars).show(ui, |ui| table::show(ui, replay, objects));
        });
    }

    fn pixel_column(&mut self, ui: &mut Ui, pixel: [u32; 2]) {
        let [width, height] = self.camera.resolution;
        let mut at = pixel;
        ui.horizontal(|ui| {
            ui.label("Pixel");
            for (axis, name, most) in [(0, "x", width), (1, "y", height)] {
                let label = ui.weak(name);
                let field = number::field(ui, &mut at[axis], 0, 0.0..=f64::from(most.saturating_sub(1)));
                ui.add(field).labelled_by(label.id);
            }
        });
        if at != pixel {
            self.inspector.look_at(at);
        }
        if let Some((frame, index)) = self.shown.as_ref().and_then(|frame| Some((frame, frame.index_at(pixel)?))) {
            let y = luminance(frame.radiance[index]);
            let error = Some(frame.standard_error[index]).filter(|error| error.is_finite());
            let error = error.map_or_else(String::new, |error| format!(" ± {error:.4}"));
            ui.label(format!("L = {y:.4}{error}, N = {}", frame.spp_at(index))).on_hover_text(
                "Luminance of the estimate, its standard error, and the number of samples, of the picture as shown",
            );
        }
        self.sample_choice(ui);
        let Some(histogram) = self.inspector.histogram() else { return };
        if let Some(sample) = histogram::show(ui, histogram, self.inspector.sample) {
            self.inspector.sample = sample;
        }
        ui.weak("Over the picture: its path in yellow; light samples in blue, faint where hidden.");
        self.copy_buttons(ui);
    }

    /// Which sample is seen vertex by vertex.
    fn sample_choice(&mut self, ui: &mut Ui) {
        let brightest = self.inspector.histogram().map(|histogram| histogram.brightest);
        let sample = &mut self.inspector.sample;
        ui.horizontal(|ui| {
            let label = ui.label("Sample").on_hover_text("The number of the sample: it and the pixel decide the path, for ever");
            if ui.add_enabled(*sample > 0, egui::Button::new("Previous")).on_hover_text("The sample before").clicked() {
                *sample -= 1;
            }
            let field = number::field(ui, sample, 0, 0.0..=f64::from(u32::MAX));
            ui.add(field).labelled_by(label.id);
            if ui.button("Next").on_hover_text("The next sample").clicked() {
                *sample = sample.saturating_add(1);
            }
            if let Some(brightest) = brightest
                && ui.button("Brightest").on_hover_text("The one that brings most light: where noise comes from").clicked()
            {
                *sample = brightest;
            }
        });
    }
}

/// What is said of paths that are shared.
fn remark(ui: &mut Ui, alone: Option<[f32; 3]>) {
    if let Some(alone) = alone {
        let text = format!(
            "Pixels share what paths find: this one brought {}, the last Σ. With Share paths on Never both agree.",
            table::colour(alone)
        );
        ui.label(RichText::new(text).color(ui.warning()));
    }
}

/// How many of the picture's samples the histogram has: a power of two, for twice as many are worth another look.
fn count_of(spp: u32) -> u32 {
    1 << spp.clamp(1, MOST_SAMPLES).ilog2()
}

#[cfg(test)]
mod tests {
    use super::{MOST_SAMPLES, count_of};

    #[test]
    fn a_histogram_has_a_power_of_two_of_the_samples_there_are() {
        assert_eq!([0, 1, 2, 3, 63, 64, 100_000].map(count_of), [1, 1, 2, 2, 32, 64, MOST_SAMPLES]);
    }
}
