//! The dialog that chooses a file for a value of the scene.
use std::path::{Path as FilePath, PathBuf};

use noisefall_base::declare::{OwnedValue, Path, Step, Textured};
use noisefall_edit::edit::{Document, Edit, Tree};
use noisefall_scene::{
    image::EXTENSIONS,
    texture::{TextureKind, image::Image},
};

use super::path_form::{self, Asked, PathForm, Wanted};

/// Purpose of the file.
#[derive(Clone, Debug, PartialEq)]
pub enum FilePurpose {
    /// The value at a path is a file.
    Value(Path),
    /// The value at a path is a file after an edit, which would make no sense without a file.
    After(Edit, Path),
    /// A texture with the image in the file stands for the value at a path.
    Texture(Path),
}

/// Asks for a file.
pub struct FileDialog {
    purpose: FilePurpose,
    form: PathForm,
}

impl FileDialog {
    /// A dialog that begins in the folder of the scene.
    pub fn new(purpose: FilePurpose, scene: Option<&FilePath>) -> FileDialog {
        FileDialog { purpose, form: PathForm::new(scene, "path/to/file") }
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

    /// Returns a noun for the file, and its extensions.
    fn kind(&self) -> (&'static str, &'static [&'static str]) {
        const MESH: &[&str] = &["obj", "ply", "stl"];
        let (FilePurpose::Value(path) | FilePurpose::After(_, path) | FilePurpose::Texture(path)) = self;
        let is_mesh = path.0.iter().any(|step| matches!(step, Step::Key(key) if key == "mesh"));
        if is_mesh { ("a mesh", MESH) } else { ("an image", &EXTENSIONS) }
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
    let (what, extensions) = asking.purpose.kind();
    let text = format!(
        "Type the path of {what} ({}). Tab completes it, arrows choose. A file in the scene's folder is stored with a relative path.",
        extensions.join(", ").to_uppercase()
    );
    let wanted = Wanted { text: &text, verb: "Use", files: "Image or mesh", extensions };
    match path_form::ask(ctx, &format!("Choose {what}"), &mut asking.form, &wanted, |_| None) {
        Asked::File(file) => return Some((asking.purpose, file)),
        Asked::GoesOn => *dialog = Some(asking),
        Asked::GivenUp => {}
    }
    None
}
