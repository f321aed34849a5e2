//! The state of an export: what it has written so far.
use std::collections::HashMap;

use glam::DAffine3;
use serde_json::{Map, Value, json};

use super::{
    super::{ExportSource, new_assets::NewAssets, notes::Notes, textures::Colors},
    document::Document,
    known::{Columns, Made, Mapped, MeshKey, Triangles},
};
use crate::import::Names;
use noisefall_base::declare::Resources;
use noisefall_scene::scene::description::SceneDescription;

/// A translation.
pub struct Export<'a> {
    pub description: &'a SceneDescription,
    pub resources: &'a Resources,
    pub colors: Colors<'a>,
    pub new: NewAssets,
    pub notes: Notes,
    pub document: Document,
    /// Names of materials.
    pub names: Names,
    /// Materials by name and emission.
    pub materials: HashMap<String, Made>,
    /// Paths of image files, in the order of their indices.
    pub images: Vec<String>,
    /// Textures by what determines them.
    pub maps: HashMap<String, Option<Mapped>>,
    /// Accessors of vertices and triangles.
    pub columns: HashMap<(Triangles, bool), Columns>,
    /// Accessors of colours of vertices, and whether they have opacity.
    pub vertex_colors: HashMap<(Triangles, bool), usize>,
    pub meshes: HashMap<MeshKey, usize>,
    /// Number of meshes whose nodes would shear them.
    pub sheared: usize,
    /// Whether what is being translated has textures.
    pub uses_coordinates: bool,
}

impl<'a> Export<'a> {
    pub fn new(source: ExportSource<'a>, resources: &'a Resources) -> Export<'a> {
        Export {
            description: source.description,
            resources,
            colors: Colors::new(source.description, resources),
            new: NewAssets::new(source.assets),
            notes: Notes::default(),
            document: Document::default(),
            names: Names::default(),
            materials: HashMap::new(),
            images: Vec::new(),
            maps: HashMap::new(),
            columns: HashMap::new(),
            vertex_colors: HashMap::new(),
            meshes: HashMap::new(),
            sheared: 0,
            uses_coordinates: false,
        }
    }

    /// Adds a remark about what is being translated.
    pub fn remark(&mut self, found: impl Into<String>, used: impl Into<String>, effect: impl Into<String>) {
        self.notes.add(found, used, effect);
    }

    /// Translates something at a place.
    pub fn at<T>(&mut self, place: String, translate: impl FnOnce(&mut Export<'a>) -> T) -> T {
        let outer = self.notes.enter(place);
        let made = translate(self);
        self.notes.enter(outer);
        made
    }

    /// Adds a node of the scene.
    pub fn node(&mut self, name: &str, place: &DAffine3, mut node: Map<String, Value>) {
        if !name.is_empty() {
            node.insert("name".to_owned(), json!(name));
        }
        if *place != DAffine3::IDENTITY {
            // Column by column.
            let column = |v: glam::DVec3, w: f64| [v.x, v.y, v.z, w];
            let DAffine3 { matrix3: m, translation } = place;
            let columns = [column(m.x_axis, 0.0), column(m.y_axis, 0.0), column(m.z_axis, 0.0), column(*translation, 1.0)];
            node.insert("matrix".to_owned(), json!(columns.as_flattened()));
        }
        self.document.add("nodes", Value::Object(node));
    }
}

/// A map of JSON from its literal.
pub fn table(value: Value) -> Map<String, Value> {
    match value {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}
