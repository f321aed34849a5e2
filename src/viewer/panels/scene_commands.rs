//! The buttons over the list of parts: they add parts, begin new scenes, and save this one.
use egui::{Popup, Ui};
use noisefall_base::declare::OneOf;
use noisefall_edit::edit::{TEMPLATES, Template};
use noisefall_scene::{light::punctual_light::PunctualLightKind, shape::ShapeKind};

use super::outliner::New;
use crate::viewer::widgets::list::{closing, explained};

/// The command of a button.
#[derive(Clone, Copy, Debug)]
pub enum SceneCommand {
    Add(New),
    Begin(Template),
    /// Give the scene the camera and the settings of the window.
    UseView,
    SaveAs,
}

/// Shows the buttons. `opens_add` opens the menu that adds parts.
pub fn show(ui: &mut Ui, opens_add: bool) -> Option<SceneCommand> {
    let parts = ui.horizontal(|ui| {
        let add = add_menu(ui, opens_add).map(SceneCommand::Add);
        let begin = template_menu(ui).map(SceneCommand::Begin);
        add.or(begin)
    });
    let file = ui.horizontal_wrapped(|ui| {
        let doc = "Stores the camera and the render settings of the window in the scene. Ctrl+S then writes them to its file.";
        let uses_view = ui.button("Save view and settings").on_hover_text(doc).clicked().then_some(SceneCommand::UseView);
        let doc = "Saves the scene to another file. Ctrl+S saves it to its own.";
        uses_view.or(ui.button("Save scene as…").on_hover_text(doc).clicked().then_some(SceneCommand::SaveAs))
    });
    parts.inner.or(file.inner)
}

fn add_menu(ui: &mut Ui, opens: bool) -> Option<New> {
    let menu = ui.menu_button("Add", |ui| {
        let shape = ui.menu_button("Shape", |ui| kinds::<ShapeKind>(ui).map(New::Shape)).inner.flatten();
        let light = ui.menu_button("Light", lights).inner.flatten();
        let material = ui.button("Material").clicked().then_some(New::Material);
        let texture = ui.button("Texture").clicked().then_some(New::Texture);
        closing(ui, shape.or(light).or(material).or(texture))
    });
    if opens {
        Popup::open_id(ui.ctx(), Popup::default_response_id(&menu.response));
    }
    let doc = "Adds an object or a light where you clicked last in the image, or a material or a texture. (Shift+A)";
    menu.response.on_hover_text(doc);
    menu.inner.flatten()
}

fn template_menu(ui: &mut Ui) -> Option<Template> {
    let menu = ui.menu_button("New scene", |ui| {
        let mut chosen = None;
        for template in TEMPLATES {
            if explained(ui.button(template.title), template.doc).clicked() {
                chosen = Some(template);
            }
        }
        closing(ui, chosen)
    });
    menu.response.on_hover_text("Opens a new scene in place of this one.");
    menu.inner.flatten()
}

/// Shapes that emit light, and punctual lights.
fn lights(ui: &mut Ui) -> Option<New> {
    let shape = kinds::<ShapeKind>(ui).map(New::AreaLight);
    ui.separator();
    shape.or(kinds::<PunctualLightKind>(ui).map(New::PunctualLight))
}

fn kinds<T: OneOf>(ui: &mut Ui) -> Option<&'static str> {
    let mut chosen = None;
    for kind in T::alternatives() {
        if explained(ui.button(kind.name().replace('_', " ")), kind.about().doc).clicked() {
            chosen = Some(kind.name());
        }
    }
    chosen
}
