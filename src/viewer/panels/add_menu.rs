//! The menus that add objects, materials and textures, and begin new scenes.
use egui::Ui;
use noisefall::{
    declare::OneOf,
    edit::{TEMPLATES, Template},
    shape::ShapeKind,
};

use super::outliner::New;

/// Shows the menu. Returns what is to be added.
pub fn show(ui: &mut Ui) -> Option<New> {
    let doc = "Adds an object where you clicked last in the image, or a material or a texture.";
    let menu = ui.menu_button("Add", |ui| {
        let shape = ui.menu_button("Shape", |ui| kinds(ui).map(New::Shape)).inner.flatten();
        let lamp = ui.menu_button("Lamp", |ui| kinds(ui).map(New::Lamp)).inner.flatten();
        let material = ui.button("Material").clicked().then_some(New::Material);
        let texture = ui.button("Texture").clicked().then_some(New::Texture);
        shape.or(lamp).or(material).or(texture)
    });
    menu.response.on_hover_text(doc);
    menu.inner.flatten()
}

/// Shows the menu of new scenes. Returns the template to begin with.
pub fn new_scene(ui: &mut Ui) -> Option<Template> {
    let menu = ui.menu_button("New scene", |ui| {
        let chosen = |template: &Template| ui.button(template.title).on_hover_text(template.doc).clicked();
        TEMPLATES.into_iter().filter(chosen).last()
    });
    menu.response.on_hover_text("Opens a new scene in place of this one.");
    menu.inner.flatten()
}

fn kinds(ui: &mut Ui) -> Option<&'static str> {
    let mut chosen = None;
    for kind in ShapeKind::alternatives() {
        if ui.button(kind.name().replace('_', " ")).on_hover_text(kind.about().doc).clicked() {
            chosen = Some(kind.name());
        }
    }
    chosen
}
