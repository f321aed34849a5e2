//! Two settings of the same scene, seen together and rendered in the same time.
use egui::{Grid, RichText, Ui};
use noisefall::{
    render::{State, Status, view::View},
    sampling::SAMPLERS,
    scene::{Estimator, RenderSettings, Reuse, Roulette},
};

use super::{
    app::App,
    canvas::Split,
    convergence::name,
    darkroom::Against,
    look::{self, Inks},
};

/// Settings B, beside those of the picture, which are A.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compare {
    pub other: RenderSettings,
    pub layout: Layout,
    /// The panel changes B, and not A.
    pub edits_other: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Layout {
    Wipe,
    SideBySide,
    /// A less B.
    Difference,
}

const LAYOUTS: [(Layout, &str, &str); 3] = [
    (Layout::Wipe, "Wipe", "A at the left of a line, B at the right of it: drag the line"),
    (Layout::SideBySide, "Side by side", "The same part of both pictures"),
    (Layout::Difference, "Difference", "A less B, in parts of B: noise of both, and nothing else where both are unbiased"),
];

impl Layout {
    /// How the canvas is divided.
    pub fn split(self) -> Split {
        match self {
            Layout::Wipe => Split::Wipe,
            Layout::SideBySide => Split::SideBySide,
            Layout::Difference => Split::None,
        }
    }
}

/// One change of settings, by what it is called.
fn alternatives(settings: &RenderSettings) -> Vec<(String, RenderSettings)> {
    let of = |name: &str, changed: RenderSettings| (name.to_owned(), changed);
    let mut all = Vec::new();
    for (estimator, title) in [(Estimator::Path, "Path sampling"), (Estimator::Light, "Light sampling"), (Estimator::Mis, "MIS")]
    {
        all.push(of(title, RenderSettings { estimator, ..*settings }));
    }
    for entry in &SAMPLERS {
        all.push((format!("{} samples", entry.title), RenderSettings { sampler: entry.sampler, ..*settings }));
    }
    for (roulette, title) in [
        (Roulette::Off, "No roulette"),
        (Roulette::Fixed(0.8), "Roulette of 0.8"),
        (Roulette::BY_THROUGHPUT, "Roulette by throughput"),
    ] {
        all.push(of(title, RenderSettings { roulette, ..*settings }));
    }
    for (reuse, title) in [(Reuse::On, "Shared paths"), (Reuse::Off, "Paths of their own")] {
        all.push(of(title, RenderSettings { reuse, ..*settings }));
    }
    all.push(of("A cap of 3 reflections", RenderSettings { max_bounces: Some(3), ..*settings }));
    all.push(of("Another seed", RenderSettings { seed: settings.seed.wrapping_add(1), ..*settings }));
    all.retain(|(_, changed)| changed != settings);
    all
}

impl App {
    /// The menu that starts a comparison with one click.
    pub(super) fn compare_menu(&mut self, ui: &mut Ui) {
        let response = ui.menu_button("Compare with…", |ui| {
            for (name, other) in alternatives(&self.settings) {
                if ui.button(name).clicked() {
                    self.start_comparison(other);
                    ui.close();
                }
            }
        });
        response.response.on_hover_text("Render other settings of this scene in the same time, and see both");
    }

    pub(super) fn start_comparison(&mut self, other: RenderSettings) {
        let layout = self.compare.map_or(Layout::Wipe, |compare| compare.layout);
        self.compare = Some(Compare { other, layout, edits_other: false });
        self.dock = Some(super::dock::Tab::Compare);
    }

    /// The settings that the panel shows and changes.
    pub(super) fn edited(&mut self) -> &mut RenderSettings {
        match &mut self.compare {
            Some(compare) if compare.edits_other => &mut compare.other,
            _ => &mut self.settings,
        }
    }

    pub(super) fn compare_tab(&mut self, ui: &mut Ui) {
        let Some(mut compare) = self.compare else {
            ui.horizontal(|ui| {
                ui.label("Choose what to compare this picture with: both get the same time.");
                self.compare_menu(ui);
            });
            return;
        };
        let mut ends = false;
        ui.horizontal(|ui| {
            for (layout, name, doc) in LAYOUTS {
                ui.selectable_value(&mut compare.layout, layout, name).on_hover_text(doc);
            }
            ui.separator();
            if ui.button("Swap").on_hover_text("A becomes B, and B becomes A").clicked() {
                std::mem::swap(&mut self.settings, &mut compare.other);
            }
            if ui.button("Keep B").on_hover_text("Go on with the settings of B alone").clicked() {
                (self.settings, ends) = (compare.other, true);
            }
            ends |= ui.button("Keep A").on_hover_text("End the comparison").clicked();
            self.compare_menu(ui);
        });
        if compare.layout == Layout::Wipe {
            let label = ui.label("Line").on_hover_text("Where the wipe is: drag it in the picture, or here");
            ui.add(egui::Slider::new(&mut self.view.wipe, 0.0..=1.0).show_value(false)).labelled_by(label.id);
        }
        self.compare = (!ends).then_some(compare);
        ui.add_space(6.0);
        self.figures_of_both(ui, &compare);
    }

    fn figures_of_both(&self, ui: &mut Ui, compare: &Compare) {
        let of_scene = self.opened.as_ref().map_or_else(RenderSettings::default, |opened| opened.scene.settings);
        let sides = [
            Side::of("A", name(&self.settings, &of_scene), &self.status, &self.settings, self.against),
            Side::of("B", name(&compare.other, &of_scene), &self.status_beside, &compare.other, self.against_beside),
        ];
        Grid::new("A and B").num_columns(8).spacing([18.0, 5.0]).show(ui, |ui| {
            for (heading, doc) in HEADINGS {
                ui.label(RichText::new(heading).weak()).on_hover_text(doc);
            }
            ui.end_row();
            for side in &sides {
                side.row(ui);
            }
        });
        ui.add_space(4.0);
        if let Some(text) = incomparable(&sides) {
            ui.label(RichText::new(text).color(ui.warning()));
        } else if let [Some(a), Some(b)] = sides.each_ref().map(|side| side.efficiency) {
            let (text, more) = verdict(a, b);
            ui.label(RichText::new(text).color(ui.accent())).on_hover_text(more);
        } else {
            ui.weak("Figures come with the second sample of both.");
        }
    }
}

const HEADINGS: [(&str, &str); 8] = [
    ("", ""),
    ("settings", "What differs from how the scene opens"),
    ("N", "Samples per pixel"),
    ("time", "Seconds of rendering: both get the same since the comparison began"),
    ("noise", "Estimated relative error: the root of relMSE"),
    ("true error", "Relative error against the truth, where that is known"),
    ("efficiency", "1/(relMSE · seconds): twice as much is the same error in half the time"),
    ("converges to", "Whether the expected picture is the solution of the equation"),
];

/// The figures of one side.
struct Side {
    letter: &'static str,
    name: String,
    spp: u32,
    seconds: f64,
    noise: Option<f64>,
    truth: Option<f64>,
    efficiency: Option<f64>,
    /// Why it converges to another picture, or not at all.
    trouble: Option<String>,
}

impl Side {
    fn of(letter: &'static str, name: String, status: &Status, settings: &RenderSettings, against: Option<Against>) -> Side {
        let seconds = status.elapsed.as_secs_f64();
        // The truth, where it is known, sees bias as well.
        let rel_mse = against.map(|against| against.rel_mse).or(status.rel_mse_estimate).filter(|rel_mse| *rel_mse > 0.0);
        let failure =
            if let State::Failed(failure) = &status.state { Some(format!("failed: {}", failure.message)) } else { None };
        Side {
            trouble: failure.or_else(|| status.bias(settings).map(|why| format!("biased: {why}"))),
            letter,
            name,
            spp: status.spp,
            seconds,
            noise: status.relative_noise(),
            truth: against.map(|against| against.rel_mse.sqrt()),
            efficiency: rel_mse.filter(|_| status.spp >= 2).map(|rel_mse| 1.0 / (rel_mse * seconds.max(1e-9))),
        }
    }

    fn row(&self, ui: &mut Ui) {
        let percent = |x: Option<f64>| x.map_or_else(|| "–".to_owned(), |x| format!("{:.2} %", 100.0 * x));
        ui.strong(self.letter);
        look::elided(ui, 330.0, self.name.as_str()).on_hover_text(self.name.as_str());
        ui.monospace(self.spp.to_string());
        ui.monospace(format!("{:.1} s", self.seconds));
        ui.monospace(percent(self.noise));
        ui.monospace(percent(self.truth));
        ui.monospace(self.efficiency.map_or_else(|| "–".to_owned(), significant));
        match &self.trouble {
            None => ui.label(RichText::new("the solution").color(ui.good())),
            Some(trouble) => ui.label(RichText::new(trouble).color(ui.warning())),
        };
        ui.end_row();
    }
}

/// Why efficiencies say nothing: noise alone does not see that one side converges to another picture.
fn incomparable(sides: &[Side; 2]) -> Option<String> {
    let biased = sides.iter().find(|side| side.trouble.is_some() && side.truth.is_none())?;
    let letter = biased.letter;
    Some(format!(
        "{letter} does not converge to the solution: less noise does not make it nearer. The difference shows what is missing."
    ))
}

/// Three digits that count.
fn significant(x: f64) -> String {
    match x {
        0.01..10_000.0 => format!("{:.*}", (2.0 - x.log10().floor()).max(0.0) as usize, x),
        _ => format!("{x:.2e}"),
    }
}

/// Which is better, and what that means.
fn verdict(a: f64, b: f64) -> (String, String) {
    let (better, ratio) = if a >= b { ("A", a / b) } else { ("B", b / a) };
    let other = if better == "A" { "B" } else { "A" };
    if ratio < 1.05 {
        return ("Both are as good.".to_owned(), "Their efficiencies differ by less than five percent so far.".to_owned());
    }
    let text = format!("{better} is {ratio:.2} times as efficient so far.");
    (text, format!("{other} needs {ratio:.2} times the time for the same error, which falls as 1/√time."))
}

impl Compare {
    /// The view that shows both at once, where one does.
    pub fn view(&self) -> Option<View> {
        (self.layout == Layout::Difference).then_some(View::Difference)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn alternatives_differ_from_the_settings_and_from_each_other() {
        let settings = RenderSettings::default();
        let all = alternatives(&settings);
        assert!(all.len() > 8);
        for (i, (_, one)) in all.iter().enumerate() {
            assert!(*one != settings && all[..i].iter().all(|(_, other)| other != one));
        }
    }

    #[test]
    fn the_verdict_names_the_better_one() {
        assert!(verdict(2.0, 1.0).0.starts_with("A is 2.00"));
        assert!(verdict(1.0, 3.0).0.starts_with("B is 3.00"));
        assert_eq!(verdict(1.0, 1.01).0, "Both are as good.");
    }
}
