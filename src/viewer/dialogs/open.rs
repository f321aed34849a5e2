//! The dialog that opens a scene file.
use std::path::{Path, PathBuf};

use egui::{Align, Align2, Button, Layout, RichText, ScrollArea, vec2};

use super::completion::Completion;
use crate::viewer::{
    background::{catalogue::in_full, recent::RecentFile},
    widgets::path_field::PathField,
};

/// Extensions of the files that can be opened.
const EXTENSIONS: [&str; 11] = ["toml", "nf", "gltf", "glb", "xml", "pbrt", "obj", "ply", "stl", "png", "exr"];

/// Height of the list of the folder, points.
pub const LIST: f32 = 130.0;
/// Height of the window without the recent files, and their least height, points.
const AROUND_RECENT: f32 = 400.0;
const LEAST_RECENT: f32 = 60.0;

/// A field with the folder of the open scene in it.
pub fn path_field(scene: Option<&Path>, hint: &'static str) -> PathField {
    let path = scene.map(in_full);
    let folder = path.as_ref().and_then(|path| path.parent());
    let start = folder.map_or_else(String::new, |folder| folder.join("").display().to_string());
    PathField::new(start, hint)
}

/// Asks for the file to open.
pub struct OpenDialog {
    pub field: PathField,
    completion: Completion,
    recent: Vec<RecentFile>,
}

/// What a frame of the dialog asks for.
#[derive(Default)]
struct Asked {
    /// The path in the field.
    opens: bool,
    cancels: bool,
    /// This file.
    file: Option<PathBuf>,
}

impl OpenDialog {
    /// A dialog that begins in the folder of the open scene.
    pub fn new(scene: Option<&Path>, recent: Vec<RecentFile>) -> OpenDialog {
        OpenDialog { field: path_field(scene, "path/to/scene.toml").with_completion(), completion: Completion::default(), recent }
    }

    /// Whether the folder in the field has been read, and has this many entries to go on with.
    #[cfg(test)]
    pub fn lists(&self, count: usize) -> bool {
        self.completion.matches.len() == count
    }
}

/// Shows the dialog until it is answered. Returns the file to open.
pub fn show(ctx: &egui::Context, dialog: &mut Option<OpenDialog>) -> Option<PathBuf> {
    let mut asking = dialog.take()?;
    let (mut open, mut asked) = (true, Asked::default());
    egui::Window::new("Open a scene")
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| asked = dialog_body(ui, &mut asking));
    let field = &mut asking.field;
    match asked.file.or(field.path().filter(|_| asked.opens)) {
        Some(path) if path.is_file() && !can_be_scene(&path) => field.refusal = Some(foreign(&path)),
        Some(path) if path.is_file() => return Some(path),
        Some(path) => field.refusal = Some(format!("There is no file {}. Check the path, or choose Browse…", path.display())),
        None => {}
    }
    if open && !asked.cancels {
        *dialog = Some(asking);
    }
    None
}

/// Whether a file may be a scene, a mesh or a saved image, by its name. A scene of our own may have any extension that no program claims.
fn can_be_scene(path: &Path) -> bool {
    const OTHERS: [&str; 12] = ["avif", "bmp", "csv", "gif", "hdr", "jpeg", "jpg", "mtl", "pdf", "tga", "tiff", "webp"];
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    !OTHERS.contains(&&*extension)
}

fn foreign(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().display();
    format!("{name} is not a scene. To use an image as a texture or sky, drop it on the window.")
}

/// Shows the files that were opened last; those that are gone are disabled. Returns the one that was clicked.
fn recent_files(ui: &mut egui::Ui, files: &[RecentFile]) -> Option<PathBuf> {
    if files.is_empty() {
        return None;
    }
    ui.separator();
    ui.label(RichText::new("Recent files").strong());
    let mut chosen = None;
    let room = (ui.ctx().content_rect().height() - AROUND_RECENT).max(LEAST_RECENT);
    ScrollArea::vertical().id_salt("recent").max_height(room).show(ui, |ui| {
        files.iter().for_each(|file| chosen = recent_row(ui, file).or(chosen.take()));
    });
    chosen
}

fn recent_row(ui: &mut egui::Ui, RecentFile { path, exists }: &RecentFile) -> Option<PathBuf> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let row = Button::new(name).right_text(RichText::new(folder_name(path)).weak()).truncate();
    let row = ui.add_enabled(*exists, row.frame_when_inactive(false).min_size(vec2(ui.available_width(), 0.0)));
    let row = row.on_hover_text(path.display().to_string());
    row.on_disabled_hover_text(format!("{} is no longer there.", path.display())).clicked().then(|| path.clone())
}

fn folder_name(path: &Path) -> String {
    path.parent().and_then(Path::file_name).unwrap_or_default().to_string_lossy().into_owned()
}

fn dialog_body(ui: &mut egui::Ui, OpenDialog { field, completion, recent }: &mut OpenDialog) -> Asked {
    let mut asked = Asked::default();
    ui.set_width(460.0);
    ui.label(
        "Type the path of a scene (TOML, glTF, GLB, Mitsuba XML, PBRT), of a mesh (OBJ, PLY, STL), or of an image that Noisefall has \
         saved. Tab completes it, arrows choose. You can also drop the file on the window.",
    );
    ui.add_space(4.0);
    completion.follow(ui, field, &EXTENSIONS);
    let entered = field.show(ui);
    field.remark(ui, "");
    let clicked = completion.show(ui, field, LIST);
    buttons(ui, field, &mut asked);
    match clicked.or_else(|| completion.chosen(field).filter(|_| entered)) {
        Some((path, true)) => asked.file = Some(path.into()),
        Some((path, false)) => field.set(ui, path),
        None => asked.opens |= entered,
    }
    // A folder is listed, and not opened.
    if let Some(folder) = field.path().filter(|path| asked.opens && path.is_dir()) {
        asked.opens = false;
        field.set(ui, folder.join("").display().to_string());
    }
    asked.file = recent_files(ui, recent).or(asked.file);
    asked
}

fn buttons(ui: &mut egui::Ui, field: &PathField, asked: &mut Asked) {
    ui.horizontal(|ui| {
        let folder = field.path().and_then(|path| path.parent().map(ToOwned::to_owned));
        field.browse(ui, |dialog| {
            let dialog = dialog.add_filter("Scene, mesh or image", &EXTENSIONS);
            folder.into_iter().fold(dialog, rfd::FileDialog::set_directory).pick_file()
        });
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            asked.opens = ui.add_enabled(field.path().is_some(), Button::new(RichText::new("Open").strong())).clicked();
            asked.cancels = ui.button("Cancel").clicked();
        });
    });
}
