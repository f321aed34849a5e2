//! The panel that names the open scene and lists the others.
use std::path::PathBuf;

use egui::{Align, Button, ComboBox, Layout, RichText, vec2};

use crate::viewer::background::{
    catalogue::{BUILT_IN_NAME, CatalogueEntry, SceneRequest, open_entry},
    opened_scene::OpenedScene,
};
use crate::viewer::widgets::{
    list::{closing, explained},
    quotation::with_quotation_marks,
};

/// The height of a row of the list: more than its text needs, so that all are alike.
const ROW: f32 = 26.0;

/// Shows the list of scenes.
pub fn show(ui: &mut egui::Ui, opened: Option<&OpenedScene>, catalogue: &[CatalogueEntry]) -> Option<SceneRequest> {
    let name = opened.map_or("Choose a scene", |opened| opened.name.as_str()).to_owned();
    let mut request = None;
    ui.horizontal(|ui| {
        let label = ui.label("Scene");
        // From the right, so that the button has its place and a long title is cut by what is left.
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if ui.button("Open…").on_hover_text("Opens a scene file. (Ctrl+O)").clicked() {
                request = Some(SceneRequest::Browse);
            }
            if ui.button("Gallery").on_hover_text("Shows all scenes as thumbnails. (F6)").clicked() {
                request = Some(SceneRequest::Gallery);
            }
            let height = list_height(ui, catalogue.len());
            let combo = ComboBox::from_id_salt("Scene").selected_text(name).width(ui.available_width()).height(height);
            let combo = combo.truncate().show_ui(ui, |ui| scene_list(ui, opened, catalogue));
            combo.response.labelled_by(label.id);
            request = combo.inner.flatten().map(SceneRequest::Open).or(request.take());
        });
    });
    request
}

/// Shows the notes and warnings of the open scene.
pub fn notes(ui: &mut egui::Ui, opened: Option<&OpenedScene>) {
    if let Some(opened) = opened {
        if !opened.scene.notes.is_empty() {
            ui.label(RichText::new(&opened.scene.notes).weak());
        }
        for warning in &opened.warnings {
            ui.label(RichText::new(format!("Note: {}.", with_quotation_marks(warning))).color(ui.visuals().warn_fg_color));
        }
    }
}

/// The height of the list: of all its rows, or of as many whole ones as fit.
fn list_height(ui: &egui::Ui, scenes: usize) -> f32 {
    const AROUND: f32 = 110.0;
    let fit = ((ui.ctx().content_rect().height() - AROUND) / ROW).floor().max(3.0);
    ROW * fit.min(scenes as f32 + 1.0)
}

/// The scenes to choose from; `Some(None)` is the built-in one, if none of the others is the same.
fn scene_list(ui: &mut egui::Ui, opened: Option<&OpenedScene>, catalogue: &[CatalogueEntry]) -> Option<Option<PathBuf>> {
    // Rows touch: a click between two of them would close the list and choose nothing.
    ui.spacing_mut().item_spacing.y = 0.0;
    let row = |marked, name: &str| Button::selectable(marked, name.to_owned()).min_size(vec2(0.0, ROW));
    // A new scene without a file is not in the list.
    let known = opened.filter(|opened| opened.path.is_some() || opened.name == BUILT_IN_NAME);
    let open = known.and_then(|opened| open_entry(catalogue, opened.path.as_deref()));
    let mut chosen = None;
    if open_entry(catalogue, None).is_none() && ui.add(row(known.is_some() && open.is_none(), BUILT_IN_NAME)).clicked() {
        chosen = Some(None);
    }
    for entry in catalogue {
        let label = ui.add(row(open.is_some_and(|open| open.path == entry.path), &entry.name));
        if explained(label, &entry.path.display().to_string()).clicked() {
            chosen = Some(Some(entry.path.clone()));
        }
    }
    closing(ui, chosen)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_has_all_rows_or_as_many_as_the_window_has_room_for() {
        for (scenes, rows) in [(3, 4.0), (1000, 26.0)] {
            let draw = move |ui: &mut egui::Ui| assert_eq!(list_height(ui, scenes), ROW * rows, "{scenes} scenes");
            _ = egui_kittest::Harness::builder().with_size(vec2(400.0, 800.0)).build_ui(draw);
        }
    }
}
