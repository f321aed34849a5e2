//! "What should I use here?": the settings that a study recommends.
use egui::{Align2, Grid, ProgressBar, RichText, ScrollArea, Ui};
use noisefall_lab::study::{Advice, Candidate};
use noisefall_scene::scene::RenderSettings;

use crate::viewer::background::adviser::Adviser;
use crate::viewer::widgets::{palette::Palette, quotation::with_quotation_marks, style::over_the_picture};

/// The completed fraction; 0 while the total is unknown.
fn part_of(done: usize, whole: usize) -> f32 {
    if whole > 0 { done as f32 / whole as f32 } else { 0.0 }
}

/// Shows the progress of the study, then its advice, until a setting is chosen or the window is closed.
pub fn show(ctx: &egui::Context, adviser: &mut Option<Adviser>) -> Option<RenderSettings> {
    let study = adviser.as_mut()?;
    study.receive();
    let (mut open, mut chosen) = (true, None);
    egui::Window::new("What should I use here?")
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, over_the_picture(0.0))
        .show(ctx, |ui| {
            ui.set_width(520.0);
            match &study.advice {
                None => {
                    ui.label("Renders small test images with each candidate setting. The main render pauses meanwhile.");
                    let (done, total) = study.progress();
                    let part = part_of(done, total);
                    ui.add(ProgressBar::new(part).text(format!("{:.0} %", 100.0 * part)));
                }
                Some(Err(error)) => drop(ui.label(RichText::new(with_quotation_marks(error)).color(ui.bad()))),
                Some(Ok(advice)) => chosen = candidates(ui, advice),
            }
        });
    if !open || chosen.is_some() {
        *adviser = None;
    }
    chosen
}

const HEADINGS: [(&str, &str); 3] = [
    ("setting", "What differs from the current settings"),
    ("efficiency", "1/(relMSE · seconds) relative to the current settings, with its standard error"),
    (
        "error",
        "Relative error of one test image, the root of relMSE. ≥: these settings miss light that others found, which is most of it",
    ),
];

/// Shows the candidates. Returns the settings to use.
fn candidates(ui: &mut Ui, advice: &Advice) -> Option<RenderSettings> {
    let mut chosen = None;
    ui.label(RichText::new(advice.verdict()).color(ui.accent()).strong());
    ui.add_space(6.0);
    ScrollArea::vertical().max_height(300.0).show(ui, |ui| {
        Grid::new("candidates").num_columns(4).striped(true).spacing([18.0, 5.0]).show(ui, |ui| {
            for (heading, doc) in HEADINGS {
                ui.label(RichText::new(heading).weak()).on_hover_text(doc);
            }
            ui.label("");
            ui.end_row();
            for (number, candidate) in advice.candidates.iter().enumerate() {
                if row(ui, candidate, number == advice.best, number == advice.current) {
                    chosen = Some(candidate.settings);
                }
            }
        });
    });
    chosen
}

/// Shows a candidate. Returns whether it is to be used.
fn row(ui: &mut Ui, candidate: &Candidate, is_best: bool, is_current: bool) -> bool {
    let name = RichText::new(&candidate.name);
    ui.label(if is_best { name.strong() } else { name });
    let ratio = match candidate.misses_light {
        true => "misses light".to_owned(),
        false if is_current => "1".to_owned(),
        false => candidate.ratio(),
    };
    ui.monospace(ratio).on_hover_text(HEADINGS[1].1);
    let bound = if candidate.misses_light { "≥ " } else { "" };
    ui.monospace(format!("{bound}{:.2} %", 100.0 * candidate.rel_mse.sqrt())).on_hover_text(HEADINGS[2].1);
    let used = if is_current {
        ui.weak("in use");
        false
    } else {
        ui.small_button("Use this").on_hover_text("Apply these settings (restarts the render)").clicked()
    };
    ui.end_row();
    used
}

#[cfg(test)]
mod tests {
    use egui_kittest::{Harness, kittest::Queryable};

    use super::*;

    #[test]
    fn a_candidate_has_its_ratio_and_the_root_of_its_rel_mse() {
        let candidate = Candidate {
            settings: RenderSettings::default(),
            name: String::new(),
            efficiency: 1.0,
            relative: 2.0,
            standard_error: 0.1,
            rel_mse: 0.0025,
            misses_light: false,
            seconds: 1.0,
            spp: 4,
            rounds: 8,
        };
        let harness = Harness::builder().build_ui(|ui| assert!(!row(ui, &candidate, true, false)));
        assert!(harness.query_by_label("5.00 %").is_some() && harness.query_by_label("2.00 ± 0.20").is_some());
    }

    #[test]
    fn no_part_of_an_unknown_total_is_done() {
        assert_eq!([part_of(0, 0), part_of(0, 8), part_of(2, 8), part_of(8, 8)], [0.0, 0.0, 0.25, 1.0]);
    }

    #[test]
    fn settings_in_use_have_no_button_and_every_other_button_chooses_its_row() {
        let candidate = |seed, rel_mse, relative| Candidate {
            settings: RenderSettings { seed, ..RenderSettings::default() },
            name: format!("seed {seed}"),
            efficiency: relative,
            relative,
            standard_error: 0.1,
            rel_mse,
            misses_light: false,
            seconds: 1.0,
            spp: 4,
            rounds: 8,
        };
        let rows = vec![candidate(1, 0.0001, 3.0), candidate(2, 0.0004, 2.0), candidate(3, 0.0009, 1.0)];
        let advice = Advice { candidates: rows, best: 0, current: 2 };
        let mut chosen = None;
        let mut harness = Harness::builder().build_ui(|ui| chosen = chosen.or(candidates(ui, &advice)));
        let said = |text: &str| harness.query_by_label(text).is_some();
        assert!(said("in use") && said("1") && said("1.00 %") && said("2.00 %") && said("3.00 %"));
        let buttons: Vec<_> = harness.query_all_by_label("Use this").collect();
        assert_eq!(buttons.len(), 2);
        buttons[1].click();
        harness.run_steps(3);
        drop(harness);
        assert_eq!(chosen.map(|settings| settings.seed), Some(2));
    }
}
