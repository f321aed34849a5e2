//! Two settings of the same scene, seen together and rendered in the same time.
mod figures;

use egui::Ui;
use noisefall::{
    render::view::View,
    sampling::SAMPLERS,
    scene::{Estimator, RenderSettings, Reuse, Roulette},
};

use super::{app::App, canvas::Split, dock::Tab};

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
    all.push(of("A cap of 3 bounces", RenderSettings { max_bounces: Some(3), ..*settings }));
    all.push(of("Another seed", RenderSettings { seed: settings.seed.wrapping_add(1), ..*settings }));
    all.retain(|(_, changed)| changed != settings);
    all
}

impl App {
    /// The menu that starts a comparison with one click: what was chosen.
    pub(super) fn compare_menu(&self, ui: &mut Ui) -> Option<RenderSettings> {
        let mut chosen = None;
        let response = ui.menu_button("Compare with…", |ui| {
            for (name, other) in alternatives(&self.settings) {
                if ui.button(name).clicked() {
                    chosen = Some(other);
                    ui.close();
                }
            }
        });
        response.response.on_hover_text("Render other settings of this scene in the same time, and see both");
        chosen
    }

    /// The comparison, while its instrument renders.
    pub(super) fn comparison(&self) -> Option<Compare> {
        self.compare.filter(|_| self.dock != Some(Tab::Bounces))
    }

    pub(super) fn start_comparison(&mut self, other: RenderSettings) {
        let layout = self.compare.map_or(Layout::Wipe, |compare| compare.layout);
        self.compare = Some(Compare { other, layout, edits_other: false });
        self.dock = Some(Tab::Compare);
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
                self.compare_menu(ui).into_iter().for_each(|other| self.start_comparison(other));
            });
            return;
        };
        let (mut ends, mut chosen) = (false, None);
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
            chosen = self.compare_menu(ui);
        });
        if compare.layout == Layout::Wipe {
            let label = ui.label("Line").on_hover_text("Where the wipe is: drag it in the picture, or here");
            ui.add(egui::Slider::new(&mut self.view.wipe, 0.0..=1.0).show_value(false)).labelled_by(label.id);
        }
        self.compare = (!ends).then_some(compare);
        ui.add_space(6.0);
        self.figures_of_both(ui, &compare);
        chosen.into_iter().for_each(|other| self.start_comparison(other));
    }
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
        let place = |name: &str| all.iter().position(|(other, _)| other.starts_with(name)).unwrap_or(usize::MAX);
        let order = ["Path", "Independent", "No roulette", "Roulette of 0.8", "Shared", "A cap", "Another seed"].map(place);
        assert!(order.is_sorted() && order[6] == all.len() - 1, "{order:?}");
    }
}
