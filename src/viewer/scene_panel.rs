//! Which scene is shown.
use std::path::PathBuf;

use egui::{Align, Button, ComboBox, Layout, RichText, vec2};

use super::{app::App, catalogue::in_full, loader::BUILT_IN_NAME};

/// The height of a row of the list: more than its text needs, so that all are alike.
const ROW: f32 = 26.0;

impl App {
    pub(super) fn scene_panel(&mut self, ui: &mut egui::Ui) {
        let name = self.opened.as_ref().map_or("Choose a scene", |opened| opened.name.as_str()).to_owned();
        let mut chosen = None;
        ui.horizontal(|ui| {
            let label = ui.label("Scene");
            // From the right, so that the button has its place and a long title is cut by what is left.
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                if ui.button("Open…").on_hover_text("Choose a scene file").clicked() {
                    self.open_open_dialog();
                }
                if ui.button("Gallery").on_hover_text("The scenes as pictures (F6)").clicked() {
                    self.gallery.open = true;
                }
                let height = self.height_of_list(ui);
                let combo = ComboBox::from_id_salt("Scene").selected_text(name).width(ui.available_width()).height(height);
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
            let mut warnings = opened.scene.warnings().to_vec();
            let why_black = if opened.scene.lights.is_empty() { None } else { self.why_black() };
            warnings.extend(why_black.filter(|why| !warnings.contains(why)));
            for warning in warnings {
                ui.label(RichText::new(format!("Note: {warning}.")).color(ui.visuals().warn_fg_color));
            }
        }
    }

    /// The height of the list: of all its rows, or of as many whole ones as there is room for.
    fn height_of_list(&self, ui: &egui::Ui) -> f32 {
        const AROUND: f32 = 110.0;
        let fit = ((ui.ctx().content_rect().height() - AROUND) / ROW).floor().max(3.0);
        ROW * fit.min(self.catalogue.len() as f32 + 1.0)
    }

    /// The scenes to choose from; `Some(None)` is the built-in one.
    fn scene_list(&self, ui: &mut egui::Ui) -> Option<Option<PathBuf>> {
        // Rows touch: a click between two of them would close the list and choose nothing.
        ui.spacing_mut().item_spacing.y = 0.0;
        let row = |marked, name: &str| Button::selectable(marked, name.to_owned()).min_size(vec2(0.0, ROW));
        let open = self.opened.as_ref().map(|opened| opened.path.as_deref().map(in_full));
        let mut chosen = None;
        if ui.add(row(open == Some(None), BUILT_IN_NAME)).clicked() {
            chosen = Some(None);
        }
        for entry in &self.catalogue {
            let is_open = open.as_ref().is_some_and(|open| open.as_ref() == Some(&entry.path));
            let label = ui.add(row(is_open, &entry.name));
            if label.on_hover_text(entry.path.display().to_string()).clicked() {
                chosen = Some(Some(entry.path.clone()));
            }
        }
        chosen
    }

    /// What is dropped on the window: a scene, or a picture to hold this one against.
    pub(super) fn take_dropped_file(&mut self) {
        let dropped = self.ctx.input(|input| input.raw.dropped_files.first().map(|file| file.path().to_owned()));
        let Some(path) = dropped else { return };
        match path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase()).as_deref() {
            Some("exr" | "hdr") => self.loader.read_reference(path, self.camera),
            _ => self.loader.open(Some(path)),
        }
    }
}
