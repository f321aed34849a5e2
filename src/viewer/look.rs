//! What all panels look like.
use egui::{CollapsingHeader, RichText};

/// A part of the side panel that can be folded away.
pub(super) fn section(ui: &mut egui::Ui, title: &str, contents: impl FnOnce(&mut egui::Ui)) {
    ui.separator();
    CollapsingHeader::new(RichText::new(title).strong()).default_open(true).show_unindented(ui, |ui| {
        ui.add_space(2.0);
        contents(ui);
        ui.add_space(4.0);
    });
}

/// A grid of labels and controls; all panels have their controls at the same place.
pub(super) fn controls(ui: &mut egui::Ui, name: &str, rows: impl FnOnce(&mut egui::Ui)) {
    const LABEL_WIDTH: f32 = 96.0;
    ui.spacing_mut().slider_width = 120.0;
    egui::Grid::new(name).num_columns(2).min_col_width(LABEL_WIDTH).spacing([8.0, 8.0]).show(ui, rows);
}

/// One row: a label that explains itself, and a control that screen readers know by it.
pub(super) fn row(ui: &mut egui::Ui, label: &str, doc: &str, control: impl FnOnce(&mut egui::Ui, egui::Id)) {
    let label = ui.label(label).on_hover_text(doc);
    control(ui, label.id);
    ui.end_row();
}

/// The dark theme, with what is faint in it made legible.
pub(super) fn dark(ctx: &egui::Context) {
    ctx.set_theme(egui::Theme::Dark);
    ctx.style_mut_of(egui::Theme::Dark, |style| {
        let visuals = &mut style.visuals;
        visuals.weak_text_color = Some(egui::Color32::from_gray(150));
        visuals.widgets.noninteractive.fg_stroke.color = egui::Color32::from_gray(190);
        visuals.widgets.inactive.bg_stroke = egui::Stroke::new(1.0, egui::Color32::from_gray(85));
    });
}
