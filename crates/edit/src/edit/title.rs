//! Edits in words, for menus.
use super::{
    Edit,
    tree::{Answer, Tree},
};
use noisefall_base::declare::{OwnedValue, Path, Step};
use noisefall_scene::scene::description::{SceneDescription, parameter_name};

impl Edit {
    /// The edit of a scene in words that follow "Undo" in a menu: "change of roughness of gold".
    pub fn title(&self, scene: &SceneDescription) -> String {
        match self {
            Edit::Set { path, value: OwnedValue::Text(to) } if is_name(path) => renaming(&scene.part_name(path), to),
            Edit::Set { path, .. } | Edit::Replace { path, .. } => format!("change of {}", place(scene, path)),
            Edit::Insert { path, tree: Some(tree), .. } if is_listed(path) => {
                let name = name_in(tree).unwrap_or_else(|| scene.part_name(path));
                format!("addition of {name}")
            }
            Edit::Insert { path, .. } => around(scene, path, "addition", "to"),
            Edit::Remove { path } => around(scene, path, "removal", "from"),
            Edit::Choose { path, name, .. } => {
                let kind = name.replace('_', " ");
                // The shape of an object is the kind of the object.
                let is_shape = parameter_name(path) == "shape";
                let what = if is_shape { scene.part_name(path) } else { place(scene, path) };
                format!("change of {what} to {kind}")
            }
            Edit::Rename { path, to } => renaming(&scene.part_name(path), to),
            Edit::Move { path, .. } => format!("move of {}", place(scene, path)),
            Edit::All(edits) => {
                let main = edits.iter().find(|edit| !edit.adds_a_dependency()).or(edits.first());
                main.map_or_else(|| "edit".to_owned(), |edit| edit.title(scene))
            }
            Edit::Reload(_) => "reload of the file".to_owned(),
        }
    }

    /// Whether the edit adds a material or a texture. Among others, it serves them.
    fn adds_a_dependency(&self) -> bool {
        let Edit::Insert { path, .. } = self else { return false };
        matches!(&path.0[..], [Step::Key(map), Step::Key(_)] if map == "materials" || map == "textures")
    }
}

/// Whether a path is that of the name of an object or of a light.
fn is_name(path: &Path) -> bool {
    matches!(&path.0[..], [Step::Key(_), Step::Item(_), Step::Key(key)] if key == "name")
}

/// Whether a path is that of an object or of a light.
fn is_listed(path: &Path) -> bool {
    matches!(&path.0[..], [Step::Key(_), Step::Item(_)])
}

/// The name of an object or of a light, which is its first value.
fn name_in(tree: &Tree) -> Option<String> {
    match tree.0.first() {
        Some(Answer::Value(OwnedValue::Text(name))) if !name.is_empty() => Some(name.clone()),
        _ => None,
    }
}

fn renaming(from: &str, to: &str) -> String {
    format!("renaming of {from} to {to}")
}

/// A place, with an article where the part has no name of its own.
fn place(scene: &SceneDescription, path: &Path) -> String {
    let (part, parameter) = (part(scene, path), parameter_name(path));
    if parameter.is_empty() { part } else { format!("{parameter} of {part}") }
}

fn part(scene: &SceneDescription, path: &Path) -> String {
    let name = scene.part_name(path);
    let has_name =
        matches!(path.0.first(), Some(Step::Key(key)) if ["objects", "lights", "materials", "textures"].contains(&key.as_str()));
    if has_name { name } else { format!("the {name}") }
}

/// Describes a change of a part, or of one of its parameters.
fn around(scene: &SceneDescription, path: &Path, what: &str, preposition: &str) -> String {
    let (part, parameter) = (part(scene, path), parameter_name(path));
    if parameter.is_empty() { format!("{what} of {part}") } else { format!("{what} of {parameter} {preposition} {part}") }
}
