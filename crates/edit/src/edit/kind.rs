//! Changes of kind that change other parameters too.
use super::{change::Edit, choose::choose, document::Document, meaning::kept_by_kind, tree::Tree};
use noisefall_base::declare::{OneOf, OwnedValue, Path, Resources, Step};
use noisefall_scene::{
    material::Material,
    scene::{
        Projection,
        description::{CameraDescription, MaterialDescription, SceneDescription},
    },
    shape::{Fit, ShapeBuilder, ShapeKind, Transform},
};

impl Document {
    /// The edit that chooses another alternative and changes the parameters that depend on it: parallel rays have neither an angle nor
    /// a lens, a textured emission needs the name of a texture, a blend keeps the material as its first part, a material keeps its
    /// colour, its roughness and its index under the keys of its new kind, and an object its place and size. `path` and `choice` are those of [`Edit::Choose`].
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
            ("material", "blend") => edits.extend(self.of_blend(path)),
            ("shape", _) => edits.extend(self.of_shape(path, name)),
            ("material", _) => edits.extend(of_material(path, name, scene)),
            _ => {}
        }
        if edits.len() == 1 { edits.swap_remove(0) } else { Edit::All(edits) }
    }

    /// The edits that keep a material as the first part of the blend that it becomes, and give it another one as the second. Neither is
    /// a blend, so none leads back to it.
    fn of_blend(&self, path: &Path) -> Vec<Edit> {
        let materials = &self.description().materials;
        let Some((name, material)) = named(path).and_then(|name| materials.get_key_value(name)) else { return Vec::new() };
        if matches!(material.kind, Material::Blend(_)) {
            return Vec::new();
        }
        let first = self.free_name("materials", name);
        // The opacity is that of the blend.
        let mut part = MaterialDescription { opacity: None, ..material.clone() };
        let other = materials.iter().find(|(other, described)| *other != name && !matches!(described.kind, Material::Blend(_)));
        let second = other.map_or(&first, |(other, _)| other);
        let set = |key: &str, name: &str| Edit::set(path.key("blend").key(key), OwnedValue::Text(name.to_owned()));
        let insert = Edit::insert_tree(Path::of("materials").key(&first), Tree::of(&mut part));
        vec![insert, set("first", &first), set("second", second)]
    }

    /// The edits that leave an object where it is and as large as it is: of its new shape, or else of its transforms. None if the shape
    /// takes time to build, or if it has the parameters already.
    fn of_shape(&self, path: &Path, kind: &str) -> Vec<Edit> {
        let [Step::Key(_), Step::Item(place), Step::Key(_)] = &path.0[..] else { return Vec::new() };
        let Some(object) = self.description().objects.get(*place) else { return Vec::new() };
        let shape = object.shape.kind();
        let resources = Resources::new("");
        let built = if shape.is_quick() { ShapeBuilder::new(&resources).build(&object.shape).ok() } else { None };
        let Some(fit) = built.and_then(|shapes| Fit::around(&shapes)) else { return Vec::new() };
        let mut changed = object.clone();
        choose(&mut changed, &Path::of("shape"), ShapeKind::WHAT, kind);
        let Some(changes) = changed.shape.kind().fitted(&fit) else { return placed(*place, &fit) };
        let name = changed.shape.name();
        let at = |key: &str| Path::of(name).join(&Path::of(key));
        let mut has = |key: &str, value: &OwnedValue| {
            let found = Tree::at(&mut changed, &Path::of("shape").join(&at(key)));
            found.is_some_and(|found| found.value() == Some(value))
        };
        let new: Vec<_> = changes.into_iter().filter(|(key, value)| !has(key, value)).collect();
        new.into_iter().map(|(key, value)| Edit::set(path.join(&at(key)), value)).collect()
    }
}

/// The edits that place a shape which fills the cube from −1 to 1, before the other transforms of the object.
fn placed(object: usize, fit: &Fit) -> Vec<Edit> {
    let list = Path::of("objects").item(object).key("transform");
    let insert = |(at, transform): (usize, &mut Transform)| Edit::insert_tree(list.item(at), Tree::of(transform));
    fit.transforms().iter_mut().enumerate().map(insert).collect()
}

/// The edits that give a material of another kind what it had: its colour, its roughness, its index of refraction.
fn of_material(path: &Path, kind: &str, scene: &SceneDescription) -> Vec<Edit> {
    let Some(material) = named(path).and_then(|name| scene.materials.get(name)) else { return Vec::new() };
    let set = |(inner, value): (Path, OwnedValue)| Edit::set(path.join(&inner), value);
    kept_by_kind(material, kind).into_iter().map(set).collect()
}

/// The name at the end of the path of a material.
fn named(path: &Path) -> Option<&str> {
    if let [Step::Key(_), Step::Key(name)] = &path.0[..] { Some(name) } else { None }
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
