//! The panel of render settings: estimator, sampler, directions, roulette, cap and seed.
use egui::{ComboBox, Id, Ui};
use noisefall::{
    declare::OneOf,
    render::{Status, sharing::sharing_name},
    sampling::Sampler,
    scene::{Estimator, RenderSettings, Reuse, Roulette},
};

use super::presets;
use crate::viewer::widgets::{
    kinds::{kinds, number_rows, words},
    number,
    palette::Palette,
    style::{choices, controls, elided, row},
};

/// Shows which side of a comparison the panel edits, and lets the user change it. The row stays where nothing is compared, so that no
/// other row moves.
pub fn side_choice(ui: &mut Ui, edits_second: Option<&mut bool>) {
    let is_comparing = edits_second.is_some();
    let mut only_first = false;
    let edits_second = edits_second.unwrap_or(&mut only_first);
    ui.add_enabled_ui(is_comparing, |ui| {
        controls(ui, "side", |ui| {
            row(ui, "Settings of", "The side of the comparison that the rows below show and change.", |ui, _| {
                choices(ui, edits_second, &[(false, "A", "The image itself."), (true, "B", "The image it is compared with.")]);
            });
        });
    });
}

/// Shows the settings, with a caution where their variance is infinite. Returns whether advice was asked for.
pub fn show(ui: &mut Ui, settings: &mut RenderSettings, status: &Status, in_force: Option<&str>, caution: Option<&str>) -> bool {
    controls(ui, "sampling", |ui| {
        presets::show(ui, settings);
        row(
            ui,
            &RenderSettings::ESTIMATOR.label(),
            "How direct light is estimated. All converge to the same image; they differ in noise.",
            |ui, _| estimator_choice(ui, &mut settings.estimator, in_force),
        );
        sampler_row(ui, &mut settings.sampler);
        row(ui, &RenderSettings::DIRECTIONS.label(), "Pdf p(ω_i) of the next direction at diffuse surfaces.", |ui, _| {
            words(ui, &mut settings.directions);
        });
        reuse_row(ui, &mut settings.reuse, status);
        row(
            ui,
            &RenderSettings::ADAPTIVE.label(),
            "Takes more samples where a pilot finds more noise. Not used if pixels share paths.",
            |ui, label| {
                drop(ui.checkbox(&mut settings.adaptive, "").labelled_by(label));
            },
        );
        roulette_rows(ui, &mut settings.roulette, caution);
        row(
            ui,
            &RenderSettings::MAX_BOUNCES.label(),
            "Highest number of bounces n, reflections and refractions alike. A cap cuts the series L_e + T L_e + … after T^n L_e, so the image is biased.",
            |ui, label| {
                let range = 0.0..=RenderSettings::HIGHEST_CAP.into();
                let words = ("no cap", "bounces");
                number::optional(ui, label, &mut settings.max_bounces, words, RenderSettings::FIRST_CAP, 0, range);
            },
        );
        row(
            ui,
            &RenderSettings::SEED.label(),
            "Seed of the random numbers. Another seed gives different noise with the same mean.",
            |ui, label| {
                let field = number::field(ui, &mut settings.seed, 0, 0.0..=u32::MAX.into());
                ui.add(field).labelled_by(label);
            },
        );
    });
    ui.add_space(4.0);
    let doc = "Tests estimators, samplers, roulettes and sharing for some seconds, and offers the most efficient settings.";
    ui.button("What should I use here?").on_hover_text(doc).clicked()
}

/// The estimators in rows, and the one in force where it is another.
fn estimator_choice(ui: &mut Ui, estimator: &mut Estimator, in_force: Option<&str>) {
    /// Estimators in a row.
    const ROW: usize = 3;
    let all = Estimator::ALL.map(|estimator| (estimator, estimator.word().title, estimator.word().doc));
    ui.vertical(|ui| {
        all.chunks(ROW).for_each(|row| choices(ui, estimator, row));
        // Always there, so that no row below moves.
        elided(ui, ui.available_width(), in_force.unwrap_or(" "));
    });
}

fn sampler_row(ui: &mut Ui, sampler: &mut Sampler) {
    let doc = "Points of the unit cube for the N samples of a pixel. They decide how fast the noise falls.";
    row(ui, &RenderSettings::SAMPLER.label(), doc, |ui, label| {
        let combo = ComboBox::from_id_salt("Sampler").selected_text(sampler.word().title).show_ui(ui, |ui| {
            for (value, word) in Sampler::ALL.map(|sampler| (sampler, sampler.word())) {
                ui.selectable_value(sampler, value, word.title).on_hover_text(word.doc);
            }
        });
        combo.response.labelled_by(label);
    });
}

fn reuse_row(ui: &mut Ui, reuse: &mut Reuse, status: &Status) {
    let doc = "Shares path suffixes between neighbouring pixels (Bekaert et al. 2002). Less noise, no bias.";
    row(ui, &RenderSettings::REUSE.label(), doc, |ui, _| {
        // Below, and not beside: the panel is as wide as its widest row.
        ui.vertical(|ui| {
            words(ui, reuse);
            // Always there, so that no row below moves.
            let in_force = if status.spp > 0 { sharing_name(status.shares) } else { "…" };
            ui.weak(in_force).on_hover_text("What the render does now. Auto decides once for the scene.");
        });
    });
}

fn roulette_rows(ui: &mut Ui, roulette: &mut Roulette, caution: Option<&str>) {
    let doc = "Ends paths with probability 1 − q and weights the survivors by 1/q. Shorter paths, no bias.";
    row(ui, &RenderSettings::ROULETTE.label(), doc, |ui, label| {
        // Below, and not beside, as above.
        ui.vertical(|ui| {
            roulette_choice(ui, label, roulette);
            match caution {
                Some(caution) => ui.colored_label(ui.warning(), "infinite variance?").on_hover_text(caution),
                None => ui.label(" "),
            };
        });
    });
    number_rows(ui, roulette);
}

fn roulette_choice(ui: &mut Ui, label: Id, roulette: &mut Roulette) {
    ui.vertical(|ui| {
        let combo = ComboBox::from_id_salt("Roulette").selected_text(roulette.about().label());
        combo.show_ui(ui, |ui| kinds(ui, roulette)).response.labelled_by(label);
    });
}
