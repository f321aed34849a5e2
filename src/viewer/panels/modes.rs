//! The buttons that choose what the handles over the image do.
use egui::Ui;

use crate::viewer::canvas::gizmo::Mode;

const MODES: [(Mode, &str, &str); 3] = [
    (Mode::Move, "Move", "Moves by the handles over the image. (G, while the pointer is over the image)"),
    (Mode::Rotate, "Rotate", "Rotates by the handles over the image. (R, while the pointer is over the image)"),
    (Mode::Scale, "Scale", "Scales by the handles over the image. (S, while the pointer is over the image)"),
];

/// Shows the buttons, and changes the mode.
pub fn show(ui: &mut Ui, mode: &mut Mode) {
    for (of, name, doc) in MODES {
        ui.selectable_value(mode, of, name).on_hover_text(doc);
    }
}
