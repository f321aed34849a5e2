//! The text of a new scene file.
use std::collections::BTreeMap;

use toml_edit::DocumentMut;

use super::origin::Origins;
use super::{
    outline::{Entry, Table},
    tables::{Level, Update},
};
use noisefall_scene::scene::description::SceneDescription;

/// Items that are written at a time. While they are written they take some ten kilobytes each, and as text a few hundred bytes.
const PIECE: usize = 256;

/// The text of a scene file, without values that equal their defaults.
pub fn new_text(description: &SceneDescription) -> String {
    let SceneDescription { title, notes, camera, environment, render, reference, .. } = description;
    let around = SceneDescription {
        title: title.clone(),
        notes: notes.clone(),
        camera: camera.clone(),
        environment: environment.clone(),
        render: render.clone(),
        reference: reference.clone(),
        ..SceneDescription::default()
    };
    let entries = Table::of(&around).entries;
    let is_list = |entry: &Entry| ["textures", "materials", "objects", "lights"].contains(&entry.key);
    let first = entries.iter().position(is_list).unwrap_or(entries.len());
    let mut entries = entries.into_iter();
    let mut text = String::new();
    append(&mut text, entries.by_ref().take(first).collect());
    for textures in pieces_of(&description.textures) {
        append_list(&mut text, "textures", &SceneDescription { textures, ..SceneDescription::default() });
    }
    for materials in pieces_of(&description.materials) {
        append_list(&mut text, "materials", &SceneDescription { materials, ..SceneDescription::default() });
    }
    for objects in description.objects.chunks(PIECE) {
        append_list(&mut text, "objects", &SceneDescription { objects: objects.to_vec(), ..SceneDescription::default() });
    }
    for punctual_lights in description.punctual_lights.chunks(PIECE) {
        append_list(
            &mut text,
            "lights",
            &SceneDescription { punctual_lights: punctual_lights.to_vec(), ..SceneDescription::default() },
        );
    }
    append(&mut text, entries.filter(|entry| !is_list(entry)).collect());
    text
}

/// A map in pieces.
fn pieces_of<T: Clone>(map: &BTreeMap<String, T>) -> impl Iterator<Item = BTreeMap<String, T>> {
    let mut all = map.iter();
    std::iter::from_fn(move || {
        let piece: BTreeMap<String, T> = all.by_ref().take(PIECE).map(|(name, item)| (name.clone(), item.clone())).collect();
        (!piece.is_empty()).then_some(piece)
    })
}

/// Appends the tables of a list. `piece` has nothing else.
fn append_list(text: &mut String, key: &str, piece: &SceneDescription) {
    append(text, Table::of(piece).entries.into_iter().filter(|entry| entry.key == key).collect());
}

/// Appends entries of the file.
fn append(text: &mut String, entries: Vec<Entry>) {
    let mut document = DocumentMut::new();
    let (was, now) = (Table::default(), Table { entries, name: None });
    Update { origins: &Origins::default() }.table(document.as_table_mut(), &was, &now, Level::Root);
    let piece = document.to_string();
    if !text.is_empty() && !piece.is_empty() {
        text.push('\n');
    }
    text.push_str(&piece);
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_scene::scene::{BUILT_IN, describe};

    /// The text of a scene that is written at once.
    fn at_once(description: &SceneDescription) -> String {
        let mut text = String::new();
        append(&mut text, Table::of(description).entries);
        text
    }

    #[test]
    fn pieces_make_the_text_of_the_whole() {
        let mut scene = describe("scene", BUILT_IN.to_owned()).expect("it is a scene");
        assert_eq!(new_text(&scene), at_once(&scene));
        let (object, material) = (scene.objects[0].clone(), scene.materials.values().next().expect("there is one").clone());
        for count in [0, 1, PIECE - 1, PIECE, 3 * PIECE + 7] {
            scene.objects = vec![object.clone(); count];
            scene.materials = (0..count).map(|number| (format!("m {number}"), material.clone())).collect();
            scene.textures = (0..count).map(|number| (format!("t{number}"), Default::default())).collect();
            scene.punctual_lights = vec![Default::default(); count];
            assert!(new_text(&scene) == at_once(&scene), "{count} items");
        }
        assert_eq!(new_text(&SceneDescription::default()), at_once(&SceneDescription::default()));
    }
}
