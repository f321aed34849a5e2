//! Wavefront OBJ: reads all polygons, and ignores groups, objects and materials.
//!
//! Wavefront Technologies, "Appendix B1. Object Files (.obj)", Advanced Visualizer manual, 1995. A corner of a face refers to a
//! position, a texture coordinate and a normal separately; each distinct combination becomes a vertex. Colours after a position,
//! which the standard does not have, are sRGB, as Blender writes them.
use std::borrow::Cow;

use super::{Model, ModelFormatError, Place, number};
use crate::{
    math::colour::linear_from_srgb,
    memory::{Reservation, reserve},
    quote,
};

/// Marks a missing texture coordinate or normal of a corner.
const NONE: u32 = u32::MAX;

pub(super) fn decode(bytes: &[u8]) -> Result<Model, ModelFormatError> {
    let mut room = Reservation::none();
    let text = &text(bytes)?;
    if let Cow::Owned(copy) = text {
        room.grow("copies of what is not UTF-8", copy.len() as u64)?;
    }
    let lists = Lists::read(text, &mut room)?;
    let mut faces = Faces::new(&lists, room);
    let mut before = Counts::default();
    for (number, line) in Lines::new(text) {
        let mut words = words(line);
        match words.next() {
            Some("v") => before.places += 1,
            Some("vt") => before.uvs += 1,
            Some("vn") => before.normals += 1,
            Some("f") => faces.add(&before, words).map_err(|reason| Place::Line(number).broken(reason))?,
            _ => {}
        }
    }
    faces.into_model()
}

/// Decodes the file. Comments and names may be in any superset of ASCII; bytes that are not UTF-8 are replaced.
fn text(bytes: &[u8]) -> Result<Cow<'_, str>, ModelFormatError> {
    if let Some(at) = bytes.iter().position(|byte| *byte == 0) {
        let lines = bytes[..at].iter().filter(|byte| **byte == b'\n').count();
        return Err(Place::Line(lines + 1).broken("this is not text in an encoding that extends ASCII"));
    }
    Ok(String::from_utf8_lossy(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)))
}

/// The lines with their numbers. A backslash at its end continues a line.
struct Lines<'a> {
    rest: &'a str,
    number: usize,
    /// End of a line. Some old files have only carriage returns.
    end: char,
}

impl<'a> Lines<'a> {
    fn new(text: &'a str) -> Lines<'a> {
        Lines { rest: text, number: 1, end: if text.contains('\n') { '\n' } else { '\r' } }
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, &'a str);

    fn next(&mut self) -> Option<(usize, &'a str)> {
        let (text, first) = (self.rest, self.number);
        let mut end = 0;
        while end < text.len() {
            end = text[end..].find(self.end).map_or(text.len(), |length| end + length + 1);
            self.number += 1;
            // Comments end in backslashes by chance, after the name of a directory.
            if text.starts_with('#') || !text[..end].trim_end_matches(['\r', '\n']).ends_with('\\') {
                break;
            }
        }
        self.rest = &text[end..];
        (end > 0).then(|| (first, &text[..end]))
    }
}

/// Splits a line into words, up to its comment.
fn words(line: &str) -> impl Iterator<Item = &str> + Clone {
    let line = line.split('#').next().unwrap_or_default();
    line.split_ascii_whitespace().map(|word| word.trim_end_matches('\\')).filter(|word| !word.is_empty())
}

/// Positions, texture coordinates and normals that the corners of faces refer to.
#[derive(Default)]
struct Lists {
    places: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    normals: Vec<[f32; 3]>,
    /// Colours of positions, up to the last one that has any.
    colours: Vec<[f32; 4]>,
}

/// The colour of positions without one.
const WHITE: [f32; 4] = [1.0; 4];

impl Lists {
    fn read(text: &str, room: &mut Reservation) -> Result<Lists, ModelFormatError> {
        let mut lists = Lists::default();
        for (number, line) in Lines::new(text) {
            lists.add(words(line), room).map_err(|reason| Place::Line(number).broken(reason))?;
        }
        Ok(lists)
    }

    fn add<'a>(&mut self, mut words: impl Iterator<Item = &'a str> + Clone, room: &mut Reservation) -> Result<(), String> {
        match words.next() {
            Some("v") => {
                if let Some(colour) = colour(words.clone()) {
                    while self.colours.len() < self.places.len() {
                        room.push(&mut self.colours, WHITE, "colours").map_err(|error| error.to_string())?;
                    }
                    room.push(&mut self.colours, colour, "colours").map_err(|error| error.to_string())?;
                }
                room.push(&mut self.places, place(words)?, "vertices")
            }
            Some("vt") => room.push(&mut self.uvs, numbers(words, 1).map(finite)?, "texture coordinates"),
            Some("vn") => room.push(&mut self.normals, numbers(words, 3).map(finite)?, "normals"),
            _ => Ok(()),
        }
        .map_err(|error| error.to_string())
    }
}

/// Replaces NaN and infinity, which exporters write for normals and texture coordinates that they could not compute, such as
/// those of a degenerate triangle.
fn finite<const N: usize>(numbers: [f32; N]) -> [f32; N] {
    if numbers.iter().all(|number| number.is_finite()) { numbers } else { [0.0; N] }
}

fn place<'a>(words: impl Iterator<Item = &'a str> + Clone) -> Result<[f32; 3], String> {
    let place: [f32; 3] = numbers(words.clone(), 3)?;
    match place.iter().zip(words).find(|(number, _)| !number.is_finite()) {
        Some((_, word)) => Err(format!("{} is not a finite number", quote::bytes(word.as_bytes()))),
        None => Ok(place),
    }
}

/// The colour after a position, if there is one: three numbers more. A fourth number alone is a weight.
fn colour<'a>(words: impl Iterator<Item = &'a str>) -> Option<[f32; 4]> {
    let [red, green, blue] = finite(numbers(words.skip(3), 3).ok()?).map(|x| linear_from_srgb(x.into()) as f32);
    Some([red, green, blue, 1.0])
}

/// Reads N numbers. Those after the first `needed` are optional and 0 by default; further ones, such as weights, are ignored.
fn numbers<'a, const N: usize>(words: impl Iterator<Item = &'a str>, needed: usize) -> Result<[f32; N], String> {
    let mut numbers = [0.0; N];
    let mut found = 0;
    for (number, word) in numbers.iter_mut().zip(words) {
        *number = number::real(word).ok_or_else(|| format!("{} is not a number", quote::bytes(word.as_bytes())))?;
        found += 1;
    }
    if found < needed { Err(format!("there are {found} numbers, not {needed}")) } else { Ok(numbers) }
}

/// Numbers of elements before a line.
#[derive(Default)]
struct Counts {
    places: usize,
    uvs: usize,
    normals: usize,
}

/// A corner of a face: indices into the lists.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Corner {
    place: u32,
    uv: u32,
    normal: u32,
}

struct Faces<'a> {
    lists: &'a Lists,
    /// Corners of all faces, consecutively.
    corners: Vec<Corner>,
    /// Indices into `corners`.
    triangles: Vec<[u32; 3]>,
    room: Reservation,
}

impl<'a> Faces<'a> {
    fn new(lists: &'a Lists, room: Reservation) -> Faces<'a> {
        Faces { lists, corners: Vec::new(), triangles: Vec::new(), room }
    }

    fn add<'w>(&mut self, before: &Counts, words: impl Iterator<Item = &'w str>) -> Result<(), String> {
        let first = self.corners.len() as u32;
        for word in words {
            let corner = self.corner(before, word)?;
            self.room.push(&mut self.corners, corner, "corners").map_err(|error| error.to_string())?;
        }
        let end = self.corners.len() as u32;
        if end - first < 3 {
            return Err(format!("a face has {} corners, not 3 or more", end - first));
        }
        let mut triangles = (first + 2..end).map(|corner| [first, corner - 1, corner]);
        triangles
            .try_for_each(|triangle| self.room.push(&mut self.triangles, triangle, "triangles"))
            .map_err(|error| error.to_string())
    }

    /// Reads `place`, `place/uv`, `place//normal` or `place/uv/normal`.
    fn corner(&self, before: &Counts, word: &str) -> Result<Corner, String> {
        let mut parts = word.split('/');
        let mut index = |what, count, before| match parts.next() {
            None | Some("") => Ok(NONE),
            Some(part) => position(part, what, count, before),
        };
        let place = index("vertex", self.lists.places.len(), before.places)?;
        let uv = index("texture coordinate", self.lists.uvs.len(), before.uvs)?;
        let normal = index("normal", self.lists.normals.len(), before.normals)?;
        if place == NONE || parts.next().is_some() {
            return Err(format!("{} is not a corner: `vertex/texture coordinate/normal`", quote::bytes(word.as_bytes())));
        }
        Ok(Corner { place, uv, normal })
    }

    fn into_model(self) -> Result<Model, ModelFormatError> {
        /// Bytes per corner in the lists of distinct corners and their attributes.
        const CORNER: u64 = 48;
        const COLOUR: u64 = size_of::<[f32; 4]>() as u64;
        let Faces { lists, corners, mut triangles, room: _room } = self;
        let bytes = CORNER + if lists.colours.is_empty() { 0 } else { COLOUR };
        let _more = reserve(format_args!("{} corners", corners.len()), bytes * corners.len() as u64)?;
        let (distinct, vertices) = distinct(&corners, lists.places.len());
        triangles.as_flattened_mut().iter_mut().for_each(|corner| *corner = vertices[*corner as usize]);
        let uvs = attribute(&distinct, &lists.uvs, |corner| corner.uv);
        let normals = attribute(&distinct, &lists.normals, |corner| corner.normal);
        let vertices = distinct.iter().map(|corner| lists.places[corner.place as usize]).collect();
        let colour = |corner: &Corner| lists.colours.get(corner.place as usize).copied().unwrap_or(WHITE);
        let colours = (!lists.colours.is_empty()).then(|| distinct.iter().map(colour).collect());
        Ok(Model { vertices, triangles, normals, uvs, colours })
    }
}

/// Returns the distinct corners in the order of their positions, and for each corner its index among them.
///
/// It sorts, because no file can make sorting as slow as it could make a hash table.
fn distinct(corners: &[Corner], places: usize) -> (Vec<Corner>, Vec<u32>) {
    let mut distinct = corners.to_vec();
    distinct.sort_unstable();
    distinct.dedup();
    let mut starts = vec![0u32; places + 1];
    for corner in &distinct {
        starts[corner.place as usize + 1] += 1;
    }
    for place in 0..places {
        starts[place + 1] += starts[place];
    }
    let position = |corner: &Corner| {
        let [start, end] = [0, 1].map(|next| starts[corner.place as usize + next]);
        let same_place = &distinct[start as usize..end as usize];
        start + same_place.partition_point(|other| other < corner) as u32
    };
    let positions = corners.iter().map(position).collect();
    (distinct, positions)
}

/// Looks up an attribute of each corner, 0 where it is missing; `None` if all corners lack it.
fn attribute<const N: usize>(corners: &[Corner], list: &[[f32; N]], index: impl Fn(&Corner) -> u32) -> Option<Vec<[f32; N]>> {
    let value = |corner| list.get(index(corner) as usize).copied().unwrap_or([0.0; N]);
    corners.iter().any(|corner| index(corner) != NONE).then(|| corners.iter().map(value).collect())
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
