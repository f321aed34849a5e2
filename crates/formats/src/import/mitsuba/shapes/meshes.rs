//! Meshes of files.
use std::path::Path;

use super::{
    super::{
        context::{Import, Lists},
        tree::Element,
    },
    Geometry, Placed, attributes,
};
use noisefall_base::{
    declare::key_of_file,
    memory::{Size, reserve},
};
use noisefall_scene::{
    model::{Model, Smoothing, read_watched},
    scene::SceneError,
    shape::{Mesh, ShapeKind, mesh::MeshSource},
};

/// How a mesh differs from its file.
pub struct Variant {
    /// Whether v of the file runs downwards.
    pub flip_v: bool,
    /// Whether textures lie on it. Without coordinates of the file, each triangle is half of the unit square, as in Mitsuba.
    pub charted: bool,
    /// Whether normals are those of the triangles.
    pub face_normals: bool,
}

pub fn obj(import: &mut Import, element: Element, placed: Placed) -> Result<Geometry, SceneError> {
    element.ignore(&["collapse", "max_smooth_angle"]);
    file(import, element, placed, true)
}

pub fn ply(import: &mut Import, element: Element, placed: Placed) -> Result<Geometry, SceneError> {
    element.ignore(&["srgb"]);
    file(import, element, placed, false)
}

fn file(import: &mut Import, element: Element, placed: Placed, flips_by_default: bool) -> Result<Geometry, SceneError> {
    let path = import.file(element, "filename")?;
    let face_normals = element.flag("face_normals", false)?;
    // Mitsuba's v runs downwards, and that of a model upwards.
    let flip_v = !element.flag("flip_tex_coords", flips_by_default)? && placed.uses.coordinates;
    let charted = placed.uses.coordinates && !lists(import, element, &path)?.uvs;
    let mirrors = placed.is_mirrored();
    let flip = placed.flip ^ (mirrors && (face_normals || !lists(import, element, &path)?.normals));
    let shape = if flip_v || charted || !placed.uses.attributes.is_empty() {
        let wanted: Vec<&String> = placed.uses.attributes.iter().collect();
        let key = format!("{} {flip_v} {charted} {face_normals} {wanted:?}", path.display());
        let name = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let file = import.shared_model(&key, &name, |import| {
            let mut model = read(import, element, &path)?;
            attributes::apply(import, element, &path, &mut model, placed.uses, face_normals)?;
            let variant = Variant { flip_v, charted, face_normals };
            Ok(variant.of(model))
        })?;
        in_memory(file, !face_normals)
    } else {
        let source = MeshSource::File(import.files.folder.described(&path));
        // Mitsuba does not read smoothing groups.
        Mesh { source, smooth: Some(!face_normals) }.into()
    };
    Ok(Geometry { shape, map: placed.map, flip })
}

impl Variant {
    /// The model with these changes.
    pub fn of(&self, mut model: Model) -> Model {
        if self.flip_v
            && let Some(uvs) = &mut model.uvs
        {
            uvs.iter_mut().for_each(|uv| uv[1] = 1.0 - uv[1]);
        }
        if self.charted && model.uvs.is_none() {
            model = attributes::unwelded(&model, self.face_normals);
            model.uvs = Some([[0.0, 1.0], [1.0, 1.0], [0.0, 0.0]].repeat(model.triangles.len()));
        }
        if self.face_normals {
            model.normals = None;
        }
        model.smoothing = Smoothing::Unstated;
        model
    }
}

/// Reads the file of a mesh.
fn read(import: &Import, element: Element, path: &Path) -> Result<Model, SceneError> {
    let read = read_watched(path, &import.files.folder.progress);
    read.map_err(|error| element.error(error.to_string(), "this mesh cannot be used"))
}

/// A mesh in memory.
pub fn in_memory(path: String, smooth: bool) -> ShapeKind {
    Mesh { source: MeshSource::File(path), smooth: (!smooth).then_some(false) }.into()
}

/// Returns the lists of a file. A mirror reverses normals of triangles, but not those of the file. The compile reuses the model.
fn lists(import: &mut Import, element: Element, path: &Path) -> Result<Lists, SceneError> {
    if let Some(known) = import.known_lists.get(path) {
        return Ok(*known);
    }
    let key = key_of_file(&import.files.compiled(path));
    let model = read(import, element, path)?;
    let lists = Lists { normals: model.normals.is_some(), uvs: model.uvs.is_some() };
    import.known_lists.insert(path.to_owned(), lists);
    let bytes = model.bytes();
    if let Ok(memory) = reserve(format_args!("{} of a mesh", Size(bytes)), bytes) {
        import.new_files.assets.hand_over(key, model, memory);
    }
    Ok(lists)
}

impl Import {
    /// The path of a model in memory, which is made once for each key.
    pub fn shared_model(
        &mut self,
        key: &str,
        name: &str,
        make: impl FnOnce(&mut Import) -> Result<Model, SceneError>,
    ) -> Result<String, SceneError> {
        if let Some(path) = self.known_models.get(key) {
            return Ok(path.clone());
        }
        let model = make(self)?;
        let path = self.new_files.add_model(name, model);
        self.known_models.insert(key.to_owned(), path.clone());
        Ok(path)
    }
}
