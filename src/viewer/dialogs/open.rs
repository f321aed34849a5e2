//! The dialog that opens a scene file.
use std::path::{Path, PathBuf};

use egui::{Button, RichText, ScrollArea, vec2};

use super::path_form::{self, Asked, PathForm, Wanted};
use crate::viewer::background::recent::RecentFile;

/// Extensions of the files that can be opened.
const EXTENSIONS: [&str; 11] = ["toml", "nf", "gltf", "glb", "xml", "pbrt", "obj", "ply", "stl", "png", "exr"];

/// Height of the window without the recent files, and their least height, points.
const AROUND_RECENT: f32 = 400.0;
const LEAST_RECENT: f32 = 60.0;

/// Asks for the file to open.
pub struct OpenDialog {
    pub form: PathForm,
    recent: Vec<RecentFile>,
}

impl OpenDialog {
    /// A dialog that begins in the folder of the open scene.
    pub fn new(scene: Option<&Path>, recent: Vec<RecentFile>) -> OpenDialog {
        OpenDialog { form: PathForm::new(scene, "path/to/scene.toml"), recent }
    }
}

/// Shows the dialog until it is answered. Returns the file to open.
pub fn show(ctx: &egui::Context, dialog: &mut Option<OpenDialog>) -> Option<PathBuf> {
    const WANTED: Wanted<'static> = Wanted {
        text: "Type the path of a scene (TOML, glTF, GLB, Mitsuba XML, PBRT), of a mesh (OBJ, PLY, STL), or of an image that Noisefall \
               has saved. Tab completes it, arrows choose. You can also drop the file on the window.",
        verb: "Open",
        files: "Scene, mesh or image",
        extensions: &EXTENSIONS,
    };
    let mut asking = dialog.take()?;
    let OpenDialog { form, recent } = &mut asking;
    match path_form::ask(ctx, "Open a scene", form, &WANTED, |ui| recent_files(ui, recent)) {
        Asked::File(path) if can_be_scene(&path) => return Some(path),
        Asked::File(path) => form.field.refusal = Some(foreign(&path)),
        Asked::GoesOn => {}
        Asked::GivenUp => return None,
    }
    *dialog = Some(asking);
    None
}

/// Whether a file may be a scene, a mesh or a saved image, by its name. A scene of our own may have any extension that no program claims.
fn can_be_scene(path: &Path) -> bool {
    const OTHERS: [&str; 13] = ["avif", "bmp", "csv", "gif", "hdr", "jpeg", "jpg", "mtl", "pdf", "pfm", "tga", "tiff", "webp"];
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
        let folders = folders(files);
        files.iter().zip(&folders).for_each(|(file, folder)| chosen = recent_row(ui, file, folder).or(chosen.take()));
    });
    chosen
}

fn recent_row(ui: &mut egui::Ui, RecentFile { path, exists }: &RecentFile, folder: &str) -> Option<PathBuf> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let row = Button::new(name).right_text(RichText::new(folder).weak()).truncate();
    let row = ui.add_enabled(*exists, row.frame_when_inactive(false).min_size(vec2(ui.available_width(), 0.0)));
    let row = row.on_hover_text(path.display().to_string());
    row.on_disabled_hover_text(format!("{} is no longer there.", path.display())).clicked().then(|| path.clone())
}

/// The folder of each file: its name, or as much more of its path as tells files of one name apart.
fn folders(files: &[RecentFile]) -> Vec<String> {
    let parts = |path: &Path| -> Vec<String> {
        let folder = path.parent().map(|folder| folder.iter().map(|part| part.to_string_lossy().into_owned()).collect());
        folder.unwrap_or_default()
    };
    let end = |parts: &[String], count: usize| parts[parts.len().saturating_sub(count)..].join("/");
    let of = |file: &RecentFile| {
        let own = parts(&file.path);
        let others = files.iter().filter(|other| other.path != file.path && other.path.file_name() == file.path.file_name());
        let others: Vec<Vec<String>> = others.map(|other| parts(&other.path)).collect();
        let is_alone = |count: &usize| others.iter().all(|other| end(other, *count) != end(&own, *count));
        end(&own, (1..own.len().max(1)).find(is_alone).unwrap_or(own.len().max(1)))
    };
    files.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_one_name_are_told_apart_by_their_folders() {
        let paths =
            ["/home/a/one/scenes/room.toml", "/home/a/two/scenes/room.toml", "/home/a/two/scenes/ball.toml", "/room.toml"];
        let files = paths.map(|path| RecentFile { path: path.into(), exists: true });
        assert_eq!(folders(&files), ["one/scenes", "two/scenes", "scenes", "/"]);
    }
}
