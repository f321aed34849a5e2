//! Two areas, one above the other, with a handle between them to drag.
use egui::{Frame, Panel, Stroke, Ui, vec2};

/// Least height of either area, in points.
const LEAST: f32 = 150.0;
/// The part of the room that the upper area has at first.
const UPPER: f32 = 0.5;
/// Length of the handle in points.
const HANDLE: f32 = 36.0;

/// Shows the upper area. The room below it is for the lower one. The height stays as it was dragged.
pub fn show(ui: &mut Ui, upper: impl FnOnce(&mut Ui)) {
    let room = ui.available_height();
    let most = (room - LEAST).max(LEAST);
    let panel = Panel::top("upper area").frame(Frame::NONE).resizable(true);
    let panel = panel.default_size((UPPER * room).clamp(LEAST, most)).size_range(LEAST..=most);
    let area = panel.show(ui, |ui| {
        // The contents fill the area, whose height is the user's.
        ui.set_min_size(ui.available_size());
        upper(ui);
    });
    let middle = area.response.rect.center_bottom();
    let half = vec2(0.5 * HANDLE, 0.0);
    ui.painter().line_segment([middle - half, middle + half], Stroke::new(4.0, ui.visuals().weak_text_color()));
    ui.add_space(ui.spacing().item_spacing.y);
}
