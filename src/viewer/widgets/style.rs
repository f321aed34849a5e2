//! The layout that all panels share.
use egui::{CollapsingHeader, Color32, RichText};

/// Width of the side panel in points.
pub const PANEL_WIDTH: f32 = 336.0;

/// Offset of a window that is anchored over the image, not over the side panel; `lift` moves it up.
pub fn over_the_picture(lift: f32) -> [f32; 2] {
    [-0.5 * PANEL_WIDTH, -lift]
}

/// Keeps contents from below the scroll bar, whether or not there is one: a bar that takes room when it appears would move the image.
pub fn leave_room_for_bar(ui: &mut egui::Ui) {
    let bar = ui.spacing().scroll.bar_width;
    ui.set_max_width(ui.available_width() - bar);
}

/// Shows a collapsible section of the side panel.
pub fn section(ui: &mut egui::Ui, title: &str, contents: impl FnOnce(&mut egui::Ui)) {
    ui.separator();
    CollapsingHeader::new(RichText::new(title).strong()).default_open(true).show_unindented(ui, |ui| {
        ui.add_space(2.0);
        contents(ui);
        ui.add_space(4.0);
    });
}

/// Shows a grid of labels and controls, with the same columns in all panels.
pub fn controls(ui: &mut egui::Ui, name: &str, rows: impl FnOnce(&mut egui::Ui)) {
    const LABEL_WIDTH: f32 = 96.0;
    // As high as the highest control, so that rows do not move when controls change.
    const ROW_HEIGHT: f32 = 20.0;
    ui.spacing_mut().slider_width = 120.0;
    egui::Grid::new(name).num_columns(2).min_col_width(LABEL_WIDTH).min_row_height(ROW_HEIGHT).spacing([8.0, 5.0]).show(ui, rows);
}

/// Shows one row: a label with a tooltip, and a control that screen readers name by the label.
pub fn row(ui: &mut egui::Ui, label: &str, doc: &str, control: impl FnOnce(&mut egui::Ui, egui::Id)) {
    let label = ui.label(label).on_hover_text(doc);
    control(ui, label.id);
    ui.end_row();
}

/// Shows a row whose control has a note below it. The label is beside the control.
pub fn row_with_note(ui: &mut egui::Ui, label: &str, doc: &str, control: impl FnOnce(&mut egui::Ui, egui::Id)) {
    // From the top of a control to the top of a label beside it.
    const DROP: f32 = 2.0;
    let label = ui.vertical(|ui| {
        ui.add_space(DROP);
        ui.label(label).on_hover_text(doc)
    });
    ui.vertical(|ui| control(ui, label.inner.id));
    ui.end_row();
}

/// Shows a row of buttons to choose one of several values, with their names and tooltips.
pub fn choices<T: Copy + PartialEq>(ui: &mut egui::Ui, chosen: &mut T, all: &[(T, &str, &str)]) {
    ui.horizontal(|ui| {
        for (value, name, doc) in all {
            ui.selectable_value(chosen, *value, *name).on_hover_text(*doc);
        }
    });
}

/// Shows text truncated to a width, with the whole text as a tooltip.
pub fn elided(ui: &mut egui::Ui, width: f32, text: impl Into<egui::WidgetText>) -> egui::Response {
    ui.scope(|ui| {
        ui.set_max_width(width);
        ui.add(egui::Label::new(text).truncate())
    })
    .inner
}

/// Shows a coloured square as the key of a legend, or its outline.
pub fn swatch(ui: &mut egui::Ui, colour: Color32, is_filled: bool) {
    let (rect, _) = ui.allocate_exact_size(egui::vec2(11.0, 11.0), egui::Sense::hover());
    if is_filled {
        ui.painter().rect_filled(rect, 2.0, colour);
    } else {
        ui.painter().rect_stroke(rect, 2.0, egui::Stroke::new(1.5, colour), egui::StrokeKind::Inside);
    }
}
