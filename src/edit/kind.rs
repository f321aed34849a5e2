//! Changes of kind that change other parameters too.
use super::{change::Edit, document::Document};
use crate::declare::{OwnedValue, Path};

impl Document {
    /// The edit that chooses another alternative and changes the parameters that depend on it: parallel rays have neither an angle nor
    /// a lens, and a textured emission needs the name of a texture. `path` and `choice` are those of [`Edit::Choose`].
    pub fn change_kind(&self, path: &Path, choice: &str, name: &str) -> Edit {
        let scene = self.description();
        let camera = Path::of("camera");
        let mut edits = vec![Edit::choose(path.clone(), choice, name)];
        match (choice, name) {
            ("projection", "orthographic") => {
                let given = [("fov", scene.camera.fov.is_some()), ("lens", scene.camera.lens.is_some())];
                edits.extend(given.iter().filter(|(_, is_given)| *is_given).map(|(key, _)| Edit::remove(camera.key(key))));
            }
            ("projection", "perspective") if scene.camera.fov.is_none() => edits.push(Edit::insert(camera.key("fov"))),
            ("emission", "texture") => {
                let first = scene.textures.keys().next();
                edits.extend(first.map(|texture| Edit::set(path.key("texture"), OwnedValue::Text(texture.clone()))));
            }
            _ => {}
        }
        if edits.len() == 1 { edits.swap_remove(0) } else { Edit::All(edits) }
    }
}
