//! The parts of the file from which the objects, materials and textures of a document come. Saving keeps their text.
use std::collections::BTreeMap;

use noisefall_base::declare::{Path, Step};
use noisefall_scene::scene::description::SceneDescription;

/// An object, a material or a texture of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin(Step);

/// The origins of all objects, materials and textures of a document; new ones have none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Origins {
    /// By place.
    pub objects: Vec<Option<usize>>,
    /// By table and name.
    pub named: BTreeMap<String, BTreeMap<String, String>>,
}

impl Origins {
    /// The origins of a description that equals the file.
    pub fn of(description: &SceneDescription) -> Origins {
        let same = |names: Vec<&String>| names.into_iter().map(|name| (name.clone(), name.clone())).collect();
        let named = [
            ("materials".to_owned(), same(description.materials.keys().collect())),
            ("textures".to_owned(), same(description.textures.keys().collect())),
        ];
        Origins { objects: (0..description.objects.len()).map(Some).collect(), named: named.into() }
    }

    /// Records the origin of the part that was added at a path.
    pub fn insert(&mut self, path: &Path, origin: Option<&Origin>) {
        match (&path.0[..], origin) {
            ([Step::Key(list), Step::Item(place)], origin) if list == "objects" => {
                let of = origin.and_then(|origin| if let Step::Item(of) = origin.0 { Some(of) } else { None });
                self.objects.insert((*place).min(self.objects.len()), of);
            }
            ([Step::Key(map), Step::Key(name)], Some(Origin(Step::Key(of)))) => {
                if let Some(names) = self.named.get_mut(map) {
                    names.insert(name.clone(), of.clone());
                }
            }
            _ => {}
        }
    }

    /// Forgets the part that was removed from a path.
    pub fn remove(&mut self, path: &Path) -> Option<Origin> {
        match &path.0[..] {
            [Step::Key(list), Step::Item(place)] if list == "objects" && *place < self.objects.len() => {
                self.objects.remove(*place).map(|of| Origin(Step::Item(of)))
            }
            [Step::Key(map), Step::Key(name)] => {
                let of = self.named.get_mut(map).and_then(|names| names.remove(name));
                of.map(|of| Origin(Step::Key(of)))
            }
            _ => None,
        }
    }

    /// Follows an item to another place in its list.
    pub fn relocate(&mut self, path: &Path, to: usize) {
        if let [Step::Key(list), Step::Item(_)] = &path.0[..] {
            let origin = self.remove(path);
            self.insert(&Path(vec![Step::Key(list.clone()), Step::Item(to)]), origin.as_ref());
        }
    }

    /// The name in the file of the table that has a given name now.
    pub fn name(&self, map: &str, name: &str) -> Option<&str> {
        self.named.get(map)?.get(name).map(String::as_str)
    }
}
