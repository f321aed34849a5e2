//! Escape discards the edit of a number field.
use egui::{Id, Key, Ui};

/// Whether Escape was pressed in this frame or the last one, because egui applies the typed text in the frame after Escape.
pub fn gave_up(ui: &Ui) -> bool {
    let (frame, escape) = (ui.ctx().cumulative_frame_nr(), ui.input(|input| input.key_pressed(Key::Escape)));
    ui.data_mut(|data| {
        let until = data.get_temp_mut_or_default::<u64>(Id::unique("edits were given up"));
        if escape {
            *until = frame + 2;
        }
        frame < *until
    })
}
