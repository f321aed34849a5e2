//! The estimate: sampler, directions, roulette, cap, seed, and when to stop.
use egui::{ComboBox, DragValue, Slider};
use noisefall::{
    sampling::{Directions, SAMPLERS},
    scene::Roulette,
};

use super::app::{App, row};

const DEFAULT_SURVIVAL: f32 = 0.8;
const DEFAULT_CAP: u32 = 8;
const DEFAULT_TARGET: u32 = 1024;

impl App {
    pub(super) fn sampling_panel(&mut self, ui: &mut egui::Ui) {
        egui::Grid::new("sampling").num_columns(2).spacing([12.0, 8.0]).show(ui, |ui| {
            row(ui, "Sampler", "Which points of the unit cube the samples of a pixel are.", |ui| {
                let sampler = &mut self.settings.sampler;
                ComboBox::from_id_salt("Sampler").selected_text(sampler.entry().title).show_ui(ui, |ui| {
                    for entry in &SAMPLERS {
                        ui.selectable_value(sampler, entry.sampler, entry.title).on_hover_text(entry.doc);
                    }
                });
            });
            row(
                ui,
                "Directions",
                "How the next direction ωᵢ is drawn over the hemisphere at a surface: the density p(ωᵢ).",
                |ui| {
                    let directions = &mut self.settings.directions;
                    ui.horizontal(|ui| {
                        ui.selectable_value(directions, Directions::Uniform, "Uniform").on_hover_text("p(ωᵢ) = 1 / 2π");
                        ui.selectable_value(directions, Directions::Cosine, "Cosine")
                            .on_hover_text("p(ωᵢ) = cos θ / π: cancels the cosine of the equation, less noise");
                    });
                },
            );
            row(ui, "Roulette", "Ends paths at random and weights the survivors by 1/q: shorter paths, no bias.", |ui| {
                self.roulette(ui);
            });
            row(
                ui,
                "Bounce cap",
                "The highest number of reflections counted. A cap leaves light out: the picture is biased.",
                |ui| {
                    optional(ui, &mut self.settings.max_bounces, "no cap", DEFAULT_CAP, 0..=4096);
                },
            );
            row(ui, "Seed", "Another seed gives another picture with other noise.", |ui| {
                ui.add(DragValue::new(&mut self.settings.seed));
            });
            row(ui, "Target", "Samples per pixel at which the render pauses. Changing it never restarts.", |ui| {
                optional(ui, &mut self.budget.max_spp, "none", DEFAULT_TARGET, 1..=1 << 24);
            });
        });
    }

    fn roulette(&mut self, ui: &mut egui::Ui) {
        let roulette = &mut self.settings.roulette;
        let name = match roulette {
            Roulette::Off => "Off",
            Roulette::Fixed(_) => "Fixed probability",
            Roulette::Throughput { .. } => "By throughput",
        };
        ui.vertical(|ui| {
            ComboBox::from_id_salt("Roulette").selected_text(name).show_ui(ui, |ui| {
                let mut choice = |ui: &mut egui::Ui, value: Roulette, name: &str, doc: &str| {
                    let chosen = std::mem::discriminant(roulette) == std::mem::discriminant(&value);
                    if ui.selectable_label(chosen, name).on_hover_text(doc).clicked() && !chosen {
                        *roulette = value;
                    }
                };
                choice(ui, Roulette::Off, "Off", "Paths end at the cap, or when they carry nothing any more.");
                choice(ui, Roulette::Fixed(DEFAULT_SURVIVAL), "Fixed probability", "The same survival probability q everywhere.");
                choice(ui, Roulette::BY_THROUGHPUT, "By throughput", "Paths that carry little die early: q is the throughput.");
            });
            if let Roulette::Fixed(q) = roulette {
                ui.add(Slider::new(q, 0.05..=1.0).fixed_decimals(2)).on_hover_text("Survival probability q");
            }
        });
    }
}

/// A number that may be absent.
fn optional(ui: &mut egui::Ui, value: &mut Option<u32>, none: &str, default: u32, range: std::ops::RangeInclusive<u32>) {
    ui.horizontal(|ui| {
        let mut present = value.is_some();
        if ui.checkbox(&mut present, "").changed() {
            *value = present.then_some(default);
        }
        match value {
            Some(number) => drop(ui.add(DragValue::new(number).range(range))),
            None => drop(ui.weak(none)),
        }
    });
}
