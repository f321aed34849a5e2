//! Where to save the picture.
use std::path::PathBuf;

use egui::{Align2, Button, RichText};
use noisefall::render::{image_file::check_target, settings_text::settings_text};

use super::{app::App, path_field::PathField, saver::Request};

impl App {
    /// Whether what is shown is the full picture of what the controls say.
    pub(super) fn can_save(&self) -> bool {
        self.shown.as_ref().is_some_and(|frame| !frame.is_coarse() && frame.generation == self.link.generation())
    }

    pub(super) fn open_save_dialog(&mut self) {
        if self.save_dialog.is_none() {
            self.save_dialog = Some(PathField::new(self.suggested_path().display().to_string(), "path/to/picture.png"));
        }
    }

    /// A name that is not taken, after the last picture of this scene or after the scene.
    fn suggested_path(&self) -> PathBuf {
        let of_file = self.opened.as_ref().and_then(|opened| opened.path.as_ref()?.file_stem()?.to_str().map(str::to_owned));
        let name = format!("{}.png", of_file.unwrap_or_else(|| "cornell_spheres".to_owned()));
        let path = self.last_saved.clone();
        free(&path.unwrap_or_else(|| std::env::current_dir().map_or_else(|_| name.clone().into(), |folder| folder.join(&name))))
    }

    pub(super) fn save_dialog(&mut self, ctx: &egui::Context) {
        let Some(mut field) = self.save_dialog.take() else { return };
        let (mut open, mut save, mut cancelled) = (true, false, false);
        egui::Window::new("Save picture")
            .open(&mut open)
            .collapsible(false)
            .resizable(false)
            .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
            .show(ctx, |ui| (save, cancelled) = dialog_body(ui, &mut field));
        if let Some(path) = field.path().filter(|_| save) {
            match check_target(&path) {
                Ok(()) => return self.save_to(path),
                Err(error) => field.refusal = Some(error.to_string()),
            }
        }
        if open && !cancelled {
            self.save_dialog = Some(field);
        }
    }

    /// Saves what is shown.
    pub(super) fn save_to(&mut self, path: PathBuf) {
        if !self.can_save() {
            self.tell("Not saved: the new picture has no sample everywhere yet. Try again in a moment.".to_owned(), true);
            return;
        }
        let (Some(frame), Some(wish)) = (&self.shown, self.link.wish()) else { return };
        let settings = settings_text(&wish.scene, &wish.camera, &wish.settings, self.display, frame.spp);
        self.saver.save(Request { frame: frame.clone(), display: self.display, settings, path });
    }
}

/// The path, or the first of `name-2`, `name-3`, … that is not taken.
fn free(path: &std::path::Path) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    // A number that was added here before is counted on.
    let stem = stem.rsplit_once('-').filter(|(_, n)| n.parse::<u32>().is_ok()).map_or(&*stem, |(stem, _)| stem);
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    let numbered = (2..10_000).map(|n| path.with_file_name(format!("{stem}-{n}.{extension}")));
    std::iter::once(path.to_owned()).chain(numbered).find(|path| !path.exists()).unwrap_or_else(|| path.to_owned())
}

/// Whether to save, and whether to close. A file is replaced by the button that says so, never by Enter.
fn dialog_body(ui: &mut egui::Ui, field: &mut PathField) -> (bool, bool) {
    ui.set_width(460.0);
    ui.label("PNG is the picture as shown; EXR is linear radiance. Both carry the settings.");
    ui.add_space(4.0);
    let entered = field.show(ui);
    let exists = field.path().is_some_and(|path| path.is_file());
    field.remark(ui, if exists { "This file exists. Replace it?" } else { "" });
    let (mut save, mut cancel) = (entered && !exists, false);
    ui.horizontal(|ui| {
        let is_exr = field.path.trim().to_ascii_lowercase().ends_with(".exr");
        for (name, extension, chosen) in [("PNG", "png", !is_exr), ("EXR", "exr", is_exr)] {
            if ui.selectable_label(chosen, name).clicked() {
                field.path = PathBuf::from(&field.path).with_extension(extension).display().to_string();
                field.refusal = None;
            }
        }
        let name = field.path().and_then(|path| path.file_name().map(|name| name.to_string_lossy().into_owned()));
        field.browse(ui, |dialog| {
            let dialog = dialog.add_filter("PNG or EXR", &["png", "exr"]);
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
