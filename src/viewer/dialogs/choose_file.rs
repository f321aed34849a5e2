//! The dialog that chooses a file for a value of the scene.
use std::path::{Path as FilePath, PathBuf};

use egui::{Align, Align2, Button, Layout, RichText};
use noisefall::{
    declare::{OwnedValue, Path, Textured},
    edit::{Document, Edit, Tree},
    texture::{TextureKind, image::Image},
};

use super::open::path_field;
use crate::viewer::widgets::path_field::PathField;

/// Purpose of the file.
#[derive(Clone, Debug, PartialEq)]
pub enum FilePurpose {
    /// The value at a path is a file.
    Value(Path),
    /// The same for a value that is there after an edit, and would make no sense without a file.
    After(Edit, Path),
    /// A texture with the image in the file stands for the value at a path.
    Texture(Path),
}

/// Asks for a file.
pub struct FileDialog {
    purpose: FilePurpose,
    field: PathField,
}

impl FileDialog {
    /// A dialog that begins in the folder of the scene.
    pub fn new(purpose: FilePurpose, scene: Option<&FilePath>) -> FileDialog {
        FileDialog { purpose, field: path_field(scene) }
    }
}

impl FilePurpose {
    /// The edit that uses a file.
    pub fn edit(&self, document: &mut Document, file: &FilePath) -> Edit {
        let text = file.display().to_string();
        match self {
            FilePurpose::Value(path) => Edit::set(path.clone(), OwnedValue::Text(text)),
            FilePurpose::After(edit, path) => Edit::All(vec![edit.clone(), Edit::set(path.clone(), OwnedValue::Text(text))]),
            FilePurpose::Texture(path) => {
                let stem = file.file_stem().unwrap_or_default().to_string_lossy();
                let name = document.free_name("textures", &stem);
                let value = match document.value(path) {
                    Some(OwnedValue::Textured(_)) => OwnedValue::Textured(Textured::Texture(name.clone())),
                    Some(OwnedValue::TexturedNumber(_)) => OwnedValue::TexturedNumber(Textured::Texture(name.clone())),
                    _ => OwnedValue::Text(name.clone()),
                };
                let mut texture = TextureKind::from(Image { path: text, ..Image::default() });
                let insert = Edit::insert_tree(Path::of("textures").key(&name), Tree::of(&mut texture));
                Edit::All(vec![insert, Edit::set(path.clone(), value)])
            }
        }
    }
}

/// Shows the dialog until it is answered. Returns the file and what it is for.
pub fn show(ctx: &egui::Context, dialog: &mut Option<FileDialog>) -> Option<(FilePurpose, PathBuf)> {
    let FileDialog { purpose, mut field } = dialog.take()?;
    let (mut open, mut chosen, mut cancelled) = (true, false, false);
    egui::Window::new("Choose a file")
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| (chosen, cancelled) = dialog_body(ui, &mut field));
    match field.path().filter(|_| chosen) {
        Some(path) if path.is_file() => return Some((purpose, path)),
        Some(path) => field.refusal = Some(format!("There is no file {}. Check the path, or choose Browse…", path.display())),
        None => {}
    }
    if open && !cancelled {
        *dialog = Some(FileDialog { purpose, field });
    }
    None
}

/// Returns whether to use the file, and whether to close.
fn dialog_body(ui: &mut egui::Ui, field: &mut PathField) -> (bool, bool) {
    ui.set_width(460.0);
    ui.label("A file in the scene's folder is stored with a relative path.");
    ui.add_space(4.0);
    let (mut chosen, mut cancelled) = (field.show(ui), false);
    field.remark(ui, "");
    ui.horizontal(|ui| {
        let folder = field.path().and_then(|path| path.parent().map(ToOwned::to_owned));
        field.browse(ui, |dialog| folder.into_iter().fold(dialog, rfd::FileDialog::set_directory).pick_file());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            chosen |= ui.add_enabled(field.path().is_some(), Button::new(RichText::new("Use").strong())).clicked();
            cancelled = ui.button("Cancel").clicked();
        });
    });
    (chosen, cancelled)
}
