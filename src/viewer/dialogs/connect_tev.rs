//! The dialog that asks for the address of tev.
use egui::{Align, Align2, Button, Layout, RichText, Ui};
use noisefall_render::render::tev::{DEFAULT_ADDRESS, check_address};

use super::question::hold_keyboard;
use crate::viewer::widgets::path_field::PathField;

/// Asks for HOST:PORT.
pub struct TevDialog {
    field: PathField,
}

impl TevDialog {
    pub fn new(address: &str) -> TevDialog {
        TevDialog { field: PathField::new(address.to_owned(), DEFAULT_ADDRESS) }
    }
}

/// Shows the dialog until it is answered. Returns the address to connect to.
pub fn show(ctx: &egui::Context, dialog: &mut Option<TevDialog>) -> Option<String> {
    let TevDialog { mut field } = dialog.take()?;
    let (mut open, mut connects, mut cancelled) = (true, false, false);
    egui::Window::new("Send to tev")
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| (connects, cancelled) = dialog_body(ui, &mut field));
    if connects {
        let address = field.path.trim().to_owned();
        match check_address(&address) {
            Ok(()) => return Some(address),
            Err(error) => field.refusal = Some(format!("Not an address: {error}.")),
        }
    }
    if open && !cancelled {
        *dialog = Some(TevDialog { field });
    }
    None
}

/// Returns whether to connect, and whether to close.
fn dialog_body(ui: &mut Ui, field: &mut PathField) -> (bool, bool) {
    hold_keyboard(ui);
    ui.set_width(460.0);
    ui.label("Shows the image in tev while it is rendered: linear radiance, without exposure and tone map. Start tev first.");
    ui.add_space(4.0);
    let (mut connects, mut cancelled) = (field.show(ui), false);
    field.remark(ui, "");
    ui.horizontal(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            connects |= ui.add_enabled(field.path().is_some(), Button::new(RichText::new("Connect").strong())).clicked();
            cancelled = ui.button("Cancel").clicked();
        });
    });
    (connects, cancelled)
}
