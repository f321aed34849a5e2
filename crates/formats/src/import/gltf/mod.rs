//! glTF 2.0 files.
//!
//! The JSON is read by the types of `document.rs` and `extensions.rs`, not by the crate `gltf`: that crate knows half of the extensions,
//! and indexes buffers without checks. Here, every access is checked, no structure is followed by recursion, and the memory that a file
//! can ask for is limited by its size.
mod accessor;
mod animation;
mod attributes;
mod buffers;
mod bytes;
mod cameras;
mod container;
mod document;
mod draco;
mod extensions;
mod images;
mod instances;
mod instancing;
mod lights;
mod materials;
mod meshopt;
mod nodes;
mod reflectances;
mod refusal;
mod tangents;
#[cfg(test)]
mod tests;
mod textures;
mod triangles;
mod vertices;

use std::path::Path;

pub use self::{cameras::resolution, lights::EFFICACY, materials::STEP};

use self::{
    animation::Poses,
    buffers::Buffers,
    container::Container,
    document::{Document, Index, element},
    images::Images,
    instances::Instances,
    materials::Materials,
    nodes::Hierarchy,
    refusal::{Found, Refusal},
    textures::Textures,
};
use super::{
    Folder, ImportOptions, Imported, Names,
    lighting::{self, Sizes},
    studio,
};
use noisefall_base::quote;
use noisefall_scene::scene::SceneError;

/// Reads a file.
///
/// At time 0 the nodes stand as the file states them, and skins and morph targets are in that pose; at any other time animations move
/// them.
pub fn read(path: &Path, options: &ImportOptions, folder: &Folder) -> Result<Imported, SceneError> {
    let file = path.file_name().map_or_else(|| "glTF".to_owned(), |name| quote::piece(&name.to_string_lossy()));
    container::open(path, &options.progress)
        .and_then(|container| translated(container, folder, options, &file))
        .map_err(|refusal| refusal.of_file(path))
}

/// The scene of a container.
fn translated(container: Container, folder: &Folder, options: &ImportOptions, file: &str) -> Found<Imported> {
    let Container { document, blob, length, room: _room } = container;
    let mut to = Imported::default();
    check_extensions(&document, &mut to, file)?;
    let variant = options.variant.as_deref().map(|name| variant(&document, name)).transpose()?;
    let buffers = Buffers::read(&document, blob, length, folder, &options.progress)?;
    let poses = match options.time.filter(|time| time.is_finite()) {
        Some(time) => animation::poses(&document, &buffers, time)?,
        None => Poses::default(),
    };
    for name in &poses.left_out {
        let found = format!("animation \"{name}\"");
        to.remarks.add(file, found, "animations before it", "where both set the same property of a node, the earlier one counts");
    }
    for target in &poses.unknown {
        to.remarks.add(file, format!("an animation of `{target}`"), "nothing", "it stays as it is");
    }
    let hierarchy = Hierarchy::new(&document, &poses)?;
    let textures = Textures::new(&document, Images::new(&document, &buffers, folder));
    let materials = Materials::new(&document, textures, file);
    let mut instances = Instances::new(&document, &buffers, &hierarchy, &poses, materials, file);
    instances.variant = variant;
    instances.most += length / instances::BYTES_OF_FILE;
    instances.add(&mut to)?;
    let (bounds, areas) = (instances.bounds, instances.areas);
    punctual_lights(&document, &hierarchy, &mut to, file)?;
    if !camera(&document, &hierarchy, options.size, &mut to, file)? {
        studio::frame(&mut to.description, bounds);
        to.remarks.add(file, "no camera", "a camera that shows everything", "the view differs from the original");
    }
    lighting::complete(&mut to, folder, &Sizes { areas, bounds }, file);
    Ok(to)
}

/// Refuses a file that requires an extension that is not read, and remarks on one that uses it.
fn check_extensions(document: &Document, to: &mut Imported, file: &str) -> Found<()> {
    let is_known = |name: &str| extensions::KNOWN.contains(&name);
    if let Some(name) = document.extensions_required.iter().find(|name| !is_known(name)) {
        let help = extensions::REFUSED.iter().find(|(refused, _)| refused == name).map(|(_, help)| *help);
        let help = help.unwrap_or("export the file without this extension");
        return Err(Refusal::new(format!("it requires the extension `{name}`, which is not supported"), help));
    }
    let has_fallback = |name: &str| extensions::REFUSED.iter().any(|(refused, _)| *refused == name);
    for name in document.extensions_used.iter().filter(|name| !is_known(name) && !has_fallback(name)) {
        to.remarks.add(file, format!("the extension `{name}`"), "nothing", "what it describes is missing");
    }
    Ok(())
}

/// The place of a variant of the materials.
fn variant(document: &Document, wanted: &str) -> Found<Index> {
    let variants = document.extensions.variants.as_ref().map_or(&[][..], |found| &found.variants);
    let place = variants.iter().position(|variant| variant.name == wanted);
    place.map(|place| place as Index).ok_or_else(|| {
        let names = variants.iter().take(20).map(|variant| format!("`{}`", variant.name)).collect::<Vec<_>>();
        let help =
            if names.is_empty() { "the file has no variants".to_owned() } else { format!("there are {}", names.join(", ")) };
        Refusal::new(format!("there is no variant `{wanted}`"), help)
    })
}

fn punctual_lights(document: &Document, hierarchy: &Hierarchy, to: &mut Imported, file: &str) -> Found<()> {
    let lights = document.extensions.lights.as_ref().map_or(&[][..], |found| &found.lights);
    let mut names = Names::default();
    for index in &hierarchy.shown {
        let node = &document.nodes[*index as usize];
        let Some(used) = node.extensions.as_deref().and_then(|extensions| extensions.light.as_deref()) else { continue };
        let light = element(lights, used.light, "light")?;
        let wanted = if node.name.is_empty() { &light.name } else { &node.name };
        let name = names.unique(wanted, "light");
        let place = format!("{file}: light \"{name}\"");
        let world = &hierarchy.worlds[*index as usize];
        to.description.punctual_lights.extend(lights::punctual_light(light, &name, world, &mut to.remarks, &place));
    }
    Ok(())
}

/// Takes the first camera, and returns whether there is one.
fn camera(document: &Document, hierarchy: &Hierarchy, size: Option<[u32; 2]>, to: &mut Imported, file: &str) -> Found<bool> {
    let mut has_camera = false;
    for index in &hierarchy.shown {
        let node = &document.nodes[*index as usize];
        let Some(camera) = node.camera else { continue };
        let camera = element(&document.cameras, camera, "camera")?;
        let name = if node.name.is_empty() { &camera.name } else { &node.name };
        if has_camera {
            to.remarks.add(format!("{file}: camera \"{name}\""), "a further camera", "the first one", "its view is not shown");
        } else if let Some(description) = cameras::camera(camera, &hierarchy.worlds[*index as usize], size) {
            to.description.camera = description;
            has_camera = true;
        } else {
            to.remarks.add(format!("{file}: camera \"{name}\""), "a camera without a view", "nothing", "its view is not shown");
        }
    }
    Ok(has_camera)
}
