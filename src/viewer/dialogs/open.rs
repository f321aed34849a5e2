//! The dialog that opens a scene file.
use std::path::{Path, PathBuf};

use egui::{Align, Align2, Button, Layout, RichText, vec2};

use crate::viewer::{
    background::{catalogue::in_full, recent::RecentFile},
    widgets::path_field::PathField,
};

/// Extensions of the files that can be opened.
const EXTENSIONS: [&str; 10] = ["toml", "gltf", "glb", "xml", "pbrt", "obj", "ply", "stl", "png", "exr"];

/// A field with the folder of the open scene in it.
pub fn path_field(scene: Option<&Path>) -> PathField {
    let path = scene.map(in_full);
    let folder = path.as_ref().and_then(|path| path.parent());
    let start = folder.map_or_else(String::new, |folder| folder.join("").display().to_string());
    PathField::new(start, "path/to/scene.toml")
}

/// Asks for the file to open.
pub struct OpenDialog {
    pub field: PathField,
    recent: Vec<RecentFile>,
}

impl OpenDialog {
    /// A dialog that begins in the folder of the open scene.
    pub fn new(scene: Option<&Path>, recent: Vec<RecentFile>) -> OpenDialog {
        OpenDialog { field: path_field(scene), recent }
    }
}

/// Shows the dialog until it is answered. Returns the file to open.
pub fn show(ctx: &egui::Context, dialog: &mut Option<OpenDialog>) -> Option<PathBuf> {
    let OpenDialog { mut field, recent } = dialog.take()?;
    let (mut open, mut chosen, mut cancelled, mut again) = (true, false, false, None);
    egui::Window::new("Open a scene")
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| {
            (chosen, cancelled) = dialog_body(ui, &mut field);
            again = recent_files(ui, &recent);
        });
    match again.or(field.path().filter(|_| chosen)) {
        Some(path) if path.is_file() => return Some(path),
        Some(path) => field.refusal = Some(format!("There is no file {}. Check the path, or choose Browse…", path.display())),
        None => {}
    }
    if open && !cancelled {
        *dialog = Some(OpenDialog { field, recent });
    }
    None
}

/// Shows the files that were opened last; those that are gone are disabled. Returns the one that was clicked.
fn recent_files(ui: &mut egui::Ui, files: &[RecentFile]) -> Option<PathBuf> {
    if files.is_empty() {
        return None;
    }
    ui.separator();
    ui.label(RichText::new("Recent files").strong());
    let mut chosen = None;
    for RecentFile { path, exists } in files {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let row = Button::new(name).right_text(RichText::new(folder_name(path)).weak()).truncate();
        let row = ui.add_enabled(*exists, row.frame_when_inactive(false).min_size(vec2(ui.available_width(), 0.0)));
        let row = row.on_hover_text(path.display().to_string());
        if row.on_disabled_hover_text(format!("{} is no longer there.", path.display())).clicked() {
            chosen = Some(path.clone());
        }
    }
    chosen
}

fn folder_name(path: &Path) -> String {
    path.parent().and_then(Path::file_name).unwrap_or_default().to_string_lossy().into_owned()
}

/// Returns whether to open, and whether to close.
fn dialog_body(ui: &mut egui::Ui, field: &mut PathField) -> (bool, bool) {
    ui.set_width(460.0);
    ui.label(
        "Type the path of a scene (TOML, glTF, GLB, Mitsuba XML, PBRT), of a mesh (OBJ, PLY, STL), or of an image that Noisefall has \
         saved. You can also drop the file on the window.",
    );
    ui.add_space(4.0);
    let (mut chosen, mut cancelled) = (field.show(ui), false);
    field.remark(ui, "");
    ui.horizontal(|ui| {
        let folder = field.path().and_then(|path| path.parent().map(ToOwned::to_owned));
        field.browse(ui, |dialog| {
            let dialog = dialog.add_filter("Scene, mesh or image", &EXTENSIONS);
            folder.into_iter().fold(dialog, rfd::FileDialog::set_directory).pick_file()
        });
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            chosen |= ui.add_enabled(field.path().is_some(), Button::new(RichText::new("Open").strong())).clicked();
            cancelled = ui.button("Cancel").clicked();
        });
    });
    (chosen, cancelled)
}
