//! The objects that use a material, as buttons that select them.
use egui::Ui;
use noisefall_scene::scene::description::SceneDescription;

use super::subject::Subject;

/// Most buttons.
const MOST: usize = 3;

/// Shows the users of a material in a row. Returns the one that was clicked.
pub fn show(ui: &mut Ui, scene: &SceneDescription, subject: &Subject) -> Option<Subject> {
    let Subject::Material(material) = subject else { return None };
    let objects = scene.objects.iter().enumerate().filter(|(_, object)| object.material.as_ref() == Some(material));
    let users: Vec<_> = objects.collect();
    ui.label("Used by:").on_hover_text("Objects with this material. All of them change with it.");
    if users.is_empty() {
        ui.weak("no object");
    }
    let mut clicked = None;
    for (place, _) in users.iter().take(MOST) {
        if ui.small_button(Subject::Object(*place).name(scene)).on_hover_text("Selects this object.").clicked() {
            clicked = Some(Subject::Object(*place));
        }
    }
    if users.len() > MOST {
        ui.weak(format!("and {} more", users.len() - MOST));
    }
    clicked
}
