//! Scenes in glTF 2.0.
//!
//! Each family is a file: it undoes the translation of the same file of the reader, `import/gltf/`. What the format cannot express
//! becomes a remark.
//!
//! | file | holds |
//! |---|---|
//! | `context.rs`, `known.rs` | the scene so far, names and remarks |
//! | `document.rs`, `buffer.rs`, `accessors.rs`, `container.rs` | JSON, binary data, and the files of both |
//! | `shapes.rs`, `units.rs` | nodes and meshes |
//! | `materials/` | materials and the light that surfaces emit |
//! | `textures.rs`, `pixels.rs` | colours, numbers and images |
//! | `lights.rs` | lights |
//! | `camera.rs` | the camera |
mod accessors;
mod buffer;
mod camera;
mod container;
mod context;
mod document;
mod known;
mod lights;
mod materials;
mod pixels;
mod shapes;
#[cfg(test)]
mod tests;
mod textures;
mod units;

use std::path::Path;

use self::context::Export;
use super::{ExportError, ExportSource, Prepared, geometry};
use noisefall_base::declare::{self, Resources};

/// Translates a scene to JSON with files beside it.
pub fn prepare_text(source: ExportSource, path: &Path) -> Result<Prepared, ExportError> {
    prepare(source, |export| export.text(source, path))
}

/// Translates a scene to one binary file.
pub fn prepare_binary(source: ExportSource, path: &Path) -> Result<Prepared, ExportError> {
    prepare(source, |export| export.binary(source, path))
}

fn prepare(source: ExportSource, finish: impl FnOnce(Export) -> Result<Prepared, ExportError>) -> Result<Prepared, ExportError> {
    let resources = Resources::new(source.folder).with_assets(source.assets.clone());
    let mut export = Export::new(source, &resources);
    camera::add(&mut export);
    for (place, object) in source.description.objects.iter().enumerate() {
        let name = || source.description.part_name(&declare::Path::of("objects").item(place));
        let shapes = geometry::shapes(object, &resources)
            .map_err(|problem| ExportError::Invalid { place: name(), reason: problem.message })?;
        shapes::object(&mut export, place, object, &shapes)?;
    }
    lights::all(&mut export)?;
    finish(export)
}
