//! Meshes of Mitsuba's own format.
use std::collections::hash_map::Entry;

use super::{
    super::{context::Import, packed::Packed, tree::Element},
    Geometry, Placed,
    meshes::{self, Variant},
};
use noisefall_scene::{model::Model, scene::SceneError};

pub fn serialized(import: &mut Import, element: Element, placed: Placed) -> Result<Geometry, SceneError> {
    let path = import.file(element, "filename")?;
    let number = element.integer("shape_index")?.unwrap_or(0);
    let face_normals = element.flag("face_normals", false)?;
    let flip_v = !element.flag("flip_tex_coords", false)?;
    let charted = placed.uses.coordinates;
    let key = format!("{} {number} {flip_v} {charted} {face_normals}", path.display());
    let name = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let file = import.shared_model(&key, &name, |import| {
        let error = |message: &str| element.error(format!("the mesh cannot be read: {message}"), "this file cannot be used");
        let budget = import.files.folder.budget.clone();
        let packed = match import.packed.entry(path.clone()) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(free) => {
                let packed = Packed::read(&path).map_err(|reason| error(&reason))?;
                budget.packed(packed.length());
                free.insert(packed)
            }
        };
        let model = packed.mesh(number).map_err(|reason| error(&reason))?;
        budget.unpack(model.bytes()).map_err(|reason| error(&reason))?;
        Ok(Variant { flip_v, charted, face_normals }.of(model))
    })?;
    let mirrors = placed.is_mirrored();
    let has_normals = import.new_files.assets.get::<Model>(&file).is_some_and(|model| model.normals.is_some());
    let flip = placed.flip ^ (mirrors && !has_normals);
    Ok(Geometry { shape: meshes::in_memory(file, !face_normals), map: placed.map, flip })
}
