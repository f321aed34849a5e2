//! Reading of mesh files.
//!
//! | kind | file | told by |
//! |---|---|---|
//! | PLY | `ply/` | its first line, `ply`, whatever the file is called |
//! | Wavefront OBJ | `obj.rs` | its name; the format has no first bytes of its own |
//!
//! Files are not trusted: a number that a file claims makes no room unless the bytes for it are there.
mod normals;
mod number;
mod obj;
mod ply;
#[cfg(test)]
mod tests;

use std::{
    fmt,
    io::{ErrorKind, Read},
    path::{Path, PathBuf},
};

pub use normals::smooth_normals;

use crate::{
    file::open_regular,
    memory::{Reservation, Size, TooMuch, reserve},
    quote,
};

/// Longer files are refused: 2 GiB. It also keeps every count of vertices and triangles within 32 bits.
pub const LARGEST_FILE: u64 = 1 << 31;

/// A triangle mesh as its file has it. Triangles without area are kept.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    pub vertices: Vec<[f32; 3]>,
    /// Three vertices each, counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// Of length 1, one a vertex.
    pub normals: Option<Vec<[f32; 3]>>,
    /// One a vertex, with v as the file has it: upwards, by the custom of both formats.
    pub uvs: Option<Vec<[f32; 2]>>,
}

/// Why a file gave no model.
#[derive(Debug, thiserror::Error)]
#[error("{}: {flaw}", quote::path(path))]
pub struct ModelError {
    pub path: PathBuf,
    pub flaw: Flaw,
}

/// What is wrong with a file.
#[derive(Debug, PartialEq, thiserror::Error)]
pub enum Flaw {
    #[error("cannot be read: there is no such file")]
    Missing,
    #[error("cannot be read: {0}")]
    Unreadable(String),
    #[error("the file is larger than {LARGEST_FILE} bytes, the most that is read")]
    TooLarge,
    #[error("not a mesh: its first line is not `ply` and its name does not end in `.obj`")]
    NotAModel,
    #[error("the mesh is empty: it has no faces")]
    Empty,
    #[error(transparent)]
    TooMuch(#[from] TooMuch),
    #[error("{0}: {1}")]
    Broken(Place, String),
}

impl From<std::io::Error> for Flaw {
    fn from(error: std::io::Error) -> Flaw {
        if error.kind() == ErrorKind::NotFound { Flaw::Missing } else { Flaw::Unreadable(error.to_string()) }
    }
}

/// Where in a file.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Place {
    /// Of a text, counted from 1.
    #[error("line {0}")]
    Line(usize),
    /// Of a binary file, counted from 0.
    #[error("byte {0}")]
    Byte(usize),
}

impl Place {
    fn broken(self, reason: impl fmt::Display) -> Flaw {
        Flaw::Broken(self, reason.to_string())
    }
}

/// Reads a mesh file of any known kind.
pub fn read(path: &Path) -> Result<Model, ModelError> {
    let is_obj = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("obj"));
    let model = bytes(path).and_then(|(bytes, _room)| decode(&bytes, is_obj));
    model.map_err(|flaw| ModelError { path: path.to_owned(), flaw })
}

/// A file, and the room that it takes.
fn bytes(path: &Path) -> Result<(Vec<u8>, Reservation), Flaw> {
    let file = open_regular(path)?;
    let length = file.metadata()?.len();
    if length > LARGEST_FILE {
        return Err(Flaw::TooLarge);
    }
    let room = reserve(format_args!("{} of the file", Size(length)), length)?;
    let mut bytes = Vec::with_capacity(length as usize);
    // The file may grow meanwhile.
    file.take(length).read_to_end(&mut bytes)?;
    Ok((bytes, room))
}

fn decode(bytes: &[u8], is_obj: bool) -> Result<Model, Flaw> {
    let mut model = match ply::is_ply(bytes) {
        true => ply::decode(bytes)?,
        false if is_obj => obj::decode(bytes)?,
        false => return Err(Flaw::NotAModel),
    };
    if model.triangles.is_empty() {
        return Err(Flaw::Empty);
    }
    if let Some(normals) = &mut model.normals {
        normals::complete(normals, &model.vertices, &model.triangles);
    }
    Ok(model)
}
