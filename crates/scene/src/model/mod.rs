//! Readers of mesh files.
//!
//! | format | file | recognised by |
//! |---|---|---|
//! | PLY | `ply/` | its first line, `ply`, whatever the name of the file |
//! | Wavefront OBJ | `obj/` | its name; the format has no signature |
//! | STL | `stl.rs` | its name; both kinds, told apart by the size of the file |
//!
//! Files are not trusted: a count in a file allocates memory only if the file has the bytes for it.
mod checked;
mod normals;
pub mod number;
mod obj;
mod ply;
mod polygon;
mod smoothing;
mod stl;
#[cfg(test)]
mod tests;
mod weld;

use std::{
    fmt,
    fs::File,
    io::{ErrorKind, Read, Seek},
    path::{Path, PathBuf},
};

pub use normals::{smooth_normals, smooth_normals_watched, turn_normals, turn_triangles};
pub use ply::encode as encode_ply;
pub use smoothing::Smoothing;

use noisefall_base::{
    file::open_regular,
    memory::{Reservation, Size, TooMuch, reserve},
    progress::{Cancelled, Progress, Stage},
    quote,
};

/// Maximum file size, 2 GiB. It also keeps counts of vertices and triangles within 32 bits.
pub const LARGEST_FILE: u64 = 1 << 31;

/// A triangle mesh as read from its file. Degenerate triangles are kept.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    /// Positions, metres.
    pub vertices: Vec<[f32; 3]>,
    /// Vertices of each triangle, counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// Unit vectors, one per vertex.
    pub normals: Option<Vec<[f32; 3]>>,
    /// One per vertex, with v as in the file: upwards by the convention of both formats.
    pub uvs: Option<Vec<[f32; 2]>>,
    /// One per vertex: linear Rec. 709 and opacity.
    pub colours: Option<Vec<[f32; 4]>>,
    /// One per vertex: a direction in the surface and a handedness, as meshes of the renderer have it.
    pub tangents: Option<Vec<[f32; 4]>>,
    /// How the surface is smoothed where the file has no normals.
    pub smoothing: Smoothing,
}

/// Error of reading a mesh file.
#[derive(Debug, thiserror::Error)]
#[error("{}: {problem}", quote::path(path))]
pub struct ModelError {
    /// The file.
    pub path: PathBuf,
    /// The problem with it.
    pub problem: ModelFormatError,
}

/// A problem with a mesh file.
#[derive(Debug, PartialEq, thiserror::Error)]
pub enum ModelFormatError {
    /// The file does not exist.
    #[error("cannot be read: there is no such file")]
    Missing,
    /// The file cannot be opened or read.
    #[error("cannot be read: {0}")]
    Unreadable(String),
    /// The file exceeds the limit.
    #[error("the file is larger than the limit of {LARGEST_FILE} bytes")]
    TooLarge,
    /// The format is not known.
    #[error("not a mesh: its first line is not `ply` and its name does not end in `.obj` or `.stl`")]
    NotAModel,
    /// An OBJ file has too many materials to be read by material.
    #[error("the faces have too many different materials")]
    TooManyMaterials,
    /// There are no triangles.
    #[error("the mesh is empty: it has no faces")]
    Empty,
    /// There are points, but no triangles.
    #[error("it is a point cloud: it has {0} points and no faces; make a surface of them with another program, such as MeshLab")]
    Points(usize),
    /// The size exceeds the memory that is left.
    #[error(transparent)]
    TooMuch(#[from] TooMuch),
    /// The reader was asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The file violates its format at this place.
    #[error("{0}: {1}")]
    Broken(FilePosition, String),
}

impl From<std::io::Error> for ModelFormatError {
    fn from(error: std::io::Error) -> ModelFormatError {
        if error.kind() == ErrorKind::NotFound {
            ModelFormatError::Missing
        } else {
            ModelFormatError::Unreadable(error.to_string())
        }
    }
}

/// Position in a file.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum FilePosition {
    /// Line of a text file, counted from 1.
    #[error("line {0}")]
    Line(usize),
    /// Offset in a binary file, counted from 0.
    #[error("byte {0}")]
    Byte(usize),
}

impl FilePosition {
    fn broken(self, reason: impl fmt::Display) -> ModelFormatError {
        ModelFormatError::Broken(self, reason.to_string())
    }
}

/// The meshes of an OBJ file by material.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObjParts {
    /// The text after `mtllib`, line by line: one file name or several, with spaces within and between them.
    pub libraries: Vec<String>,
    /// One mesh per material that has faces, in the order in which they come first.
    pub list: Vec<Part>,
    /// Whether faces without normals are flat where the file says nothing about smoothing.
    pub is_flat: bool,
    /// Corners whose texture coordinates, and whose normals, do not exist in the file.
    pub missing: [usize; 2],
}

/// A file without materials.
impl From<Model> for ObjParts {
    fn from(model: Model) -> ObjParts {
        ObjParts { list: vec![Part { material: None, model }], ..ObjParts::default() }
    }
}

/// The faces of a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The text after `usemtl`; `None` for faces before the first such line.
    pub material: Option<String>,
    /// The mesh.
    pub model: Model,
}

/// Formats without a signature.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Named {
    Obj,
    Stl,
}

impl Named {
    fn of(path: &Path) -> Option<Named> {
        let ends_in = |end: &str| path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(end));
        if ends_in("obj") { Some(Named::Obj) } else { ends_in("stl").then_some(Named::Stl) }
    }
}

/// Reads a mesh file of any supported format.
pub fn read(path: &Path) -> Result<Model, ModelError> {
    read_watched(path, &Progress::default())
}

/// Reads a mesh file, with progress and cancellation.
pub fn read_watched(path: &Path, progress: &Progress) -> Result<Model, ModelError> {
    read_file(path, progress, decode).map_err(|problem| ModelError { path: path.to_owned(), problem })
}

/// Decodes the bytes of a PLY file.
pub fn decode_ply(bytes: &[u8], progress: &Progress) -> Result<Model, ModelFormatError> {
    if ply::is_ply(bytes) { completed(ply::decode(bytes, progress)?) } else { Err(ModelFormatError::NotAModel) }
}

/// Reads a mesh file as one mesh per material. Only OBJ files have several.
pub fn read_parts(path: &Path, progress: &Progress) -> Result<ObjParts, ModelError> {
    read_file(path, progress, decode_parts).map_err(|problem| ModelError { path: path.to_owned(), problem })
}

/// The images that the header of a PLY file names for its texture coordinates.
pub fn images_of(path: &Path) -> Vec<String> {
    const LONGEST_HEADER: u64 = 1 << 16;
    let mut start = Vec::new();
    let read = open_regular(path).and_then(|file| file.take(LONGEST_HEADER).read_to_end(&mut start));
    if read.is_ok() { ply::images(&start) } else { Vec::new() }
}

/// Reads a file: while its bytes come, if its format allows that, or else as a whole by `decode`.
fn read_file<T: From<Model>>(
    path: &Path,
    progress: &Progress,
    decode: impl Fn(&[u8], Option<Named>, &Progress) -> Result<T, ModelFormatError>,
) -> Result<T, ModelFormatError> {
    let mut file = open_regular(path)?;
    let length = file.metadata()?.len();
    if length > LARGEST_FILE {
        return Err(ModelFormatError::TooLarge);
    }
    progress.expect(Stage::Files, length);
    if let Some(model) = ply::read_rows(&mut file, length, progress)? {
        return completed(model).map(T::from);
    }
    file.rewind()?;
    let (bytes, _room) = bytes(file, length, progress)?;
    decode(&bytes, Named::of(path), progress)
}

/// Reads the bytes of a file, and reserves memory for them.
fn bytes(mut file: File, length: u64, progress: &Progress) -> Result<(Vec<u8>, Reservation), ModelFormatError> {
    /// Bytes between two reports of progress.
    const BLOCK: u64 = 1 << 24;
    let room = reserve(format_args!("{} of the file", Size(length)), length)?;
    let mut bytes = Vec::with_capacity(length as usize);
    // The file may grow meanwhile, or shrink.
    for start in (0..length).step_by(BLOCK as usize) {
        let block = BLOCK.min(length - start);
        (&mut file).take(block).read_to_end(&mut bytes)?;
        progress.advance(block)?;
    }
    Ok((bytes, room))
}

fn decode(bytes: &[u8], named: Option<Named>, progress: &Progress) -> Result<Model, ModelFormatError> {
    completed(match named {
        _ if ply::is_ply(bytes) => ply::decode(bytes, progress)?,
        Some(Named::Obj) => obj::decode(bytes, progress)?,
        Some(Named::Stl) => stl::decode(bytes)?,
        None => return Err(ModelFormatError::NotAModel),
    })
}

fn decode_parts(bytes: &[u8], named: Option<Named>, progress: &Progress) -> Result<ObjParts, ModelFormatError> {
    if named != Some(Named::Obj) || ply::is_ply(bytes) {
        return decode(bytes, named, progress).map(ObjParts::from);
    }
    let mut parts = obj::decode_parts(bytes, progress)?;
    let complete = |part: Part| completed(part.model).map(|model| Part { material: part.material, model });
    parts.list = parts.list.into_iter().map(complete).collect::<Result<_, _>>()?;
    Ok(parts)
}

fn completed(mut model: Model) -> Result<Model, ModelFormatError> {
    if model.triangles.is_empty() {
        return Err(without_faces(model.vertices.len()));
    }
    if let Some(normals) = &mut model.normals {
        normals::complete(normals, &model.vertices, &model.triangles);
    }
    Ok(model)
}

/// The error of a mesh without triangles that has this many points.
fn without_faces(points: usize) -> ModelFormatError {
    if points == 0 { ModelFormatError::Empty } else { ModelFormatError::Points(points) }
}
