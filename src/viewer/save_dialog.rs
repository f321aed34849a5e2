//! Where to save the picture: a path that can be typed, and a file dialog that fills it in.
use std::{path::PathBuf, sync::mpsc};

use egui::{Align2, Button, RichText, TextEdit};
use noisefall::render::{image_file::check_target, settings_text::settings_text};

use super::{app::App, saver::Request};

pub struct SaveDialog {
    path: String,
    picked: (mpsc::Sender<PathBuf>, mpsc::Receiver<PathBuf>),
    focus: bool,
    /// Why the path cannot be written to.
    refusal: Option<String>,
}

impl SaveDialog {
    pub fn new(path: String) -> SaveDialog {
        SaveDialog { path, picked: mpsc::channel(), focus: true, refusal: None }
    }

    fn set_extension(&mut self, extension: &str) {
        self.path = PathBuf::from(&self.path).with_extension(extension).display().to_string();
    }

    fn browse(&self, ctx: &egui::Context) {
        let (sender, ctx, start) = (self.picked.0.clone(), ctx.clone(), PathBuf::from(&self.path));
        std::thread::spawn(move || {
            let name = start.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let dialog = rfd::FileDialog::new().set_file_name(name).add_filter("PNG or EXR", &["png", "exr"]);
            if let Some(path) = dialog.save_file() {
                let _ = sender.send(path);
                ctx.request_repaint();
            }
        });
    }
}

impl App {
    /// Whether what is shown is the full picture of what the controls say.
    pub(super) fn can_save(&self) -> bool {
        self.shown.as_ref().is_some_and(|frame| !frame.is_coarse() && frame.generation == self.link.generation())
    }

    pub(super) fn open_save_dialog(&mut self) {
        if self.save_dialog.is_none() {
            self.save_dialog = Some(SaveDialog::new(self.suggested_path()));
        }
    }

    /// The name of the last picture, or one made from the scene's.
    fn suggested_path(&self) -> String {
        if let Some(path) = &self.last_saved {
            return path.display().to_string();
        }
        let of_file = self.opened.as_ref().and_then(|opened| opened.path.as_ref()?.file_stem()?.to_str().map(str::to_owned));
        let name = format!("{}.png", of_file.unwrap_or_else(|| "cornell_spheres".to_owned()));
        std::env::current_dir().map_or_else(|_| name.clone(), |folder| folder.join(&name).display().to_string())
    }

    pub(super) fn save_dialog(&mut self, ctx: &egui::Context) {
        let Some(mut dialog) = self.save_dialog.take() else { return };
        if let Ok(path) = dialog.picked.1.try_recv() {
            dialog.path = path.display().to_string();
        }
        let (mut save, mut open) = (false, true);
        let mut cancelled = false;
        egui::Window::new("Save picture")
            .open(&mut open)
            .collapsible(false)
            .resizable(false)
            .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
            .show(ctx, |ui| {
                (save, cancelled) = dialog_body(ui, &mut dialog);
            });
        let path = PathBuf::from(dialog.path.trim());
        if save && self.can_save() {
            dialog.refusal = check_target(&path).err().map(|error| error.to_string());
        }
        if save && dialog.refusal.is_none() {
            self.save_to(path);
        } else if open && !cancelled {
            self.save_dialog = Some(dialog);
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

/// Whether to save, and whether to close.
fn dialog_body(ui: &mut egui::Ui, dialog: &mut SaveDialog) -> (bool, bool) {
    ui.set_width(460.0);
    ui.label("PNG is the picture as shown; EXR is linear radiance. Both carry the settings.");
    ui.add_space(4.0);
    let field = ui.add(TextEdit::singleline(&mut dialog.path).hint_text("path/to/picture.png").desired_width(f32::INFINITY));
    if std::mem::take(&mut dialog.focus) {
        field.request_focus();
    }
    let entered = field.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
    let exists = PathBuf::from(dialog.path.trim()).exists();
    if field.changed() {
        dialog.refusal = None;
    }
    match &dialog.refusal {
        Some(refusal) => ui.colored_label(ui.visuals().error_fg_color, refusal),
        None if exists => ui.colored_label(ui.visuals().warn_fg_color, "This file exists and will be replaced."),
        None => ui.label(" "),
    };
    let (mut save, mut cancel) = (entered, false);
    ui.horizontal(|ui| {
        let is_exr = dialog.path.trim().to_ascii_lowercase().ends_with(".exr");
        if ui.selectable_label(!is_exr, "PNG").clicked() {
            dialog.set_extension("png");
        }
        if ui.selectable_label(is_exr, "EXR").clicked() {
            dialog.set_extension("exr");
        }
        if ui.button("Browse…").on_hover_text("If no file dialog appears on your system, type the path").clicked() {
            dialog.browse(ui.ctx());
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let name = RichText::new("Save").strong();
            save |= ui.add_enabled(!dialog.path.trim().is_empty(), Button::new(name)).clicked();
            cancel = ui.button("Cancel").clicked();
        });
    });
    (save, cancel)
}
