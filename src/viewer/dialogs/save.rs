//! The dialog that saves the image, the curves or a path.
use std::path::PathBuf;

use egui::{Align2, Button, RichText};

use super::question::hold_keyboard;
use super::save_target::{SaveTarget, SceneNames, suggested_path};
use crate::viewer::widgets::path_field::PathField;

/// Asks where to save a file.
pub struct SaveDialog {
    target: SaveTarget,
    field: PathField,
    /// Whether the view becomes the camera of the scene; absent if it is.
    keeps_view: Option<bool>,
}

impl SaveDialog {
    /// A dialog that suggests a path.
    pub fn new(target: SaveTarget, scene: &SceneNames<'_>) -> SaveDialog {
        let path = suggested_path(target, scene).display().to_string();
        SaveDialog { target, field: PathField::of_new_file(path, "path/to/file"), keeps_view: None }
    }

    /// Adds the choice whether a view that is not the camera of the scene becomes it.
    pub fn with_view(self) -> SaveDialog {
        SaveDialog { keeps_view: Some(false), ..self }
    }

    /// The text of the field.
    #[cfg(test)]
    pub fn path(&self) -> &str {
        &self.field.path
    }
}

/// An answer.
pub enum SaveAnswer {
    /// Saves this to a file.
    File(SaveTarget, PathBuf),
    /// Makes the view the camera of the scene, and saves the scene.
    SceneWithView(PathBuf),
    /// Exports the image in another way.
    Other(OtherExport),
}

/// Exports of the image that are not one file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OtherExport {
    /// The render, to be continued.
    Progress,
    /// Numbered frames.
    Sequence,
    /// The image in tev, while it is rendered.
    Tev,
}

/// Shows the dialog until it is answered. `bounces` says whether the image is also rendered by number of bounces, which layers can have.
pub fn show(ctx: &egui::Context, dialog: &mut Option<SaveDialog>, bounces: &mut bool) -> Option<SaveAnswer> {
    let SaveDialog { mut target, mut field, mut keeps_view } = dialog.take()?;
    let (mut open, mut save, mut cancelled, mut other) = (true, false, false, None);
    egui::Window::new(target.title())
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| {
            (save, cancelled) = dialog_body(ui, &mut target, &mut field, (&mut keeps_view, bounces));
            other = other_exports(ui, target);
        });
    if let Some(other) = other {
        return Some(SaveAnswer::Other(other));
    }
    if let Some(path) = field.path().filter(|_| save).map(|path| target.completed(path)) {
        match target.check(&path) {
            Ok(()) if keeps_view == Some(true) => return Some(SaveAnswer::SceneWithView(path)),
            Ok(()) => return Some(SaveAnswer::File(target, path)),
            Err(error) => field.refusal = Some(error),
        }
    }
    if open && !cancelled {
        *dialog = Some(SaveDialog { target, field, keeps_view });
    }
    None
}

/// The choice whether an image has layers, which makes it an EXR, and whether its bounces are among them.
fn layers_choice(ui: &mut egui::Ui, target: &mut SaveTarget, field: &mut PathField, bounces: &mut bool) {
    let mut has_layers = *target == SaveTarget::Layers;
    if !has_layers && *target != SaveTarget::Picture {
        return;
    }
    let choice = ui
        .checkbox(&mut has_layers, "Layers")
        .on_hover_text("Adds layers with the first surfaces and the sample counts to an EXR.");
    if choice.changed() {
        *target = if has_layers { SaveTarget::Layers } else { SaveTarget::Picture };
        if has_layers {
            field.path = PathBuf::from(&field.path).with_extension("exr").display().to_string();
        }
        field.refusal = None;
    }
    if has_layers {
        let doc = "Adds the image of each number of bounces. Opens Bounces (F4), which renders them beside the image.";
        ui.checkbox(bounces, "Bounces").on_hover_text(doc);
    }
}

/// The buttons for other exports of an image.
fn other_exports(ui: &mut egui::Ui, target: SaveTarget) -> Option<OtherExport> {
    if !matches!(target, SaveTarget::Picture | SaveTarget::Layers) {
        return None;
    }
    ui.separator();
    let buttons = [
        ("Save checkpoint…", "Keeps the render in a file, from which it continues to the same bits.", OtherExport::Progress),
        ("Render turntable…", "Renders numbered images around the look-at point, or along a camera path.", OtherExport::Sequence),
        ("Send to tev…", "Shows the image in the viewer tev while it is rendered.", OtherExport::Tev),
    ];
    let clicked =
        |ui: &mut egui::Ui| buttons.map(|(name, doc, export)| ui.button(name).on_hover_text(doc).clicked().then_some(export));
    ui.horizontal(clicked).inner.into_iter().flatten().next()
}

/// Returns whether to save, and whether to close. A file is replaced by the button that says so, never by Enter.
fn dialog_body(
    ui: &mut egui::Ui,
    target: &mut SaveTarget,
    field: &mut PathField,
    (keeps_view, bounces): (&mut Option<bool>, &mut bool),
) -> (bool, bool) {
    hold_keyboard(ui);
    ui.set_width(460.0);
    ui.label(target.explanation());
    layers_choice(ui, target, field, bounces);
    if let Some(keeps_view) = keeps_view {
        let doc = "Makes the view on the screen the camera of the scene. Otherwise the scene keeps its camera.";
        ui.checkbox(keeps_view, "Save this view as the scene's camera").on_hover_text(doc);
    }
    let target = *target;
    ui.add_space(4.0);
    let entered = field.show(ui);
    let exists = field.path().is_some_and(|path| target.completed(path).is_file());
    field.remark(ui, if exists { "This file exists. Replace it?" } else { "" });
    let (mut save, mut cancel) = (entered && !exists, false);
    ui.horizontal(|ui| {
        let choice = if target.extensions().len() > 1 { target.extensions() } else { &[] };
        for extension in choice {
            let chosen = field.path.trim().to_ascii_lowercase().ends_with(&format!(".{extension}"));
            if ui.selectable_label(chosen, extension.to_uppercase()).clicked() {
                field.path = PathBuf::from(&field.path).with_extension(extension).display().to_string();
                field.refusal = None;
            }
        }
        let name = field.path().and_then(|path| path.file_name().map(|name| name.to_string_lossy().into_owned()));
        field.browse(ui, move |dialog| {
            let dialog = dialog.add_filter(target.extensions().join(" or ").to_uppercase(), target.extensions());
            name.into_iter().fold(dialog, rfd::FileDialog::set_file_name).save_file()
        });
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let name = RichText::new(if exists { "Replace" } else { "Save" }).strong();
            save |= ui.add_enabled(field.path().is_some(), Button::new(name)).clicked();
            cancel = ui.button("Cancel").clicked();
        });
    });
    (save, cancel)
}
