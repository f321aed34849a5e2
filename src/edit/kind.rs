//! Changes of kind that change other parameters too.
use super::{change::Edit, document::Document};
use crate::{
    declare::{OneOf, OwnedValue, Path},
    scene::{Projection, description::CameraDescription},
};

impl Document {
    /// The edit that chooses another alternative and changes the parameters that depend on it: parallel rays have neither an angle nor
    /// a lens, and a textured emission needs the name of a texture. `path` and `choice` are those of [`Edit::Choose`].
    pub fn change_kind(&self, path: &Path, choice: &str, name: &str) -> Edit {
        let scene = self.description();
        let mut edits = vec![Edit::choose(path.clone(), choice, name)];
        match (choice, name) {
            ("projection", _) => {
                let projection = Projection::alternatives().into_iter().find(|projection| projection.name() == name);
                edits.extend(projection.into_iter().flat_map(|projection| of_projection(projection, &scene.camera)));
            }
            ("emission", "texture") => {
                let first = scene.textures.keys().next();
                edits.extend(first.map(|texture| Edit::set(path.key("texture"), OwnedValue::Text(texture.clone()))));
            }
            _ => {}
        }
        if edits.len() == 1 { edits.swap_remove(0) } else { Edit::All(edits) }
    }
}

/// The edits that give a camera what a projection needs, and take away what it cannot have.
fn of_projection(projection: Projection, camera: &CameraDescription) -> Vec<Edit> {
    let at = |key| Path::of("camera").key(key);
    let mut edits = Vec::new();
    match (projection.has_angle(), camera.fov) {
        (true, None) => edits.push(Edit::insert(at("fov"))),
        (false, Some(_)) => edits.push(Edit::remove(at("fov"))),
        _ => {}
    }
    if camera.lens.is_some() && !projection.takes_lens() {
        edits.push(Edit::remove(at("lens")));
    }
    edits
}
