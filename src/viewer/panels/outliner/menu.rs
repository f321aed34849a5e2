//! The menu of a part of the scene.
use egui::Ui;
use noisefall_base::declare::OneOf;
use noisefall_scene::{
    light::punctual_light::PunctualLightKind,
    material::Material,
    scene::description::{EnvironmentDescription, SceneDescription},
    shape::ShapeKind,
    texture::TextureKind,
};

use super::entries::{Entry, groups};
use crate::viewer::{panels::subject::Subject, widgets::list::explained};

/// An action on a part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Action {
    /// Move the camera so that the part fills the image.
    LookAt,
    /// Move the object down, or up if it has sunk in, until it rests on something.
    DropToFloor,
    Duplicate,
    Delete,
    /// Give it this name.
    Rename(String),
    /// Change its kind to the one of this name.
    ChangeKind(&'static str),
    /// Give it a material; `None` is black.
    AssignMaterial(Option<String>),
    /// Make a texture the colour of its material.
    AssignTexture(String),
    /// Give the scene an environment.
    AddEnvironment,
}

impl Action {
    /// Returns the action of a part that is dropped on an object.
    pub fn assigns(dropped: &Subject) -> Option<Action> {
        match dropped {
            Subject::Material(name) => Some(Action::AssignMaterial(Some(name.clone()))),
            Subject::Texture(name) => Some(Action::AssignTexture(name.clone())),
            _ => None,
        }
    }
}

/// A part to add to the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum New {
    /// An object with a shape of this kind.
    Shape(&'static str),
    /// An object that emits light, with a shape of this kind.
    AreaLight(&'static str),
    /// A punctual light of this kind.
    PunctualLight(&'static str),
    Material,
    Texture,
}

const RESTS: &str = "Lowers the object until it stands on what is below. Raises it if it has sunk in.";

/// The choices of menus.
pub struct Menu {
    materials: Vec<String>,
    has_environment: bool,
}

impl Menu {
    pub fn of(description: &SceneDescription) -> Menu {
        let materials = description.materials.keys().cloned().collect();
        Menu { materials, has_environment: description.environment.is_some() }
    }

    /// Whether there is nothing to choose for a part.
    pub fn is_empty(entry: &Entry) -> bool {
        matches!(entry.subject, Subject::Camera | Subject::Presentation)
    }

    /// Shows the menu of a part, and returns what was chosen. The name of [`Action::Rename`] is the present one.
    pub fn show(&self, ui: &mut Ui, entry: &Entry) -> Option<Action> {
        let mut actions = Vec::new();
        match &entry.subject {
            Subject::Object(_) => actions.extend([
                ("Look at", Action::LookAt),
                ("Rest on floor", Action::DropToFloor),
                ("Duplicate", Action::Duplicate),
            ]),
            Subject::PunctualLight(_) | Subject::Material(_) | Subject::Texture(_) => {
                actions.push(("Duplicate", Action::Duplicate));
            }
            Subject::Camera | Subject::Presentation => {}
            Subject::Environment if !self.has_environment => actions.push(("Add", Action::AddEnvironment)),
            Subject::Environment => actions.push(("Delete", Action::Delete)),
        }
        if can_rename(&entry.subject) {
            actions.extend([("Rename…", Action::Rename(entry.given_name.clone())), ("Delete", Action::Delete)]);
        }
        let mut chosen = None;
        for (name, action) in actions {
            let button = ui.button(name);
            let rests = action == Action::DropToFloor;
            if (if rests { explained(button, RESTS) } else { button }).clicked() {
                chosen = Some(action);
            }
        }
        let kinds = self.kinds(&entry.subject);
        if !kinds.is_empty() {
            let menu = ui.menu_button("Change type", |ui| {
                kinds.into_iter().find(|kind| ui.button(kind.replace('_', " ")).clicked()).map(Action::ChangeKind)
            });
            chosen = chosen.or(menu.inner.flatten());
        }
        if matches!(entry.subject, Subject::Object(_)) {
            chosen = chosen.or(ui.menu_button("Assign material", |ui| self.materials(ui)).inner.flatten());
        }
        chosen
    }

    fn kinds(&self, subject: &Subject) -> Vec<&'static str> {
        match subject {
            Subject::Object(_) => names::<ShapeKind>(),
            Subject::PunctualLight(_) => names::<PunctualLightKind>(),
            Subject::Material(_) => names::<Material>(),
            Subject::Texture(_) => names::<TextureKind>(),
            Subject::Environment if self.has_environment => names::<EnvironmentDescription>(),
            Subject::Environment | Subject::Camera | Subject::Presentation => Vec::new(),
        }
    }

    fn materials(&self, ui: &mut Ui) -> Option<Action> {
        let mut chosen = None;
        if ui.button("none (black)").clicked() {
            chosen = Some(Action::AssignMaterial(None));
        }
        for name in &self.materials {
            if ui.button(name).clicked() {
                chosen = Some(Action::AssignMaterial(Some(name.clone())));
            }
        }
        chosen
    }
}

/// Shows the menu of a part of a scene. Returns what was chosen.
pub fn part_menu(ui: &mut Ui, description: &SceneDescription, subject: &Subject) -> Option<Action> {
    let all = groups(description, "").into_iter().flat_map(|group| group.entries);
    let entry = all.into_iter().find(|entry| entry.subject == *subject)?;
    Menu::of(description).show(ui, &entry)
}

/// Whether a part has a name.
pub fn can_rename(subject: &Subject) -> bool {
    matches!(subject, Subject::Object(_) | Subject::PunctualLight(_) | Subject::Material(_) | Subject::Texture(_))
}

fn names<T: OneOf>() -> Vec<&'static str> {
    T::alternatives().iter().map(OneOf::name).collect()
}
