//! The JSON of a file: its lists, and the extensions that it uses.
use std::collections::{BTreeMap, BTreeSet, HashMap};

use serde_json::{Map, Value, json};

use super::buffer::Buffer;

/// A document with its binary data.
#[derive(Default)]
pub struct Document {
    pub buffer: Buffer,
    lists: BTreeMap<&'static str, Vec<Value>>,
    extensions: BTreeSet<&'static str>,
    punctual_lights: Vec<Value>,
    /// Indices of elements that are listed once, by list and text.
    known: HashMap<(&'static str, String), usize>,
}

impl Document {
    /// Adds an element to a list, and returns its index.
    pub fn add(&mut self, list: &'static str, element: Value) -> usize {
        let list = self.lists.entry(list).or_default();
        list.push(element);
        list.len() - 1
    }

    /// Adds an element unless the list has an equal one, and returns its index.
    pub fn add_once(&mut self, list: &'static str, element: Value) -> usize {
        let key = (list, element.to_string());
        if let Some(index) = self.known.get(&key) {
            return *index;
        }
        let index = self.add(list, element);
        self.known.insert(key, index);
        index
    }

    /// Adds a light of KHR_lights_punctual, and returns its index.
    pub fn add_light(&mut self, punctual_light: Value) -> usize {
        self.punctual_lights.push(punctual_light);
        self.punctual_lights.len() - 1
    }

    /// Adds an extension to an object of the document.
    pub fn extend(&mut self, object: &mut Map<String, Value>, name: &'static str, content: Value) {
        self.extensions.insert(name);
        object.entry("extensions").or_insert_with(|| json!({}))[name] = content;
    }

    /// The document. Lists without elements are left out, as the format asks.
    pub fn finish(mut self) -> Value {
        let mut all = Map::new();
        all.insert("asset".to_owned(), json!({ "version": "2.0", "generator": "Noisefall" }));
        if !self.punctual_lights.is_empty() {
            let punctual_lights = json!({ "lights": std::mem::take(&mut self.punctual_lights) });
            self.extend(&mut all, LIGHTS, punctual_lights);
        }
        if !self.extensions.is_empty() {
            all.insert("extensionsUsed".to_owned(), self.extensions.iter().copied().collect());
        }
        // There is a camera at least.
        let nodes: Vec<usize> = (0..self.lists.get("nodes").map_or(0, Vec::len)).collect();
        all.insert("scene".to_owned(), json!(0));
        all.insert("scenes".to_owned(), json!([{ "nodes": nodes }]));
        all.extend(self.lists.into_iter().map(|(name, list)| (name.to_owned(), Value::from(list))));
        Value::Object(all)
    }
}

/// The extension of punctual lights.
pub const LIGHTS: &str = "KHR_lights_punctual";
