//! Which scene is shown.
use std::path::PathBuf;

use egui::{Align, ComboBox, Layout, RichText};

use super::app::App;

impl App {
    pub(super) fn scene_panel(&mut self, ui: &mut egui::Ui) {
        let name = self.opened.as_ref().map_or("Choose a scene", |opened| opened.name.as_str()).to_owned();
        let mut chosen = None;
        ui.horizontal(|ui| {
            let label = ui.label("Scene");
            // From the right, so that the button has its place and a long title is cut by what is left.
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                if ui.button("Open…").on_hover_text("Choose a scene file").clicked() {
                    self.pick_scene_file();
                }
                let combo = ComboBox::from_id_salt("Scene").selected_text(name).width(ui.available_width()).height(400.0);
                let combo = combo.truncate().show_ui(ui, |ui| chosen = self.scene_list(ui));
                combo.response.labelled_by(label.id);
            });
        });
        if let Some(path) = chosen {
            self.loader.open(path);
        }
        if let Some(opened) = &self.opened {
            if !opened.scene.notes.is_empty() {
                ui.label(RichText::new(&opened.scene.notes).weak());
            }
            for warning in opened.scene.warnings() {
                ui.label(RichText::new(format!("Note: {warning}.")).color(ui.visuals().warn_fg_color));
            }
        }
    }

    /// The scenes to choose from; `Some(None)` is the built-in one.
    fn scene_list(&self, ui: &mut egui::Ui) -> Option<Option<PathBuf>> {
        let open = self.opened.as_ref().map(|opened| opened.path.as_deref());
        let mut chosen = None;
        if ui.selectable_label(open == Some(None), "built-in Cornell box").clicked() {
            chosen = Some(None);
        }
        for (name, path) in &self.catalogue {
            if ui.selectable_label(open == Some(Some(path.as_path())), name).clicked() {
                chosen = Some(Some(path.clone()));
            }
        }
        chosen
    }

    /// A file dialog on a thread of its own; what is chosen arrives like a dropped file.
    fn pick_scene_file(&self) {
        let (sender, ctx) = (self.picked.0.clone(), self.ctx.clone());
        std::thread::spawn(move || {
            if let Some(path) = rfd::FileDialog::new().add_filter("Noisefall scene", &["toml"]).pick_file() {
                let _ = sender.send(path);
                ctx.request_repaint();
            }
        });
    }

    /// Scene files dropped on the window or chosen in a dialog.
    pub(super) fn open_picked_files(&mut self) {
        let dropped = self.ctx.input(|input| input.raw.dropped_files.first().map(|file| file.path().to_owned()));
        if let Some(path) = dropped.or_else(|| self.picked.1.try_recv().ok()) {
            self.loader.open(Some(path));
        }
    }
}
