//! The panel of render settings: estimator, sampler, directions, roulette, cap and seed.
use egui::{ComboBox, RichText, Ui};
use noisefall_base::declare::OneOf;
use noisefall_render::render::Status;
use noisefall_scene::scene::{Estimator, EstimatorInForce, PathReuse, RenderSettings, Roulette, Setting};

use super::presets;
use crate::viewer::widgets::{
    kinds::{kind_list, number_rows},
    palette::Palette,
    setting,
    style::{choices, controls, elided, row, row_with_note},
};

/// Shows which side of a comparison the panel edits, and lets the user change it. The row stays where nothing is compared, so that no
/// other row moves.
pub fn side_choice(ui: &mut Ui, edits_second: Option<&mut bool>) {
    let is_comparing = edits_second.is_some();
    let mut only_first = false;
    let edits_second = edits_second.unwrap_or(&mut only_first);
    ui.add_enabled_ui(is_comparing, |ui| {
        controls(ui, "side", |ui| {
            row(ui, "Editing side", "Side of the comparison that the rows below show and change.", |ui, _| {
                choices(ui, edits_second, &[(false, "A", "The image itself."), (true, "B", "The image it is compared with.")]);
            });
        });
    });
}

/// Findings about settings in a scene.
pub struct Findings<'a> {
    pub status: &'a Status,
    /// The estimator that renders, where it is not the one of the settings.
    pub in_force: Option<&'a EstimatorInForce>,
    /// Why vertices are never merged.
    pub unmergeable: Option<&'a str>,
    /// Why the variance is infinite.
    pub caution: Option<&'a str>,
}

/// Shows the settings, and what is known of them. Returns whether advice was asked for.
pub fn show(ui: &mut Ui, settings: &mut RenderSettings, findings: &Findings<'_>) -> bool {
    controls(ui, "sampling", |ui| {
        presets::show(ui, settings);
        RenderSettings::TABLE.into_iter().for_each(|setting| setting_row(ui, setting, settings, findings));
    });
    ui.add_space(4.0);
    let doc = "Tests estimators, samplers, roulettes and path reuse for some seconds, and offers the most efficient settings.";
    ui.button("What should I use here?").on_hover_text(doc).clicked()
}

fn setting_row(ui: &mut Ui, setting: Setting, settings: &mut RenderSettings, findings: &Findings<'_>) {
    let (label, doc) = (setting.label(), setting.parameter.doc);
    if setting == RenderSettings::ESTIMATOR {
        row_with_note(ui, &label, doc, |ui, label| {
            setting::show(ui, label, setting, settings);
            estimator_note(ui, settings.estimator, findings.in_force);
        });
    } else if setting == RenderSettings::REUSE {
        row_with_note(ui, &label, doc, |ui, label| {
            setting::show(ui, label, setting, settings);
            // Always there, so that no row below moves.
            let in_force = if findings.status.spp > 0 { findings.status.path_reuse.words() } else { "…" };
            ui.weak(in_force).on_hover_text("What pixels share in this render. Auto decides once per scene.");
        });
    } else if setting == RenderSettings::ROULETTE {
        roulette_rows(ui, &mut settings.roulette, findings.caution);
    } else {
        row(ui, &label, doc, |ui, label| {
            ui.horizontal(|ui| {
                let obstacle = obstacle(setting, settings, findings);
                let control = ui.add_enabled_ui(obstacle.is_none(), |ui| setting::show(ui, label, setting, settings));
                control.response.on_disabled_hover_text(obstacle.unwrap_or_default());
                if let Some(note) = note(setting, settings, findings) {
                    elided(ui, ui.available_width(), RichText::new(note).color(ui.warning()));
                }
            });
        });
    }
}

/// Why a setting has no effect with the others.
fn obstacle<'a>(setting: Setting, settings: &RenderSettings, findings: &Findings<'a>) -> Option<&'a str> {
    if setting == RenderSettings::MERGING {
        let other = (!settings.estimator.connects()).then_some("Only the estimator Bidirectional merges vertices.");
        return other.or(findings.unmergeable);
    }
    let is_uncapped = setting == RenderSettings::COUNT_CROSSINGS && settings.max_bounces.is_none();
    is_uncapped.then_some("There is no bounce cap.")
}

/// A remark on a setting that is on.
fn note(setting: Setting, settings: &RenderSettings, findings: &Findings<'_>) -> Option<String> {
    if setting == RenderSettings::MERGING {
        return settings.merges().then(|| "biased".to_owned());
    }
    let why = not_adaptive(settings, findings).filter(|_| setting == RenderSettings::ADAPTIVE);
    why.map(|why| format!("not used: {why}"))
}

/// Why sampling is not adaptive although the settings ask for it.
fn not_adaptive(settings: &RenderSettings, findings: &Findings<'_>) -> Option<&'static str> {
    let Findings { status, in_force, .. } = *findings;
    let light_paths = in_force.map_or(settings.estimator, |in_force| in_force.estimator).traces_light_paths();
    let why = match status.path_reuse {
        PathReuse::Off => light_paths.then_some("light paths"),
        shared => Some(shared.words()),
    };
    why.filter(|_| settings.adaptive && status.spp > 0)
}

/// Shows the estimator that renders if it is another one, or else what the chosen one does.
fn estimator_note(ui: &mut Ui, estimator: Estimator, in_force: Option<&EstimatorInForce>) {
    let text = match in_force {
        Some(in_force) => in_force.to_string(),
        None if estimator == Estimator::Auto => "…".to_owned(),
        None => estimator.word().doc.to_owned(),
    };
    let width = ui.available_width();
    let explanation = in_force.map_or_else(|| estimator.explanation(), |_| format!("{text}\n\n{}", estimator.explanation()));
    elided(ui, width, RichText::new(text).weak()).on_hover_text(explanation);
}

fn roulette_rows(ui: &mut Ui, roulette: &mut Roulette, caution: Option<&str>) {
    row(ui, &RenderSettings::ROULETTE.label(), RenderSettings::ROULETTE.parameter.doc, |ui, label| {
        ui.horizontal(|ui| {
            let combo = ComboBox::from_id_salt("Roulette").selected_text(roulette.about().label());
            combo.show_ui(ui, |ui| kind_list(ui, roulette)).response.labelled_by(label);
            if let Some(caution) = caution {
                ui.colored_label(ui.warning(), "infinite variance?").on_hover_text(caution);
            }
        });
    });
    number_rows(ui, roulette);
}
