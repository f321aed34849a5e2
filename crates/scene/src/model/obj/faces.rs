//! Faces: corners, triangles, and the materials between them.
use rayon::prelude::*;

use super::{
    super::{ModelFormatError, polygon::Polygon},
    corner::{Corner, corner, plain_corner},
    groups,
    lists::{Counts, Lists},
    text::{ChunkError, Chunks, Words, rest, words},
};
use noisefall_base::memory::{Reservation, TooMuch};

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
    /// Lines `s`: the number of triangles before each one, and the number of the group, 0 for none.
    pub groups: Vec<(u32, u32)>,
    /// Corners whose texture coordinates, and whose normals, do not exist.
    pub missing: [usize; 2],
    /// The text after `mtllib`.
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
                Some("s") => {
                    let set = faces.set_group(groups::number(words.next()), &mut room);
                    set.map_err(|error| ChunkError::Line(number, error.to_string()))?;
                }
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
        self.groups.extend(part.groups.iter().map(|(of, group)| (triangle + of, *group)));
        self.libraries.extend(part.libraries);
        self.missing = [0, 1].map(|which| self.missing[which] + part.missing[which]);
    }

    fn set_group(&mut self, group: u32, room: &mut Reservation) -> Result<(), TooMuch> {
        let triangle = self.triangles.len() as u32;
        // Groups without faces, and lines that change nothing, take no memory.
        self.groups.pop_if(|(last, _)| *last == triangle);
        if self.groups.last().is_some_and(|(_, last)| *last == group) {
            return Ok(());
        }
        room.push(&mut self.groups, (triangle, group), "smoothing groups")
    }

    fn switch(&mut self, material: &'a str) {
        let (corner, triangle, polygon) = (self.corners.len() as u32, self.triangles.len() as u32, self.polygons.len() as u32);
        // A material without faces takes no memory.
        self.switches.pop_if(|last| last.triangle == triangle);
        self.switches.push(Switch { material, corner, triangle, polygon });
    }

    fn add(&mut self, lists: &Lists, before: &Counts, words: Words, room: &mut Reservation) -> Result<(), String> {
        let first = self.corners.len() as u32;
        if !self.add_plain(lists, before, words.rest, room).map_err(|error| error.to_string())? {
            self.corners.truncate(first as usize);
            for word in words {
                let corner = corner(lists, before, word, &mut self.missing)?;
                room.push(&mut self.corners, corner, "corners").map_err(|error| error.to_string())?;
            }
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

    /// Adds the corners of a line that holds nothing unusual. Else returns false, perhaps after some of them.
    fn add_plain(&mut self, lists: &Lists, before: &Counts, line: &str, room: &mut Reservation) -> Result<bool, TooMuch> {
        let mut rest = line.as_bytes().trim_ascii();
        while !rest.is_empty() {
            let Some((corner, after)) = plain_corner(lists, before, rest) else { return Ok(false) };
            room.push(&mut self.corners, corner, "corners")?;
            rest = after.trim_ascii_start();
        }
        Ok(true)
    }
}
