//! The dialog that opens a reference.
use std::path::{Path, PathBuf};

use super::path_form::{self, Asked, PathForm, Wanted};

/// Asks for the file.
pub struct ReferenceDialog(PathForm);

impl ReferenceDialog {
    /// A dialog that begins in the folder of the scene.
    pub fn new(scene: Option<&Path>) -> ReferenceDialog {
        ReferenceDialog(PathForm::new(scene, "path/to/reference.exr"))
    }
}

/// Shows the dialog until it is answered. Returns the file.
pub fn show(ctx: &egui::Context, dialog: &mut Option<ReferenceDialog>) -> Option<PathBuf> {
    const WANTED: Wanted<'static> = Wanted {
        text: "Type the path of a linear image (EXR, HDR) of the same size, camera and scene. Tab completes it, arrows choose. You can \
               also drop the file on the window.",
        verb: "Open",
        files: "Linear image",
        extensions: &["exr", "hdr"],
    };
    let ReferenceDialog(mut form) = dialog.take()?;
    match path_form::ask(ctx, "Open a reference", &mut form, &WANTED, |_| None) {
        Asked::File(path) => return Some(path),
        Asked::GoesOn => *dialog = Some(ReferenceDialog(form)),
        Asked::GivenUp => {}
    }
    None
}
