//! Changes of kind that change other parameters too.
use super::{change::Edit, colour::colour_of_kind, document::Document};
use crate::{
    declare::{OneOf, OwnedValue, Path, Step},
    material::Material,
    scene::{
        Projection,
        description::{CameraDescription, SceneDescription},
    },
};

impl Document {
    /// The edit that chooses another alternative and changes the parameters that depend on it: parallel rays have neither an angle nor
    /// a lens, a textured emission needs the name of a texture, a blend those of two materials, and a material keeps its colour under
    /// the key of its new kind. `path` and `choice` are those of [`Edit::Choose`].
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
            ("material", "blend") => edits.extend(of_blend(path, scene)),
            ("material", _) => edits.extend(of_material(path, name, scene)),
            _ => {}
        }
        if edits.len() == 1 { edits.swap_remove(0) } else { Edit::All(edits) }
    }
}

/// The edit that gives a material of another kind the colour that it had.
fn of_material(path: &Path, kind: &str, scene: &SceneDescription) -> Option<Edit> {
    let [Step::Key(_), Step::Key(name)] = &path.0[..] else { return None };
    let (colour, value) = colour_of_kind(scene.materials.get(name)?, kind)?;
    Some(Edit::set(Path(path.0.iter().cloned().chain(colour.0).collect()), value))
}

/// The edits that give a blend two other materials. Neither is a blend, so none leads back to it.
fn of_blend(path: &Path, scene: &SceneDescription) -> Vec<Edit> {
    let is_this = |name: &str| matches!(path.0.last(), Some(Step::Key(key)) if key == name);
    let others = scene.materials.iter().filter(|(name, other)| !is_this(name) && !matches!(other.kind, Material::Blend(_)));
    let names: Vec<&String> = others.map(|(name, _)| name).take(2).collect();
    let (Some(first), Some(second)) = (names.first(), names.last()) else { return Vec::new() };
    let set = |key: &str, name: &str| Edit::set(path.key("blend").key(key), OwnedValue::Text(name.to_owned()));
    vec![set("first", first), set("second", second)]
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
