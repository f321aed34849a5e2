//! What of the file the objects, materials and textures of a document stand for: saving keeps their text.
use std::collections::BTreeMap;

use crate::{
    declare::{Path, Step},
    scene::description::SceneDescription,
};

/// An object, a material or a texture of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin(Step);

/// The origins of all that a document has; what is new has none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Origins {
    /// By place.
    pub objects: Vec<Option<usize>>,
    /// By table and name.
    pub named: BTreeMap<String, BTreeMap<String, String>>,
}

impl Origins {
    /// Of a description as the file has it.
    pub fn of(description: &SceneDescription) -> Origins {
        let same = |names: Vec<&String>| names.into_iter().map(|name| (name.clone(), name.clone())).collect();
        let named = [
            ("materials".to_owned(), same(description.materials.keys().collect())),
            ("textures".to_owned(), same(description.textures.keys().collect())),
        ];
        Origins { objects: (0..description.objects.len()).map(Some).collect(), named: named.into() }
    }

    /// What has been added at a path has this origin.
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

    /// What was at a path is removed.
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

    /// What was at a path is at another place of its list.
    pub fn relocate(&mut self, path: &Path, to: usize) {
        if let [Step::Key(list), Step::Item(_)] = &path.0[..] {
            let origin = self.remove(path);
            self.insert(&Path(vec![Step::Key(list.clone()), Step::Item(to)]), origin.as_ref());
        }
    }

    /// The name in the file of what has a name now.
    pub fn name(&self, map: &str, name: &str) -> Option<&str> {
        self.named.get(map)?.get(name).map(String::as_str)
    }
}
