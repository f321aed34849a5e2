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
mod stl;
#[cfg(test)]
mod tests;
mod weld;

use std::{
    fmt,
    io::{ErrorKind, Read},
    path::{Path, PathBuf},
};

pub use normals::smooth_normals;
pub use ply::encode as encode_ply;

use crate::{
    file::open_regular,
    memory::{Reservation, Size, TooMuch, reserve},
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
}

/// Error of reading a mesh file.
#[derive(Debug, thiserror::Error)]
#[error("{}: {problem}", quote::path(path))]
pub struct ModelError {
    /// The file.
    pub path: PathBuf,
    /// What is wrong with it.
    pub problem: ModelFormatError,
}

/// What is wrong with a file.
#[derive(Debug, PartialEq, thiserror::Error)]
pub enum ModelFormatError {
    /// The file does not exist.
    #[error("cannot be read: there is no such file")]
    Missing,
    /// The file cannot be opened or read.
    #[error("cannot be read: {0}")]
    Unreadable(String),
    /// The file exceeds the limit.
    #[error("the file is larger than {LARGEST_FILE} bytes, the most that is read")]
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
    /// The size exceeds the memory that is left.
    #[error(transparent)]
    TooMuch(#[from] TooMuch),
    /// The file violates its format at this place.
    #[error("{0}: {1}")]
    Broken(Place, String),
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
pub enum Place {
    /// Line of a text file, counted from 1.
    #[error("line {0}")]
    Line(usize),
    /// Offset in a binary file, counted from 0.
    #[error("byte {0}")]
    Byte(usize),
}

impl Place {
    fn broken(self, reason: impl fmt::Display) -> ModelFormatError {
        ModelFormatError::Broken(self, reason.to_string())
    }
}

/// The meshes of an OBJ file by material.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parts {
    /// What stands after `mtllib`, line by line: one file name or several, with spaces within and between them.
    pub libraries: Vec<String>,
    /// One mesh per material that has faces, in the order in which they come first.
    pub list: Vec<Part>,
}

/// The faces of a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// What stands after `usemtl`; `None` for faces before the first such line.
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

/// Whether the mesh of a file is flat unless a scene says that it is smooth: STL files state a normal per triangle.
pub fn is_flat(path: &Path) -> bool {
    Named::of(path) == Some(Named::Stl)
}

/// Reads a mesh file of any supported format.
pub fn read(path: &Path) -> Result<Model, ModelError> {
    let model = bytes(path).and_then(|(bytes, _room)| decode(&bytes, Named::of(path)));
    model.map_err(|problem| ModelError { path: path.to_owned(), problem })
}

/// Reads a mesh file as one mesh per material. Only OBJ files have several.
pub fn read_parts(path: &Path) -> Result<Parts, ModelError> {
    let parts = bytes(path).and_then(|(bytes, _room)| decode_parts(&bytes, Named::of(path)));
    parts.map_err(|problem| ModelError { path: path.to_owned(), problem })
}

/// Reads a file, and reserves memory for it.
fn bytes(path: &Path) -> Result<(Vec<u8>, Reservation), ModelFormatError> {
    let file = open_regular(path)?;
    let length = file.metadata()?.len();
    if length > LARGEST_FILE {
        return Err(ModelFormatError::TooLarge);
    }
    let room = reserve(format_args!("{} of the file", Size(length)), length)?;
    let mut bytes = Vec::with_capacity(length as usize);
    // The file may grow meanwhile.
    file.take(length).read_to_end(&mut bytes)?;
    Ok((bytes, room))
}

fn decode(bytes: &[u8], named: Option<Named>) -> Result<Model, ModelFormatError> {
    completed(match named {
        _ if ply::is_ply(bytes) => ply::decode(bytes)?,
        Some(Named::Obj) => obj::decode(bytes)?,
        Some(Named::Stl) => stl::decode(bytes)?,
        None => return Err(ModelFormatError::NotAModel),
    })
}

fn decode_parts(bytes: &[u8], named: Option<Named>) -> Result<Parts, ModelFormatError> {
    if named != Some(Named::Obj) || ply::is_ply(bytes) {
        let model = decode(bytes, named)?;
        return Ok(Parts { libraries: Vec::new(), list: vec![Part { material: None, model }] });
    }
    let Parts { libraries, list } = obj::decode_parts(bytes)?;
    let complete = |part: Part| completed(part.model).map(|model| Part { material: part.material, model });
    let list: Vec<Part> = list.into_iter().map(complete).collect::<Result<_, _>>()?;
    if list.is_empty() { Err(ModelFormatError::Empty) } else { Ok(Parts { libraries, list }) }
}

fn completed(mut model: Model) -> Result<Model, ModelFormatError> {
    if model.triangles.is_empty() {
        return Err(ModelFormatError::Empty);
    }
    if let Some(normals) = &mut model.normals {
        normals::complete(normals, &model.vertices, &model.triangles);
    }
    Ok(model)
}
