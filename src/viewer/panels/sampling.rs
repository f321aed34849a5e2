//! The panel of render settings: estimator, sampler, directions, roulette, cap and seed.
use egui::{Checkbox, ComboBox, RichText, Ui};
use noisefall_base::declare::OneOf;
use noisefall_render::render::Status;
use noisefall_scene::{
    sampling::Sampler,
    scene::{Estimator, EstimatorInForce, RenderSettings, Reuse, Roulette, Sharing},
};

use super::presets;
use crate::viewer::widgets::{
    kinds::{kind_list, number_rows, word_list, words},
    number,
    palette::Palette,
    style::{choices, controls, elided, row, row_with_note},
};

/// Height of the line below the estimator, points.
const HIGHEST_NOTE: f32 = 20.0;

/// Shows which side of a comparison the panel edits, and lets the user change it. The row stays where nothing is compared, so that no
/// other row moves.
pub fn side_choice(ui: &mut Ui, edits_second: Option<&mut bool>) {
    let is_comparing = edits_second.is_some();
    let mut only_first = false;
    let edits_second = edits_second.unwrap_or(&mut only_first);
    ui.add_enabled_ui(is_comparing, |ui| {
        controls(ui, "side", |ui| {
            row(ui, "Settings of", "Side of the comparison that the rows below show and change.", |ui, _| {
                choices(ui, edits_second, &[(false, "A", "The image itself."), (true, "B", "The image it is compared with.")]);
            });
        });
    });
}

/// What is known of settings in a scene.
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
    let Findings { status, in_force, unmergeable, caution } = *findings;
    controls(ui, "sampling", |ui| {
        presets::show(ui, settings);
        estimator_row(ui, settings, in_force, unmergeable);
        sampler_row(ui, &mut settings.sampler);
        row(ui, &RenderSettings::DIRECTIONS.label(), "Pdf p(ω_i) of the next direction at diffuse surfaces.", |ui, _| {
            words(ui, &mut settings.directions);
        });
        reuse_row(ui, &mut settings.reuse, status);
        let light_paths = in_force.map_or(settings.estimator, |in_force| in_force.estimator).traces_light_paths();
        adaptive_row(ui, &mut settings.adaptive, status, light_paths);
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

fn estimator_row(
    ui: &mut Ui,
    RenderSettings { estimator, merging, .. }: &mut RenderSettings,
    in_force: Option<&EstimatorInForce>,
    unmergeable: Option<&str>,
) {
    let doc = "How light is estimated. All estimators converge to the same image; they differ in noise.";
    row_with_note(ui, &RenderSettings::ESTIMATOR.label(), doc, |ui, label| {
        word_list(ui, label, estimator);
        ui.horizontal(|ui| {
            // As high as a check box, so that no row below moves.
            ui.set_min_height(ui.spacing().interact_size.y.max(HIGHEST_NOTE));
            let text = match in_force {
                Some(in_force) => in_force.to_string(),
                None if estimator.connects() => {
                    let doc = "Also takes over the light of paths from lights that end nearby (Georgiev et al. 2012). Finds caustics in mirrors. Biased, but consistent.";
                    let check_box = Checkbox::new(merging, "Merge vertices (biased)");
                    let response = ui.add_enabled(unmergeable.is_none(), check_box).on_hover_text(doc);
                    response.on_disabled_hover_text(unmergeable.unwrap_or_default());
                    return;
                }
                None if *estimator == Estimator::Auto => "…".to_owned(),
                None => estimator.word().doc.to_owned(),
            };
            let width = ui.available_width();
            elided(ui, width, RichText::new(&text).weak()).on_hover_text(text);
        });
    });
}

fn sampler_row(ui: &mut Ui, sampler: &mut Sampler) {
    let doc = "Points of the unit cube that the N samples of a pixel use. They determine how fast the noise falls.";
    row(ui, &RenderSettings::SAMPLER.label(), doc, |ui, label| word_list(ui, label, sampler));
}

fn reuse_row(ui: &mut Ui, reuse: &mut Reuse, status: &Status) {
    let doc = "Shares path suffixes (Bekaert et al. 2002) or bright samples between neighbouring pixels. Less noise, no bias.";
    row_with_note(ui, &RenderSettings::REUSE.label(), doc, |ui, label| {
        word_list(ui, label, reuse);
        // Always there, so that no row below moves.
        let in_force = if status.spp > 0 { status.sharing.name() } else { "…" };
        ui.weak(in_force).on_hover_text("What pixels share in this render. Auto decides once per scene.");
    });
}

fn adaptive_row(ui: &mut Ui, adaptive: &mut bool, status: &Status, light_paths: bool) {
    let doc = "Takes more samples where a pilot finds more noise. Not used if pixels share anything, or with paths from lights.";
    row(ui, &RenderSettings::ADAPTIVE.label(), doc, |ui, label| {
        ui.horizontal(|ui| {
            drop(ui.checkbox(adaptive, "").labelled_by(label));
            let obstacle = match status.sharing {
                Sharing::Nothing => light_paths.then_some("paths from lights"),
                shared => Some(shared.name()),
            };
            if let Some(obstacle) = obstacle.filter(|_| *adaptive && status.spp > 0) {
                elided(ui, ui.available_width(), RichText::new(format!("not used: {obstacle}")).color(ui.warning()));
            }
        });
    });
}

fn roulette_rows(ui: &mut Ui, roulette: &mut Roulette, caution: Option<&str>) {
    let doc = "Ends paths with probability 1 − q and weights the survivors by 1/q. Shorter paths, no bias.";
    row(ui, &RenderSettings::ROULETTE.label(), doc, |ui, label| {
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
