//! Names that are free, and the edits that need one.
use super::{Document, Edit, tree::Answer};
use noisefall_base::declare::{OwnedValue, Path, Step};

impl Document {
    /// An unused name in a table of the scene: `wanted`, or `wanted` with a number. The table is `objects`, `lights`, `materials` or
    /// `textures`.
    pub fn free_name(&self, table: &str, wanted: &str) -> String {
        let scene = self.description();
        let is_taken = |name: &str| match table {
            "objects" => scene.objects.iter().any(|object| object.name == name),
            "lights" => scene.punctual_lights.iter().any(|punctual_light| punctual_light.name == name),
            "materials" => scene.materials.contains_key(name),
            _ => scene.textures.contains_key(name),
        };
        let (stem, number) = numbered(wanted);
        let others = (u64::from(number.max(1)) + 1..).map(|number| format!("{stem} {number}"));
        let mut names = std::iter::once(wanted.to_owned()).chain(others);
        names.find(|name| !is_taken(name)).unwrap_or_else(|| wanted.to_owned())
    }

    /// The edit that copies an object, a light, a material or a texture, and the path of the copy. A copied object or light follows its
    /// original in the list.
    pub fn duplicate(&mut self, path: &Path) -> Option<(Edit, Path)> {
        let mut tree = self.tree(path)?;
        let copy = match &path.0[..] {
            [Step::Key(list), Step::Item(place)] if list == "objects" || list == "lights" => {
                let scene = self.description();
                let name = match list.as_str() {
                    "objects" => &scene.objects.get(*place)?.name,
                    _ => &scene.punctual_lights.get(*place)?.name,
                };
                let free = if name.is_empty() { String::new() } else { self.free_name(list, name) };
                // The name is the first value of an object or a light.
                *tree.0.first_mut()? = Answer::Value(OwnedValue::Text(free));
                Path::of(list).item(place + 1)
            }
            [Step::Key(map), Step::Key(name)] => Path::of(map).key(&self.free_name(map, name)),
            _ => return None,
        };
        Some((Edit::insert_tree(copy.clone(), tree), copy))
    }

    /// The edit that gives objects a material; `None` makes them black.
    pub fn assign(&self, objects: &[usize], material: Option<&str>) -> Edit {
        let at = |place: &usize| Path::of("objects").item(*place).key("material");
        let has_one = |place: &&usize| self.description().objects.get(**place).is_some_and(|object| object.material.is_some());
        Edit::All(match material {
            Some(name) => objects.iter().map(|place| Edit::set(at(place), OwnedValue::Text(name.to_owned()))).collect(),
            None => objects.iter().filter(has_one).map(|place| Edit::remove(at(place))).collect(),
        })
    }
}

/// A name without the number at its end, and that number.
fn numbered(name: &str) -> (&str, u32) {
    match name.rsplit_once(' ') {
        Some((stem, number)) if number.bytes().all(|byte| byte.is_ascii_digit()) => match number.parse() {
            Ok(number) => (stem, number),
            Err(_) => (name, 1),
        },
        _ => (name, 1),
    }
}
