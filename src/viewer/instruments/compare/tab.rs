//! The tab of the comparison: its layout, its two settings and their figures.
use egui::{ScrollArea, Ui};
use noisefall_kernel::measure::LogRatio;
use noisefall_scene::scene::RenderSettings;

use super::{comparison::CompareLayout, comparison::Comparison, figures, figures::SideStatus, menu};
use crate::viewer::widgets::{
    slider::{self, Scale},
    style::choices,
};

const LAYOUTS: [(CompareLayout, &str, &str); 3] = [
    (CompareLayout::Wipe, "Wipe", "Shows A left of a line and B right of it. Drag the line."),
    (CompareLayout::SideBySide, "Side by side", "Shows the same part of both images."),
    (CompareLayout::Difference, "Difference", "Shows A − B relative to B. If both are unbiased, this is only their noise."),
];

/// Shows the comparison, or the menu that starts one. Swapping or keeping a side changes both settings. Returns settings to compare
/// with from now on.
pub fn show(
    ui: &mut Ui,
    settings: &mut RenderSettings,
    comparison: &mut Option<Comparison>,
    wipe: &mut f32,
    of_scene: &RenderSettings,
    sides: [SideStatus; 2],
    ratio: Option<LogRatio>,
) -> Option<RenderSettings> {
    let Some(mut compare) = *comparison else {
        let row = ui.horizontal_wrapped(|ui| {
            ui.label("Choose settings to compare with. Both then get the same time.");
            menu::show(ui, settings)
        });
        return row.inner;
    };
    let (mut ends, mut chosen) = (false, None);
    ui.horizontal_wrapped(|ui| {
        choices(ui, &mut compare.layout, &LAYOUTS);
        ui.separator();
        if ui.button("Swap").on_hover_text("Exchanges A and B.").clicked() {
            std::mem::swap(settings, &mut compare.other);
        }
        if ui.button("Keep B").on_hover_text("Ends the comparison and continues with B.").clicked() {
            (*settings, ends) = (compare.other, true);
        }
        ends |= ui.button("Keep A").on_hover_text("Ends the comparison and continues with A.").clicked();
        chosen = menu::show(ui, settings);
    });
    ui.add_enabled_ui(compare.layout == CompareLayout::Wipe, |ui| {
        ui.horizontal(|ui| {
            let label = ui.label("Line").on_hover_text("Moves the line between A and B. You can also drag it in the image.");
            slider::show(ui, wipe, &Scale::linear(0.0..=1.0), 0.5, |ui, wipe| {
                ui.add(egui::Slider::new(wipe, 0.0..=1.0).show_value(false)).labelled_by(label.id)
            });
        });
    });
    *comparison = (!ends).then_some(compare);
    ui.add_space(6.0);
    ScrollArea::horizontal().show(ui, |ui| figures::show(ui, [settings, &compare.other], of_scene, sides, ratio));
    chosen
}
