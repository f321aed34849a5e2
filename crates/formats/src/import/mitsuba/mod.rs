//! Scenes of Mitsuba 2 and 3 in XML.
//!
//! A file becomes a tree of elements (`load.rs`, `tree.rs`), with parameters, defaults and includes in place. Each plugin is translated
//! by the function that the table of its family names: `bsdfs/`, `shapes/`, `emitters/`, `textures.rs`. What no function has read is
//! reported.
//!
//! W. Jakob et al., "Mitsuba 3 renderer", 2022, and its manual.
mod bitmaps;
mod bsdfs;
mod colours;
mod context;
mod emitters;
mod fov;
mod integrator;
mod limits;
mod load;
mod markup;
mod media;
mod packed;
mod parameters;
mod picture;
mod sensor;
mod shapes;
#[cfg(test)]
mod tests;
mod textures;
mod transforms;
mod tree;
mod unread;
mod upgrade;
mod values;

use std::path::Path;

use glam::DAffine3;

pub use self::bsdfs::coat;
use self::{context::Import, tree::Element};
use super::{Folder, ImportOptions, Imported, lighting};
use noisefall_scene::scene::SceneError;

/// Reads the file.
pub fn read(path: &Path, options: &ImportOptions, folder: &Folder) -> Result<Imported, SceneError> {
    let (tree, files) = load::load(path, options, folder)?;
    let mut import = Import::new(files);
    let root = tree.root().see();
    let title = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    import.description.title = title;
    scene(&mut import, root)?;
    import.remark_open_media();
    unread::report(&mut import, root);
    let Import { description, new_files, remarks, .. } = import;
    let mut to = Imported { description, assets: new_files.assets, remarks };
    lighting::drop_black(&mut to, folder);
    Ok(to)
}

fn scene(import: &mut Import, root: Element) -> Result<(), SceneError> {
    for (_, integrator) in root.objects(&["integrator"])?.into_iter().take(1) {
        import.integrator(integrator)?;
    }
    let sensors = root.objects(&["sensor"])?;
    match sensors.first() {
        Some((_, sensor)) => import.sensor(*sensor)?,
        None => import.remark(root, "a default camera", "the scene has no sensor"),
    }
    for (_, sensor) in sensors.iter().skip(1) {
        import.remark(*sensor, "the first sensor", "further views are missing");
        unread::skip(*sensor);
    }
    for (_, shape) in root.objects(&["shape"])? {
        import.part(|import| import.shape(shape, &DAffine3::IDENTITY))?;
    }
    let unused = |child: &Element| child.tag() == "emitter" && emitters::is_of_shapes(*child) && !child.is_seen();
    for emitter in root.children().filter(unused) {
        import.remark(emitter, "nothing", "no shape refers to it");
        unread::skip(emitter);
    }
    for (_, emitter) in root.objects(&["emitter"])?.into_iter().filter(|(_, emitter)| !emitters::is_of_shapes(*emitter)) {
        import.part(|import| import.emitter(emitter))?;
    }
    Ok(())
}
