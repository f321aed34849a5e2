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

use self::{library::Library, map::Map, material::Appearance, textures::Textures};
use super::{
    Folder, ImportOptions, Imported, Names, Remarks,
    lighting::{self, Sizes},
    studio,
};
use noisefall_base::{
    declare::{Textured, key_of_file},
    file::cut,
    memory::{Size, reserve},
    progress::Progress,
    quote,
};
use noisefall_scene::{
    material::Lambertian,
    model::{Model, ModelFormatError, Part, Smoothing, images_of, read_parts},
    scene::{
        SceneError,
        description::{MaterialDescription, ObjectDescription},
    },
    shape::mesh::{Mesh, MeshSource},
    texture::{image::Channel, vertex_color::VertexColor},
};

/// Reads the file.
pub fn read(path: &Path, options: &ImportOptions, folder: &Folder) -> Result<Imported, SceneError> {
    let key = key_of_file(&path.with_file_name(path.file_name().unwrap_or_default()));
    let parts = read_parts(path, &options.progress)
        .map_err(|error| SceneError::of_file(path, error.problem.to_string(), help(&error.problem)))?;
    let file = path.file_name().map_or_else(|| "mesh".to_owned(), |name| quote::piece(&name.to_string_lossy()));
    let mut to = Imported::default();
    to.description.title = path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    remark_missing(parts.missing, &file, &mut to.remarks);
    let library = Library::read(&parts.libraries, folder, &file, &mut to.remarks);
    let bounds = parts.list.iter().map(|part| bounds(&part.model)).reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]);
    let bounds = bounds.unwrap_or([DVec3::ZERO; 2]);
    let mut objects = Objects {
        path,
        key,
        file: &file,
        size: bounds[0].distance(bounds[1]),
        is_alone: parts.list.len() == 1,
        is_flat: parts.is_flat,
        images: images_of(path),
        progress: options.progress.clone(),
        materials: library,
        textures: Textures::new(folder.clone()),
        names: Names::default(),
        meshes: Names::default(),
        areas: Vec::new(),
    };
    for part in parts.list {
        objects.add(part, &mut to).map_err(|error| SceneError::of_file(path, error.to_string(), "raise the memory limit"))?;
    }
    studio::frame(&mut to.description, bounds);
    to.remarks.add(&*file, "no camera", "a camera that shows everything", "the view differs from the original");
    let sizes = Sizes { areas: objects.areas, bounds };
    lighting::complete(&mut to, folder, &sizes, &file);
    Ok(to)
}

/// Returns advice about a file that is not read.
fn help(problem: &ModelFormatError) -> &'static str {
    match problem {
        ModelFormatError::Points(_) => "only surfaces are rendered",
        ModelFormatError::TooMuch(_) => "raise the memory limit",
        _ => "a mesh is an OBJ, PLY or STL file",
    }
}

/// Remarks on texture coordinates and normals that corners name, and the file does not have.
fn remark_missing([uvs, normals]: [usize; 2], file: &str, remarks: &mut Remarks) {
    if uvs > 0 {
        let found = format!("{uvs} corners with texture coordinates that do not exist");
        remarks.add(file, found, "(0, 0)", "textures have one colour there");
    }
    if normals > 0 {
        let found = format!("{normals} corners with normals that do not exist");
        remarks.add(file, found, "normals of the surface", "the shading differs there");
    }
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
    /// Whether faces are flat where the file says nothing.
    is_flat: bool,
    /// Images of the texture coordinates of a PLY file.
    images: Vec<String>,
    /// Stops work on meshes.
    progress: Progress,
    materials: Library,
    textures: Textures,
    names: Names,
    meshes: Names,
    /// Of each object that emits, m².
    areas: Vec<f64>,
}

impl Objects<'_> {
    fn add(&mut self, part: Part, to: &mut Imported) -> Result<(), ModelFormatError> {
        let wanted = part.material.as_deref().unwrap_or_default();
        let name = self.names.unique(wanted, "material");
        let Appearance { material, emission } = match self.materials.find(wanted) {
            Some((place, material)) => material::appearance(material, place, self.size, &mut self.textures, to),
            None => Appearance { material: self.plain(&part, to), emission: None },
        };
        to.description.materials.insert(name.clone(), material);
        self.areas.push(if emission.is_some() { lighting::area(&part.model) } else { 0.0 });
        let is_flat = match part.model.smoothing {
            Smoothing::Unstated => self.is_flat && part.model.normals.is_none(),
            Smoothing::Flat => part.model.normals.is_none(),
            Smoothing::Smooth | Smoothing::Groups(_) => false,
        };
        let file = match self.path.file_name().and_then(|name| name.to_str()).filter(|_| self.is_alone) {
            Some(file) => {
                let bytes = part.model.bytes();
                let memory = reserve(format_args!("{} of a mesh", Size(bytes)), bytes)?;
                to.assets.hand_over(std::mem::take(&mut self.key), part.model, memory);
                file.to_owned()
            }
            None => {
                let path = format!("meshes/{}.ply", self.meshes.unique(&file_name(wanted), "mesh"));
                let triangles = part.model.triangles.len();
                let _room = reserve(format_args!("smoothing groups of {triangles} triangles"), part.model.grouping())?;
                to.assets.insert(path.clone(), part.model.grouped(&self.progress)?);
                path
            }
        };
        let shape = Mesh { source: MeshSource::File(file), smooth: is_flat.then_some(false) }.into();
        to.description.objects.push(ObjectDescription {
            name: if wanted.is_empty() { to.description.title.clone() } else { name.clone() },
            shape,
            material: Some(name),
            emission,
            ..ObjectDescription::default()
        });
        Ok(())
    }

    /// The image that a PLY file names, if the mesh has texture coordinates.
    fn image(&mut self, part: &Part, to: &mut Imported) -> Option<Textured> {
        let map = Map::read(self.images.first()?).filter(|_| part.model.uvs.is_some())?;
        if self.images.len() > 1 {
            let found = format!("{} images", self.images.len());
            to.remarks.add(self.file, found, "the first one", "faces of the other ones show parts of the first");
        }
        let albedo = self.textures.colour(to, self.file, [1.0; 3], Some(&map));
        matches!(albedo, Textured::Texture(_)).then_some(albedo)
    }

    /// The material of faces without one: grey, an image, or the colours of the vertices.
    fn plain(&mut self, part: &Part, to: &mut Imported) -> MaterialDescription {
        let grey = Textured::grey(0.5);
        if let Some(albedo) = self.image(part, to) {
            return MaterialDescription { kind: Lambertian { albedo }.into(), ..MaterialDescription::default() };
        }
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
    cut(name, 120).chars().map(|c| if c.is_alphanumeric() || "-_".contains(c) { c } else { '_' }).collect()
}
