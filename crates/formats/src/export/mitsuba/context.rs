//! The state of an export: what it has written so far.
use std::collections::HashMap;

use super::{
    super::{ExportSource, new_assets::NewAssets, notes::Notes, textures::Colors},
    markup::Element,
};
use crate::import::Names;
use noisefall_base::declare::Resources;
use noisefall_scene::scene::description::SceneDescription;

/// A translation.
pub struct Export<'a> {
    pub description: &'a SceneDescription,
    pub colors: Colors<'a>,
    pub new: NewAssets,
    pub notes: Notes,
    /// The elements of the scene.
    pub scene: Vec<Element>,
    /// Whether what is being translated uses coordinates of the surface.
    pub uses_coordinates: bool,
    /// Ids of textures.
    pub textures: HashMap<String, ReferencedObject>,
    /// Ids of materials by name and whether their back reflects.
    pub materials: HashMap<String, ReferencedObject>,
    /// Paths of meshes by what determines them.
    pub meshes: HashMap<usize, String>,
    ids: Names,
}

/// An object that others refer to.
#[derive(Clone)]
pub struct ReferencedObject {
    pub id: String,
    pub uses_coordinates: bool,
}

impl<'a> Export<'a> {
    pub fn new(source: ExportSource<'a>, resources: &'a Resources) -> Export<'a> {
        Export {
            description: source.description,
            colors: Colors::new(source.description, resources),
            new: NewAssets::new(source.assets),
            notes: Notes::default(),
            scene: Vec::new(),
            uses_coordinates: false,
            textures: HashMap::new(),
            materials: HashMap::new(),
            meshes: HashMap::new(),
            ids: Names::default(),
        }
    }

    /// Adds a remark about what is being translated.
    pub fn remark(&mut self, found: impl Into<String>, used: impl Into<String>, effect: impl Into<String>) {
        self.notes.add(found, used, effect);
    }

    /// An id that no other object has. Mitsuba reserves dots and leading underscores, and replaces what follows a `$`.
    pub fn id(&mut self, name: &str, fallback: &str) -> String {
        let plain: String = name.chars().map(|c| if c == '.' || c == '$' || c.is_control() { '-' } else { c }).collect();
        self.ids.unique(plain.trim_start_matches('_'), fallback)
    }

    /// Translates something at a place, and returns whether it uses coordinates.
    pub fn at<T>(&mut self, place: String, translate: impl FnOnce(&mut Export<'a>) -> T) -> (T, bool) {
        let outer = (self.notes.enter(place), std::mem::take(&mut self.uses_coordinates));
        let made = translate(self);
        let uses = self.uses_coordinates;
        self.notes.enter(outer.0);
        self.uses_coordinates = outer.1 | uses;
        (made, uses)
    }
}
