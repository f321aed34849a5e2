//! The estimate: estimator, sampler, directions, roulette, cap, seed, and when to stop.
use egui::{ComboBox, Id, Ui};
use noisefall::{
    sampling::{Directions, SAMPLERS},
    scene::{Estimator, Reuse, Roulette},
};

use super::{
    app::App,
    look::{Inks, controls, row},
    number,
};

const DEFAULT_SURVIVAL: f32 = 0.8;
const DEFAULT_CAP: u32 = 8;

const ESTIMATORS: [(Estimator, &str, &str); 3] = [
    (Estimator::Path, "Path", "Paths go on until they run into light: the equation as it stands, with most noise."),
    (
        Estimator::Light,
        "Light",
        "Every surface point samples a light (next-event estimation). Poor at glossy surfaces and large lights.",
    ),
    (Estimator::Mis, "MIS", "Both, each weighted by how likely it was to find what it found (multiple importance sampling)."),
];

const DIRECTIONS: [(Directions, &str, &str); 3] = [
    (Directions::Uniform, "Uniform", "p(ω_i) = 1 / 2π: every direction of the hemisphere alike."),
    (Directions::Cosine, "Cosine", "p(ω_i) = cos θ / π: cancels the cosine of the equation, so there is less noise."),
    (Directions::Bsdf, "BSDF", "p(ω_i) in proportion to f cos θ, which at a diffuse surface is the cosine."),
];

const REUSE: [(Reuse, &str, &str); 3] = [
    (Reuse::Auto, "Auto", "Where a short trial of the scene says that it pays."),
    (Reuse::On, "Always", "Groups of 4 × 4 pixels divide what their paths find among them, by how likely each was to find it."),
    (Reuse::Off, "Never", "Every pixel keeps what its own paths find: the noise of neighbours is independent."),
];

impl App {
    pub(super) fn sampling_panel(&mut self, ui: &mut Ui) {
        self.side_choice(ui);
        let edits_other = self.compare.is_some_and(|compare| compare.edits_other);
        let status = if edits_other { &self.status_beside } else { &self.status };
        let (spp, shares) = (status.spp, status.shares);
        let edited = *self.edited();
        let caution = self.opened.as_ref().and_then(|opened| opened.scene.infinite_variance(&edited));
        let settings = self.edited();
        controls(ui, "sampling", |ui| {
            row(ui, "Estimator", "How light L_o is found at x_M. All converge to the same picture.", |ui, _| {
                ui.horizontal(|ui| {
                    for (estimator, name, doc) in ESTIMATORS {
                        ui.selectable_value(&mut settings.estimator, estimator, name).on_hover_text(doc);
                    }
                });
            });
            row(
                ui,
                "Sampler",
                "Which points of the unit cube the N samples of a pixel are: they decide how fast the noise falls.",
                |ui, label| {
                    let combo =
                        ComboBox::from_id_salt("Sampler").selected_text(settings.sampler.entry().title).show_ui(ui, |ui| {
                            for entry in &SAMPLERS {
                                ui.selectable_value(&mut settings.sampler, entry.sampler, entry.title).on_hover_text(entry.doc);
                            }
                        });
                    combo.response.labelled_by(label);
                },
            );
            row(
                ui,
                "Directions",
                "How the next direction ω_i is drawn over the hemisphere at a diffuse surface: its density p(ω_i).",
                |ui, _| {
                    ui.horizontal(|ui| {
                        for (directions, name, doc) in DIRECTIONS {
                            ui.selectable_value(&mut settings.directions, directions, name).on_hover_text(doc);
                        }
                    });
                },
            );
            row(
                ui,
                "Share paths",
                "Whether neighbouring pixels share the light that their paths find beyond the first diffuse surface: less noise, no bias.",
                |ui, _| {
                    // Below, and not beside: the panel is as wide as its widest row.
                    ui.vertical(|ui| {
                        ui.horizontal(|ui| {
                            for (reuse, name, doc) in REUSE {
                                ui.selectable_value(&mut settings.reuse, reuse, name).on_hover_text(doc);
                            }
                        });
                        if settings.reuse == Reuse::Auto && spp > 0 {
                            ui.weak(if shares { "in use here" } else { "not in use here" });
                        }
                    });
                },
            );
            row(
                ui,
                "Adaptive",
                "More samples N where a pilot, whose own samples do not count, finds more noise. Not where pixels share paths.",
                |ui, label| {
                    ui.checkbox(&mut settings.adaptive, "").labelled_by(label);
                },
            );
            row(
                ui,
                "Roulette",
                "Ends paths at random with probability 1 − q and weights the survivors by 1/q: shorter paths, no bias.",
                |ui, label| {
                    // Below, and not beside, as above.
                    ui.vertical(|ui| {
                        roulette(ui, label, &mut settings.roulette);
                        if let Some(caution) = &caution {
                            ui.colored_label(ui.warning(), "infinite variance?").on_hover_text(caution);
                        }
                    });
                },
            );
            if let Roulette::Fixed(q) = &mut settings.roulette {
                row(ui, "Survival", "The probability q with which a path goes on after a bounce.", |ui, label| {
                    let slider = number::slider(ui, q, 3, 0.05..=1.0);
                    ui.add(slider).labelled_by(label);
                });
            }
            row(
                ui,
                "Bounce cap",
                "n, the highest number of bounces counted, reflections and refractions alike: the series L_e + T L_e + … is cut after T^n L_e, and the picture is biased.",
                |ui, label| {
                    number::optional(ui, label, &mut settings.max_bounces, ("no cap", "bounces"), DEFAULT_CAP, 0, 0.0..=4096.0);
                },
            );
            row(
                ui,
                "Seed",
                "Which random numbers are drawn: another seed gives other noise around the same mean.",
                |ui, label| {
                    let field = number::field(ui, &mut settings.seed, 0, 0.0..=u32::MAX.into());
                    ui.add(field).labelled_by(label);
                },
            );
        });
        ui.add_space(4.0);
        let doc =
            "Try samplers, roulettes and estimators on this picture for some seconds, and offer the most efficient with figures";
        if ui.button("What should I use here?").on_hover_text(doc).clicked() {
            self.ask_for_advice();
        }
    }

    /// Which side of a comparison the panel is about.
    fn side_choice(&mut self, ui: &mut Ui) {
        let Some(compare) = &mut self.compare else { return };
        ui.horizontal(|ui| {
            ui.label("Settings of").on_hover_text("The two sides of the comparison below the picture");
            ui.selectable_value(&mut compare.edits_other, false, "A");
            ui.selectable_value(&mut compare.edits_other, true, "B");
        });
        ui.add_space(4.0);
    }
}

fn roulette(ui: &mut Ui, label: Id, roulette: &mut Roulette) {
    let kinds = [
        (Roulette::Off, "Off", "Paths end at the cap, or when they carry nothing any more."),
        (Roulette::Fixed(DEFAULT_SURVIVAL), "Fixed probability", "The same survival probability q at every bounce."),
        (
            Roulette::BY_THROUGHPUT,
            "By throughput",
            "Paths that carry little die early: from the fourth bounce on, q is the throughput β, between 0.01 and 0.95.",
        ),
    ];
    let is_chosen = |roulette: &Roulette, kind: &Roulette| std::mem::discriminant(roulette) == std::mem::discriminant(kind);
    let name = kinds.iter().find(|(kind, _, _)| is_chosen(roulette, kind)).map_or("", |(_, name, _)| name);
    ui.vertical(|ui| {
        let combo = ComboBox::from_id_salt("Roulette").selected_text(name).show_ui(ui, |ui| {
            for (kind, name, doc) in kinds {
                let chosen = is_chosen(roulette, &kind);
                if ui.selectable_label(chosen, name).on_hover_text(doc).clicked() && !chosen {
                    *roulette = kind;
                }
            }
        });
        combo.response.labelled_by(label);
    });
}
