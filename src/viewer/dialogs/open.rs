//! The dialog that opens a scene file.
use std::path::{Path, PathBuf};

use egui::{Align, Align2, Button, Layout, RichText};

use crate::viewer::{background::catalogue::in_full, widgets::path_field::PathField};

/// A field with the folder of the open scene in it.
pub fn path_field(scene: Option<&Path>) -> PathField {
    let path = scene.map(in_full);
    let folder = path.as_ref().and_then(|path| path.parent());
    let start = folder.map_or_else(String::new, |folder| folder.join("").display().to_string());
    PathField::new(start, "path/to/scene.toml")
}

/// Shows the dialog until it is answered. Returns the file to open.
pub fn show(ctx: &egui::Context, dialog: &mut Option<PathField>) -> Option<PathBuf> {
    let mut field = dialog.take()?;
    let (mut open, mut chosen, mut cancelled) = (true, false, false);
    egui::Window::new("Open a scene")
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| (chosen, cancelled) = dialog_body(ui, &mut field));
    let path = field.path().filter(|_| chosen);
    match path {
        Some(path) if path.is_file() => return Some(path),
        Some(path) => field.refusal = Some(format!("There is no file {}. Check the path, or choose Browse…", path.display())),
        None => {}
    }
    if open && !cancelled {
        *dialog = Some(field);
    }
    None
}

/// Returns whether to open, and whether to close.
fn dialog_body(ui: &mut egui::Ui, field: &mut PathField) -> (bool, bool) {
    ui.set_width(460.0);
    ui.label(
        "Type the path of a scene (TOML), or of an image that Noisefall has saved. You can also drop the file on the window.",
    );
    ui.add_space(4.0);
    let (mut chosen, mut cancelled) = (field.show(ui), false);
    field.remark(ui, "");
    ui.horizontal(|ui| {
        let folder = field.path().and_then(|path| path.parent().map(ToOwned::to_owned));
        field.browse(ui, |dialog| {
            let dialog = dialog.add_filter("Noisefall scene or image", &["toml", "png", "exr"]);
            folder.into_iter().fold(dialog, rfd::FileDialog::set_directory).pick_file()
        });
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            chosen |= ui.add_enabled(field.path().is_some(), Button::new(RichText::new("Open").strong())).clicked();
            cancelled = ui.button("Cancel").clicked();
        });
    });
    (chosen, cancelled)
}
