//! The dialog that chooses a file for a value of the scene.
use std::path::{Path as FilePath, PathBuf};

use egui::{Align, Align2, Button, Layout, RichText};
use noisefall::{
    declare::{OwnedValue, Path, Step, Textured},
    edit::{Document, Edit, Tree},
    texture::{TextureKind, image::Image},
};

use super::{
    completion::Completion,
    open::{LIST, path_field},
};
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
    completion: Completion,
}

impl FileDialog {
    /// A dialog that begins in the folder of the scene.
    pub fn new(purpose: FilePurpose, scene: Option<&FilePath>) -> FileDialog {
        let field = path_field(scene, "path/to/file").with_completion();
        FileDialog { purpose, field, completion: Completion::default() }
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
                texture_in_place(document, path, &stem, Image { path: text, ..Image::default() }.into())
            }
        }
    }

    /// What is chosen, and the extensions of its files.
    fn kind(&self) -> (&'static str, &'static [&'static str]) {
        const IMAGE: &[&str] = &["png", "jpg", "jpeg", "tga", "webp", "exr", "hdr"];
        const MESH: &[&str] = &["obj", "ply", "stl"];
        let (FilePurpose::Value(path) | FilePurpose::After(_, path) | FilePurpose::Texture(path)) = self;
        let is_mesh = path.0.iter().any(|step| matches!(step, Step::Key(key) if key == "mesh"));
        if is_mesh { ("a mesh", MESH) } else { ("an image", IMAGE) }
    }
}

/// The edit that adds a texture under a free name like `wanted`, and puts it in the place of a value.
pub fn texture_in_place(document: &mut Document, path: &Path, wanted: &str, mut texture: TextureKind) -> Edit {
    let name = document.free_name("textures", wanted);
    let value = match document.value(path) {
        Some(OwnedValue::Textured(_)) => OwnedValue::Textured(Textured::Texture(name.clone())),
        Some(OwnedValue::TexturedNumber(_)) => OwnedValue::TexturedNumber(Textured::Texture(name.clone())),
        _ => OwnedValue::Text(name.clone()),
    };
    let insert = Edit::insert_tree(Path::of("textures").key(&name), Tree::of(&mut texture));
    Edit::All(vec![insert, Edit::set(path.clone(), value)])
}

/// Shows the dialog until it is answered. Returns the file and what it is for.
pub fn show(ctx: &egui::Context, dialog: &mut Option<FileDialog>) -> Option<(FilePurpose, PathBuf)> {
    let mut asking = dialog.take()?;
    let (mut open, mut asked) = (true, Asked::default());
    egui::Window::new(format!("Choose {}", asking.purpose.kind().0))
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| asked = dialog_body(ui, &mut asking));
    let field = &mut asking.field;
    match asked.file.or(field.path().filter(|_| asked.uses)) {
        Some(path) if path.is_file() => return Some((asking.purpose, path)),
        Some(path) => field.refusal = Some(format!("There is no file {}. Check the path, or choose Browse…", path.display())),
        None => {}
    }
    if open && !asked.cancels {
        *dialog = Some(asking);
    }
    None
}

/// What a frame of the dialog asks for.
#[derive(Default)]
struct Asked {
    /// The path in the field.
    uses: bool,
    cancels: bool,
    /// This file.
    file: Option<PathBuf>,
}

fn dialog_body(ui: &mut egui::Ui, FileDialog { purpose, field, completion }: &mut FileDialog) -> Asked {
    let (what, extensions) = purpose.kind();
    let mut asked = Asked::default();
    ui.set_width(460.0);
    ui.label(format!(
        "Type the path of {what} ({}). Tab completes it, arrows choose. A file in the scene's folder is stored with a relative path.",
        extensions.join(", ").to_uppercase()
    ));
    ui.add_space(4.0);
    completion.follow(ui, field, extensions);
    let entered = field.show(ui);
    field.remark(ui, "");
    let clicked = completion.show(ui, field, LIST);
    ui.horizontal(|ui| {
        let folder = field.path().and_then(|path| path.parent().map(ToOwned::to_owned));
        field.browse(ui, |dialog| folder.into_iter().fold(dialog, rfd::FileDialog::set_directory).pick_file());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            asked.uses = ui.add_enabled(field.path().is_some(), Button::new(RichText::new("Use").strong())).clicked();
            asked.cancels = ui.button("Cancel").clicked();
        });
    });
    match clicked.or_else(|| completion.chosen(field).filter(|_| entered)) {
        Some((path, true)) => asked.file = Some(path.into()),
        Some((path, false)) => field.set(ui, path),
        None => asked.uses |= entered,
    }
    // A folder is listed, and not used.
    if let Some(folder) = field.path().filter(|path| asked.uses && path.is_dir()) {
        asked.uses = false;
        field.set(ui, folder.join("").display().to_string());
    }
    asked
}
