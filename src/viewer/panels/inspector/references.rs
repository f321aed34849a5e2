//! Menus of names: textures instead of constants, and references.
use egui::{Button, ComboBox, Id, Ui};
use noisefall_base::declare::{Family, OwnedValue, Parameter, Path};

use super::{Request, Surroundings};
use crate::viewer::widgets::{
    counted::counted,
    list::{closing, entry},
};

/// Source of a value.
pub enum ValueSource {
    Constant,
    /// Not changed: the parameters of the texture are to be shown.
    Shown(Request),
    Texture(String),
    /// An image file that the user chooses next.
    File,
    /// A new texture of a kind.
    New(&'static str),
}

/// Kinds of textures that need neither a file nor other textures.
const NEW: [(&str, &str); 2] = [("New checker", "checker"), ("New noise", "noise")];

const FROM_FILE: &str = "From a file…";

/// The family of an absent optional name, which only its key determines.
pub fn family_of(parameter: &Parameter) -> Option<Family> {
    match parameter.key {
        "material" => Some(Family::Material),
        "texture" => Some(Family::Texture),
        _ => None,
    }
}

/// The menu of names that a value can refer to.
pub fn names(
    ui: &mut Ui,
    label: Id,
    current: Option<&str>,
    family: Family,
    surroundings: &Surroundings,
    is_optional: bool,
    path: &Path,
) -> Option<Request> {
    const NONE: &str = "none";
    let all = if family == Family::Material { surroundings.materials } else { surroundings.textures };
    let mut request = None;
    let combo = ComboBox::from_id_salt("names").truncate().selected_text(current.unwrap_or(NONE)).show_ui(ui, |ui| {
        if is_optional && entry(ui, current.is_none(), NONE).clicked() && current.is_some() {
            request = Some(Request::Remove { path: path.clone() });
        }
        for name in all {
            if entry(ui, current == Some(name), name).clicked() && current != Some(name) {
                request = Some(Request::Set { path: path.clone(), value: OwnedValue::Text(name.clone()) });
            }
        }
        if family == Family::Texture && entry(ui, false, FROM_FILE).clicked() {
            request = Some(Request::BrowseTexture { path: path.clone() });
        }
    });
    combo.response.labelled_by(label);
    request.or(current.and_then(|name| show_button(ui, family, name, surroundings)))
}

/// The button that shows the parameters of a material or texture, if the scene has it.
fn show_button(ui: &mut Ui, family: Family, name: &str, surroundings: &Surroundings) -> Option<Request> {
    let (all, what) = match family {
        Family::Material => (surroundings.materials, "material"),
        Family::Texture => (surroundings.textures, "texture"),
    };
    let button = ui.add_enabled(all.iter().any(|known| known == name), Button::new("Edit"));
    let button = button.on_hover_ui(|ui| {
        let count = (surroundings.count_objects)(name);
        let users = if family == Family::Material { format!(", which {} use", counted(count, "object")) } else { String::new() };
        let users = if count == 1 { users + "s" } else { users };
        ui.label(format!("Shows the {what} {name}{users}."));
    });
    button.clicked().then(|| Request::Show { family, name: name.to_owned() })
}

/// The menu of textures in place of the texture `current`.
pub fn textures(ui: &mut Ui, label: Id, current: &str, surroundings: &Surroundings) -> Option<ValueSource> {
    let combo = ComboBox::from_id_salt("textures").truncate().selected_text(current);
    let combo = combo.show_ui(ui, |ui| {
        let is_constant = entry(ui, false, "constant").clicked();
        entries(ui, Some(current), surroundings).or(is_constant.then_some(ValueSource::Constant))
    });
    combo.response.labelled_by(label);
    let shown = show_button(ui, Family::Texture, current, surroundings).map(ValueSource::Shown);
    combo.inner.flatten().or(shown)
}

/// The button behind a constant, with the menu of textures in its place.
pub fn map_button(ui: &mut Ui, label: Id, surroundings: &Surroundings) -> Option<ValueSource> {
    let menu = ui.menu_button("Map", |ui| entries(ui, None, surroundings));
    menu.response.labelled_by(label).on_hover_text("Replaces the value by a texture.");
    menu.inner.flatten()
}

fn entries(ui: &mut Ui, current: Option<&str>, surroundings: &Surroundings) -> Option<ValueSource> {
    let mut chosen = None;
    for name in surroundings.textures {
        let is_current = current == Some(name);
        if entry(ui, is_current, name).clicked() && !is_current {
            chosen = Some(ValueSource::Texture(name.clone()));
        }
    }
    for (title, kind) in NEW {
        if ui.button(title).clicked() {
            chosen = Some(ValueSource::New(kind));
        }
    }
    if ui.button(FROM_FILE).clicked() {
        chosen = Some(ValueSource::File);
    }
    closing(ui, chosen)
}
