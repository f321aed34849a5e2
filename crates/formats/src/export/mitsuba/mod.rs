//! Scenes of Mitsuba 3 in XML.
//!
//! Each family of its plugins is a file: it undoes the translation of the same file of the reader, `import/mitsuba/`. What Mitsuba has
//! no plugin for becomes a remark.
//!
//! | file | holds |
//! |---|---|
//! | `markup.rs` | elements of XML |
//! | `context.rs` | the scene so far, names and remarks |
//! | `shapes.rs` | shapes and the light that they emit |
//! | `bsdfs.rs`, `glossy.rs`, `layered.rs` | materials |
//! | `textures.rs` | colours, numbers and textures |
//! | `emitters.rs` | lights and environments |
//! | `sensor.rs` | camera, film, sampler and integrator |
mod bsdfs;
mod context;
mod emitters;
mod glossy;
mod layered;
mod markup;
mod sensor;
mod shapes;
mod sky_rows;
#[cfg(test)]
mod tests;
mod textures;

use std::path::Path;

use self::{context::Export, markup::Element};
use super::{ExportError, ExportSource, Prepared, files::ExportedFiles, geometry};
use noisefall_base::declare::{self, Resources};

/// The version of Mitsuba whose syntax is written.
const VERSION: &str = "3.0.0";

/// Translates a scene.
pub fn prepare(source: ExportSource, path: &Path) -> Result<Prepared, ExportError> {
    let resources = Resources::new(source.folder).with_assets(source.assets.clone());
    let mut export = Export::new(source, &resources);
    sensor::settings(&mut export);
    for (place, object) in source.description.objects.iter().enumerate() {
        let name = || source.description.part_name(&declare::Path::of("objects").item(place));
        let shapes = geometry::shapes(object, &resources)
            .map_err(|problem| ExportError::Invalid { place: name(), reason: problem.message })?;
        shapes::object(&mut export, place, object, &shapes)?;
    }
    emitters::all(&mut export);
    let Export { scene, new, notes, .. } = export;
    let mut scene = Element::new("scene").attribute("version", VERSION).with_all(scene);
    let moved = ExportSource { assets: &new.assets, ..source };
    let files = ExportedFiles::place(&moved, new.named, path)?;
    scene.for_each_file(&mut |file: &mut String| *file = files.path(file));
    let mut text = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n".to_owned();
    scene.write(&mut text, 0);
    Ok(Prepared { path: path.to_owned(), content: text.into_bytes(), files, remarks: notes.remarks })
}
