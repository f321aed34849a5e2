//! Mesh files as scenes: OBJ with MTL, PLY, STL.
//!
//! Each material of an OBJ file is an object; a file with one material is one object that refers to the file itself. Coordinates stay
//! as they are. The camera and the light are those of [`super::studio`].
//!
//! | part | file |
//! |---|---|
//! | libraries of materials: finding and reading them | `library.rs` |
//! | the statements of an MTL file | `mtl.rs` |
//! | texture statements with their options | `map.rs` |
//! | images with transforms, factors | `textures.rs` |
//! | which of our materials stands for one of MTL | `material.rs` |
mod library;
mod map;
mod material;
mod mtl;
#[cfg(test)]
mod tests;
mod textures;

use std::path::Path;

use glam::DVec3;

use self::{library::Library, material::Appearance, textures::Textures};
use super::{Folder, ImportOptions, Imported, Names, studio};
use crate::{
    declare::{Textured, key_of_file},
    material::Lambertian,
    memory::{Size, TooMuch, reserve},
    model::{Model, Part, is_flat, read_parts},
    quote,
    scene::{
        SceneError,
        description::{MaterialDescription, ObjectDescription},
    },
    shape::mesh::{Mesh, MeshSource},
    texture::{image::Channel, vertex_color::VertexColor},
};

/// Reads the file.
pub fn read(path: &Path, options: &ImportOptions, folder: &Folder) -> Result<Imported, SceneError> {
    const HELP: &str = "a mesh is an OBJ, PLY or STL file";
    let key = key_of_file(&path.with_file_name(path.file_name().unwrap_or_default()));
    let parts =
        read_parts(path, &options.progress).map_err(|error| SceneError::of_file(path, error.problem.to_string(), HELP))?;
    let file = path.file_name().map_or_else(|| "mesh".to_owned(), |name| quote::piece(&name.to_string_lossy()));
    let mut to = Imported::default();
    to.description.title = path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let library = Library::read(&parts.libraries, folder, &file, &mut to.remarks);
    let bounds = parts.list.iter().map(|part| bounds(&part.model)).reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]);
    let bounds = bounds.unwrap_or([DVec3::ZERO; 2]);
    let mut objects = Objects {
        path,
        key,
        file: &file,
        size: bounds[0].distance(bounds[1]),
        is_alone: parts.list.len() == 1,
        library,
        textures: Textures::new(folder.clone()),
        names: Names::default(),
        meshes: Names::default(),
    };
    for part in parts.list {
        objects.add(part, &mut to).map_err(|error| SceneError::of_file(path, error.to_string(), "raise the memory limit"))?;
    }
    studio::frame(&mut to.description, bounds);
    to.remarks.add(&*file, "no camera", "a camera that shows everything", "the view differs from the original");
    if to.description.objects.iter().all(|object| object.emission.is_none()) {
        studio::light(&mut to.description, &mut to.assets, &mut to.remarks, &file);
    }
    Ok(to)
}

/// The least and the greatest coordinates of the vertices, all of which belong to triangles in OBJ files.
fn bounds(model: &Model) -> [DVec3; 2] {
    let points = model.vertices.iter().map(|vertex| DVec3::from(vertex.map(f64::from)));
    points.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[least, greatest], point| [least.min(point), greatest.max(point)])
}

/// Makes the objects and their materials.
struct Objects<'a> {
    path: &'a Path,
    /// Key of the file, for its content.
    key: String,
    file: &'a str,
    /// Diagonal of the bounding box, metres.
    size: f64,
    is_alone: bool,
    library: Library,
    textures: Textures,
    names: Names,
    meshes: Names,
}

impl Objects<'_> {
    fn add(&mut self, part: Part, to: &mut Imported) -> Result<(), TooMuch> {
        let wanted = part.material.as_deref().unwrap_or_default();
        let name = self.names.unique(wanted, "material");
        let Appearance { material, emission } = match self.library.find(wanted) {
            Some((place, material)) => material::appearance(material, place, self.size, &mut self.textures, to),
            None => Appearance { material: self.plain(&part, to), emission: None },
        };
        to.description.materials.insert(name.clone(), material);
        let is_faceted = is_flat(self.path);
        let (file, smooth) = match self.path.file_name().and_then(|name| name.to_str()).filter(|_| self.is_alone) {
            Some(file) => {
                let bytes = part.model.bytes();
                let memory = reserve(format_args!("{} of a mesh", Size(bytes)), bytes)?;
                to.assets.hand_over(std::mem::take(&mut self.key), part.model, memory);
                (file.to_owned(), None)
            }
            None => {
                let path = format!("meshes/{}.ply", self.meshes.unique(&file_name(wanted), "mesh"));
                to.assets.insert(path.clone(), part.model);
                (path, is_faceted.then_some(false))
            }
        };
        let shape = Mesh { source: MeshSource::File(file), smooth }.into();
        to.description.objects.push(ObjectDescription {
            name: if wanted.is_empty() { to.description.title.clone() } else { name.clone() },
            shape,
            material: Some(name),
            emission,
            ..ObjectDescription::default()
        });
        Ok(())
    }

    /// The material of faces without one: grey, or the colours of the vertices.
    fn plain(&mut self, part: &Part, to: &mut Imported) -> MaterialDescription {
        let grey = Textured::grey(0.5);
        if let Some(colours) = &part.model.colours {
            let name = self.textures.add(to, VertexColor::default().into(), "vertex color");
            let is_opaque = colours.iter().all(|[.., opacity]| *opacity >= 1.0);
            let opacity = (!is_opaque).then(|| {
                let channel = VertexColor { channel: Channel::Alpha };
                Textured::Texture(self.textures.add(to, channel.into(), "vertex opacity"))
            });
            let kind = Lambertian { albedo: Textured::Texture(name) }.into();
            return MaterialDescription { kind, opacity, ..MaterialDescription::default() };
        }
        let found = match &part.material {
            Some(name) => format!("material \"{}\", which no library has", quote::piece(name)),
            None => "no material".to_owned(),
        };
        to.remarks.add(self.file, found, "a grey diffuse surface", "the colour differs from the original");
        MaterialDescription { kind: Lambertian { albedo: grey }.into(), ..MaterialDescription::default() }
    }
}

/// A name that every file system allows.
fn file_name(name: &str) -> String {
    name.chars().take(60).map(|c| if c.is_alphanumeric() || "-_".contains(c) { c } else { '_' }).collect()
}
