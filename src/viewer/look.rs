//! What all panels look like.
use egui::{CollapsingHeader, Color32, RichText};

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

/// Text cut to a width; a tooltip says all of it.
pub(super) fn elided(ui: &mut egui::Ui, width: f32, text: impl Into<egui::WidgetText>) -> egui::Response {
    ui.scope(|ui| {
        ui.set_max_width(width);
        ui.add(egui::Label::new(text).truncate())
    })
    .inner
}

/// Good, to be minded, wrong: as light as text on a dark ground must be.
pub(super) const GREEN: Color32 = Color32::from_rgb(80, 180, 110);
pub(super) const AMBER: Color32 = Color32::from_rgb(222, 160, 60);
pub(super) const RED: Color32 = Color32::from_rgb(228, 96, 88);

/// The dark theme, with what is faint in it made legible.
pub(super) fn dark(ctx: &egui::Context) {
    ctx.set_theme(egui::Theme::Dark);
    ctx.style_mut_of(egui::Theme::Dark, |style| {
        // Lists are as tall as they say, within the window.
        style.spacing.default_area_size.y = 4096.0;
        let visuals = &mut style.visuals;
        visuals.weak_text_color = Some(Color32::from_gray(150));
        (visuals.warn_fg_color, visuals.error_fg_color) = (AMBER, RED);
        visuals.widgets.noninteractive.fg_stroke.color = Color32::from_gray(190);
        visuals.widgets.inactive.bg_stroke = egui::Stroke::new(1.0, Color32::from_gray(85));
    });
}
