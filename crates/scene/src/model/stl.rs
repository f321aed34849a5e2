//! STL: triangles as text or binary. Equal corners become one vertex. The surface is flat: files state a normal per triangle.
//!
//! M. Burns, "Automated Fabrication", 1993, section 6.5. The normals of the facets are those of the triangles, and are not read; nor are
//! the two bytes after each binary triangle, which some programs use for colours in ways that contradict each other.
use super::{FilePosition, Model, ModelFormatError, Smoothing, number, weld};
use noisefall_base::{
    memory::{Reservation, reserve},
    quote,
};

/// Bytes before the triangles of a binary file: a comment and their count.
const HEADER: usize = 84;
/// Bytes of a binary triangle: normal, three corners, and two bytes more.
const TRIANGLE: usize = 50;
/// Offset of the first corner in a triangle.
const CORNERS: usize = 12;

pub(super) fn decode(bytes: &[u8]) -> Result<Model, ModelFormatError> {
    let (places, _room) = if is_binary(bytes) { binary(bytes)? } else { text(bytes)? };
    let _welding = reserve(format_args!("{} corners", places.len()), weld::WELDING * places.len() as u64)?;
    let (vertices, corners) = weld::positions(&places);
    let triangles = corners.as_chunks().0.to_vec();
    Ok(Model { vertices, triangles, smoothing: Smoothing::Flat, ..Model::default() })
}

/// Number of triangles that a binary file claims to have.
fn claimed(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEADER - 4..HEADER)?.first_chunk()?;
    Some(u32::from_le_bytes(*count) as usize)
}

/// Whether the file is binary. Comments of binary files begin with `solid` too, so its size decides first.
fn is_binary(bytes: &[u8]) -> bool {
    /// Text has no zeros, and the header of a binary file has many.
    const START: usize = 512;
    let fits = claimed(bytes).is_some_and(|count| bytes.len() == HEADER + TRIANGLE * count);
    let text = without_ends(bytes);
    let names_solid = text.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    fits || !names_solid || text[..text.len().min(START)].contains(&0)
}

fn binary(bytes: &[u8]) -> Result<(Vec<[f32; 3]>, Reservation), ModelFormatError> {
    let end = FilePosition::Byte(bytes.len());
    let count = claimed(bytes).ok_or_else(|| end.broken("the file ends within its header"))?;
    let triangles = &bytes[HEADER..];
    if triangles.len() / TRIANGLE < count {
        let left = triangles.len();
        return Err(FilePosition::Byte(HEADER).broken(format!("the remaining {left} bytes are too few for {count} triangles")));
    }
    let room = reserve(format_args!("{} corners", 3 * count), (3 * count * size_of::<[f32; 3]>()) as u64)?;
    let mut places = Vec::with_capacity(3 * count);
    for triangle in triangles.chunks_exact(TRIANGLE).take(count) {
        let numbers = triangle[CORNERS..].as_chunks::<4>().0;
        let corners = numbers.as_chunks::<3>().0.iter().take(3);
        places.extend(corners.map(|corner| corner.map(f32::from_le_bytes)));
    }
    if let Some(corner) = places.iter().position(|place: &[f32; 3]| !place.iter().all(|x| x.is_finite())) {
        let at = HEADER + corner / 3 * TRIANGLE + CORNERS + corner % 3 * size_of::<[f32; 3]>();
        return Err(FilePosition::Byte(at).broken(format!("triangle {}: a coordinate is not a finite number", corner / 3)));
    }
    Ok((places, room))
}

/// A text without a mark of its encoding, and without zeros at its end, which some programs write to fill a block.
fn without_ends(bytes: &[u8]) -> &[u8] {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let end = bytes.iter().rposition(|byte| *byte != 0).map_or(0, |last| last + 1);
    bytes[..end].trim_ascii()
}

/// Reads words, wherever lines end.
fn text(bytes: &[u8]) -> Result<(Vec<[f32; 3]>, Reservation), ModelFormatError> {
    let (mut places, mut room) = (Vec::new(), Reservation::none());
    let mut words = Words::new(bytes);
    // Corners since the loop began.
    let mut corners = 0;
    while let Some((line, word)) = words.next() {
        let place = FilePosition::Line(line);
        let is = |keyword: &str| word.eq_ignore_ascii_case(keyword.as_bytes());
        if is("vertex") {
            let position = position(&mut words).map_err(|reason| place.broken(reason))?;
            room.push(&mut places, position, "corners")?;
            corners += 1;
        } else if is("endloop") {
            if corners != 3 {
                return Err(place.broken(format!("a facet has {corners} corners, not 3")));
            }
            corners = 0;
        } else if is("solid") || is("endsolid") {
            words.skip_name(line);
        }
    }
    if corners > 0 {
        let lines = 1 + bytes.iter().filter(|byte| **byte == words.end_of_line).count();
        return Err(FilePosition::Line(lines).broken("the file ends within a facet"));
    }
    Ok((places, room))
}

/// Words between white space, with their lines.
#[derive(Clone)]
struct Words<'a> {
    rest: &'a [u8],
    line: usize,
    /// The end of lines: old files have only carriage returns.
    end_of_line: u8,
}

impl<'a> Words<'a> {
    fn new(bytes: &'a [u8]) -> Words<'a> {
        let end_of_line = if bytes.contains(&b'\n') { b'\n' } else { b'\r' };
        let text = without_ends(bytes);
        let before = &bytes[..bytes.len() - bytes.trim_ascii_start().len()];
        let lines = before.iter().filter(|byte| **byte == end_of_line).count();
        Words { rest: text, line: lines + 1, end_of_line }
    }

    /// Skips the name of a solid, which is the rest of its line. Files of a single line go on with `facet normal`.
    fn skip_name(&mut self, line: usize) {
        let is_facet = |words: &Words| {
            let mut words = words.clone().map(|(_, word)| word.to_ascii_lowercase());
            words.next().as_deref() == Some(b"facet") && words.next().as_deref() == Some(b"normal")
        };
        while self.clone().next().is_some_and(|(next, _)| next == line) && !is_facet(self) {
            self.next();
        }
    }
}

impl<'a> Iterator for Words<'a> {
    /// A line, counted from 1, and a word.
    type Item = (usize, &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        let is_space = |byte: &u8| byte.is_ascii_whitespace() || *byte == 0x0b;
        let start = self.rest.iter().position(|byte| !is_space(byte))?;
        self.line += self.rest[..start].iter().filter(|byte| **byte == self.end_of_line).count();
        let rest = &self.rest[start..];
        let (word, rest) = rest.split_at(rest.iter().position(is_space).unwrap_or(rest.len()));
        self.rest = rest;
        Some((self.line, word))
    }
}

fn position(words: &mut Words) -> Result<[f32; 3], String> {
    let mut position = [0.0; 3];
    for number in &mut position {
        let (_, word) = words.next().ok_or("a vertex has three coordinates")?;
        let real = str::from_utf8(word).ok().and_then(number::real).filter(|x| x.is_finite());
        *number = real.ok_or_else(|| format!("{} is not a finite number", quote::bytes(word)))?;
    }
    Ok(position)
}
