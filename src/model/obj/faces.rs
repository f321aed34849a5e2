//! Faces: corners, triangles, and the materials between them.
use rayon::prelude::*;

use super::{
    super::{ModelFormatError, polygon::Polygon},
    lists::{Counts, Lists},
    text::{ChunkError, Chunks, rest, words},
};
use crate::{memory::Reservation, quote};

/// Marks a missing texture coordinate or normal of a corner.
pub const NONE: u32 = u32::MAX;

/// A corner of a face: indices into the lists.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Corner {
    pub place: u32,
    pub uv: u32,
    pub normal: u32,
}

/// A line `usemtl`, by the numbers of corners, triangles and polygons before it.
#[derive(Clone, Copy)]
pub struct Switch<'a> {
    pub material: &'a str,
    pub corner: u32,
    pub triangle: u32,
    pub polygon: u32,
}

/// The faces of a file or of a chunk.
#[derive(Default)]
pub struct Faces<'a> {
    /// Corners of all faces, consecutively.
    pub corners: Vec<Corner>,
    /// Indices into `corners`: fans.
    pub triangles: Vec<[u32; 3]>,
    /// Faces with more than three corners.
    pub polygons: Vec<Polygon>,
    pub switches: Vec<Switch<'a>>,
    /// What stands after `mtllib`.
    pub libraries: Vec<&'a str>,
}

impl<'a> Faces<'a> {
    pub fn read(
        chunks: &Chunks<'a>,
        lists: &Lists,
        before: &[Counts],
        room: &mut Reservation,
    ) -> Result<Faces<'a>, ModelFormatError> {
        let of_chunk = |chunk: usize| Faces::of_chunk(chunks, chunk, lists, before[chunk]);
        let mut parts = chunks.all((0..chunks.list.len()).into_par_iter().map(of_chunk).collect())?;
        if parts.len() == 1 {
            let (faces, reserved) = parts.remove(0);
            room.absorb(reserved);
            return Ok(faces);
        }
        let [mut corners, mut triangles] = [0; 2];
        for (part, _) in &parts {
            corners += part.corners.len();
            triangles += part.triangles.len();
        }
        room.grow(format_args!("{corners} corners"), 12 * (corners + triangles) as u64)?;
        let mut faces =
            Faces { corners: Vec::with_capacity(corners), triangles: Vec::with_capacity(triangles), ..Faces::default() };
        for (part, reserved) in parts {
            faces.append(part);
            drop(reserved);
        }
        Ok(faces)
    }

    fn of_chunk(
        chunks: &Chunks<'a>,
        chunk: usize,
        lists: &Lists,
        mut before: Counts,
    ) -> Result<(Faces<'a>, Reservation), ChunkError> {
        let (mut faces, mut room) = (Faces::default(), Reservation::none());
        for (number, line) in chunks.lines(chunk)? {
            let mut words = words(line);
            match words.next() {
                Some("v") => before.places += 1,
                Some("vt") => before.uvs += 1,
                Some("vn") => before.normals += 1,
                Some("f") => faces.add(lists, &before, words, &mut room).map_err(|reason| ChunkError::Line(number, reason))?,
                Some("usemtl") => faces.switch(rest(line)),
                Some("mtllib") => faces.libraries.push(rest(line)),
                _ => {}
            }
        }
        Ok((faces, room))
    }

    fn append(&mut self, part: Faces<'a>) {
        let (corner, triangle, polygon) = (self.corners.len() as u32, self.triangles.len() as u32, self.polygons.len() as u32);
        self.corners.extend(&part.corners);
        self.triangles.extend(part.triangles.iter().map(|corners| corners.map(|id| corner + id)));
        self.polygons.extend(part.polygons.iter().map(|of| Polygon { first: triangle + of.first, ..*of }));
        self.switches.extend(part.switches.iter().map(|of| Switch {
            corner: corner + of.corner,
            triangle: triangle + of.triangle,
            polygon: polygon + of.polygon,
            ..*of
        }));
        self.libraries.extend(part.libraries);
    }

    fn switch(&mut self, material: &'a str) {
        let (corner, triangle, polygon) = (self.corners.len() as u32, self.triangles.len() as u32, self.polygons.len() as u32);
        // A material without faces takes no memory.
        self.switches.pop_if(|last| last.triangle == triangle);
        self.switches.push(Switch { material, corner, triangle, polygon });
    }

    fn add<'w>(
        &mut self,
        lists: &Lists,
        before: &Counts,
        words: impl Iterator<Item = &'w str>,
        room: &mut Reservation,
    ) -> Result<(), String> {
        let first = self.corners.len() as u32;
        for word in words {
            let corner = corner(lists, before, word)?;
            room.push(&mut self.corners, corner, "corners").map_err(|error| error.to_string())?;
        }
        let end = self.corners.len() as u32;
        if end - first < 3 {
            return Err(format!("a face has {} corners, not 3 or more", end - first));
        }
        if end - first > 3 {
            let polygon = Polygon { first: self.triangles.len() as u32, count: end - first - 2 };
            room.push(&mut self.polygons, polygon, "polygons").map_err(|error| error.to_string())?;
        }
        let mut triangles = (first + 2..end).map(|corner| [first, corner - 1, corner]);
        triangles
            .try_for_each(|triangle| room.push(&mut self.triangles, triangle, "triangles"))
            .map_err(|error| error.to_string())
    }
}

/// Reads `place`, `place/uv`, `place//normal` or `place/uv/normal`.
fn corner(lists: &Lists, before: &Counts, word: &str) -> Result<Corner, String> {
    let mut rest = Some(word);
    let mut index = |what, count, before| match next_part(&mut rest) {
        None | Some("") => Ok(NONE),
        Some(part) => position(part, what, count, before),
    };
    let place = index("vertex", lists.places.len(), before.places)?;
    let uv = index("texture coordinate", lists.uvs.len(), before.uvs)?;
    let normal = index("normal", lists.normals.len(), before.normals)?;
    if place == NONE || rest.is_some() {
        return Err(format!("{} is not a corner: `vertex/texture coordinate/normal`", quote::bytes(word.as_bytes())));
    }
    Ok(Corner { place, uv, normal })
}

/// Takes the text before the next slash, or the rest.
fn next_part<'w>(rest: &mut Option<&'w str>) -> Option<&'w str> {
    let text = (*rest)?;
    let slash = text.bytes().position(|byte| byte == b'/');
    *rest = slash.map(|slash| &text[slash + 1..]);
    Some(&text[..slash.unwrap_or(text.len())])
}

/// Resolves an index into a list of `count`. The file counts from 1, or with negative numbers back from the `before` elements of
/// earlier lines.
fn position(index: &str, what: &str, count: usize, before: usize) -> Result<u32, String> {
    let number: i64 = index.parse().map_err(|_| format!("{} is not a {what}'s number", quote::bytes(index.as_bytes())))?;
    let position = if number < 0 { before as i64 + number } else { number - 1 };
    if (0..count as i64).contains(&position) {
        return Ok(position as u32);
    }
    let there = if number < 0 { format!("{before} before this line") } else { format!("{count}, counted from 1") };
    Err(format!("{what} {number} does not exist: there are {there}"))
}
