//! The panel of render settings: estimator, sampler, directions, roulette, cap and seed.
use egui::{ComboBox, Id, Ui};
use noisefall::{
    render::Status,
    sampling::{Directions, Sampler},
    scene::{Estimator, RenderSettings, Reuse, Roulette},
};

use crate::viewer::widgets::{
    number,
    palette::Palette,
    style::{choices, controls, row},
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

/// Shows which side of a comparison the panel edits, and lets the user change it.
pub fn side_choice(ui: &mut Ui, edits_second: &mut bool) {
    ui.horizontal(|ui| {
        ui.label("Settings of").on_hover_text("The two sides of the comparison below the picture");
        ui.selectable_value(edits_second, false, "A");
        ui.selectable_value(edits_second, true, "B");
    });
    ui.add_space(4.0);
}

/// Shows the settings, with a caution where their variance is infinite. Returns whether advice was asked for.
pub fn show(ui: &mut Ui, settings: &mut RenderSettings, status: &Status, caution: Option<&str>) -> bool {
    controls(ui, "sampling", |ui| {
        row(ui, "Estimator", "How light L_o is found at x_M. All converge to the same picture.", |ui, _| {
            choices(ui, &mut settings.estimator, &ESTIMATORS);
        });
        sampler_row(ui, &mut settings.sampler);
        row(
            ui,
            "Directions",
            "How the next direction ω_i is drawn over the hemisphere at a diffuse surface: its density p(ω_i).",
            |ui, _| choices(ui, &mut settings.directions, &DIRECTIONS),
        );
        reuse_row(ui, &mut settings.reuse, status);
        row(
            ui,
            "Adaptive",
            "More samples N where a pilot, whose own samples do not count, finds more noise. Not where pixels share paths.",
            |ui, label| drop(ui.checkbox(&mut settings.adaptive, "").labelled_by(label)),
        );
        roulette_rows(ui, &mut settings.roulette, caution);
        row(
            ui,
            "Bounce cap",
            "n, the highest number of bounces counted, reflections and refractions alike: the series L_e + T L_e + … is cut after T^n L_e, and the picture is biased.",
            |ui, label| {
                number::optional(ui, label, &mut settings.max_bounces, ("no cap", "bounces"), DEFAULT_CAP, 0, 0.0..=4096.0);
            },
        );
        row(ui, "Seed", "Which random numbers are drawn: another seed gives other noise around the same mean.", |ui, label| {
            let field = number::field(ui, &mut settings.seed, 0, 0.0..=u32::MAX.into());
            ui.add(field).labelled_by(label);
        });
    });
    ui.add_space(4.0);
    let doc =
        "Try samplers, roulettes and estimators on this picture for some seconds, and offer the most efficient with figures";
    ui.button("What should I use here?").on_hover_text(doc).clicked()
}

fn sampler_row(ui: &mut Ui, sampler: &mut Sampler) {
    let doc = "Which points of the unit cube the N samples of a pixel are: they decide how fast the noise falls.";
    row(ui, "Sampler", doc, |ui, label| {
        let combo = ComboBox::from_id_salt("Sampler").selected_text(sampler.word().title).show_ui(ui, |ui| {
            for (value, word) in Sampler::ALL.map(|sampler| (sampler, sampler.word())) {
                ui.selectable_value(sampler, value, word.title).on_hover_text(word.doc);
            }
        });
        combo.response.labelled_by(label);
    });
}

fn reuse_row(ui: &mut Ui, reuse: &mut Reuse, status: &Status) {
    let doc = "Whether neighbouring pixels share the light that their paths find beyond the first diffuse surface: less noise, no bias.";
    row(ui, "Share paths", doc, |ui, _| {
        // Below, and not beside: the panel is as wide as its widest row.
        ui.vertical(|ui| {
            choices(ui, reuse, &REUSE);
            if *reuse == Reuse::Auto && status.spp > 0 {
                ui.weak(if status.shares { "in use here" } else { "not in use here" });
            }
        });
    });
}

fn roulette_rows(ui: &mut Ui, roulette: &mut Roulette, caution: Option<&str>) {
    let doc = "Ends paths at random with probability 1 − q and weights the survivors by 1/q: shorter paths, no bias.";
    row(ui, "Roulette", doc, |ui, label| {
        // Below, and not beside, as above.
        ui.vertical(|ui| {
            roulette_choice(ui, label, roulette);
            if let Some(caution) = caution {
                ui.colored_label(ui.warning(), "infinite variance?").on_hover_text(caution);
            }
        });
    });
    if let Roulette::Fixed(q) = roulette {
        row(ui, "Survival", "The probability q with which a path goes on after a bounce.", |ui, label| {
            let slider = number::slider(ui, q, 3, 0.05..=1.0);
            ui.add(slider).labelled_by(label);
        });
    }
}

fn roulette_choice(ui: &mut Ui, label: Id, roulette: &mut Roulette) {
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
