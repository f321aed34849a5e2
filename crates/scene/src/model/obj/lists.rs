//! Positions, texture coordinates and normals that the corners of faces refer to.
use rayon::prelude::*;

use super::{
    super::{ModelFormatError, number},
    text::{ChunkError, Chunks, Words, words},
};
use noisefall_base::{math::colour::linear_from_srgb, memory::Reservation, quote};

/// The colour of positions without one.
pub const WHITE: [f32; 4] = [1.0; 4];

/// The lists of a file or of a chunk.
#[derive(Default)]
pub struct Lists {
    pub places: Vec<[f32; 3]>,
    pub uvs: Vec<[f32; 2]>,
    pub normals: Vec<[f32; 3]>,
    /// Colours of positions, up to the last one that has any.
    pub colours: Vec<[f32; 4]>,
}

/// Numbers of elements before a line.
#[derive(Clone, Copy, Default)]
pub struct Counts {
    pub places: usize,
    pub uvs: usize,
    pub normals: usize,
}

impl Lists {
    /// The lists of the file, and the numbers of their elements before each chunk.
    pub fn read(chunks: &Chunks, room: &mut Reservation) -> Result<(Lists, Vec<Counts>), ModelFormatError> {
        let of_chunk = |chunk| Lists::of_chunk(chunks, chunk);
        let mut parts = chunks.all((0..chunks.list.len()).into_par_iter().map(of_chunk).collect())?;
        let mut counts = Vec::with_capacity(parts.len());
        let mut all = Counts::default();
        for (lists, _) in &parts {
            counts.push(all);
            all.places += lists.places.len();
            all.uvs += lists.uvs.len();
            all.normals += lists.normals.len();
        }
        if parts.len() == 1 {
            let (lists, reserved) = parts.remove(0);
            *room = reserved;
            return Ok((lists, counts));
        }
        let bytes = 12 * (all.places + all.normals) + 8 * all.uvs;
        room.grow(format_args!("{} vertices", all.places), bytes as u64)?;
        let mut lists = Lists {
            places: Vec::with_capacity(all.places),
            uvs: Vec::with_capacity(all.uvs),
            normals: Vec::with_capacity(all.normals),
            colours: Vec::new(),
        };
        parts.into_iter().try_for_each(|(part, _)| lists.append(&part, room))?;
        Ok((lists, counts))
    }

    fn of_chunk(chunks: &Chunks, chunk: usize) -> Result<(Lists, Reservation), ChunkError> {
        let (mut lists, mut room) = (Lists::default(), Reservation::none());
        for (number, line) in chunks.lines(chunk)? {
            lists.add(words(line), &mut room).map_err(|reason| ChunkError::Line(number, reason))?;
        }
        Ok((lists, room))
    }

    fn append(&mut self, part: &Lists, room: &mut Reservation) -> Result<(), ModelFormatError> {
        if !part.colours.is_empty() {
            let length = self.places.len() + part.colours.len();
            room.grow("colours", (length * size_of_val(&WHITE)) as u64)?;
            self.colours.resize(self.places.len(), WHITE);
            self.colours.extend(&part.colours);
        }
        self.places.extend(&part.places);
        self.uvs.extend(&part.uvs);
        self.normals.extend(&part.normals);
        Ok(())
    }

    fn add(&mut self, mut words: Words, room: &mut Reservation) -> Result<(), String> {
        match words.next() {
            Some("v") => {
                let (place, rest) = place(words)?;
                if let Some(colour) = colour(rest) {
                    while self.colours.len() < self.places.len() {
                        room.push(&mut self.colours, WHITE, "colours").map_err(|error| error.to_string())?;
                    }
                    room.push(&mut self.colours, colour, "colours").map_err(|error| error.to_string())?;
                }
                room.push(&mut self.places, place, "vertices")
            }
            Some("vt") => room.push(&mut self.uvs, numbers(&mut words, 1).map(finite)?, "texture coordinates"),
            Some("vn") => room.push(&mut self.normals, numbers(&mut words, 3).map(finite)?, "normals"),
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

/// A position, and the words after it.
fn place<'a, I: Iterator<Item = &'a str> + Clone>(words: I) -> Result<([f32; 3], I), String> {
    let mut rest = words.clone();
    let place: [f32; 3] = numbers(&mut rest, 3)?;
    match place.iter().zip(words).find(|(number, _)| !number.is_finite()) {
        Some((_, word)) => Err(format!("{} is not a finite number", quote::bytes(word.as_bytes()))),
        None => Ok((place, rest)),
    }
}

/// The colour after a position, if there is one: three numbers more. A fourth number alone is a weight.
fn colour<'a>(mut words: impl Iterator<Item = &'a str>) -> Option<[f32; 4]> {
    let words = [words.next()?, words.next()?, words.next()?];
    let [red, green, blue] = words.map(number::real);
    let [red, green, blue] = finite([red?, green?, blue?]).map(|x| linear_from_srgb(x.into()) as f32);
    Some([red, green, blue, 1.0])
}

/// Reads N numbers. Those after the first `needed` are optional and 0 by default; further ones, such as weights, are ignored.
fn numbers<'a, const N: usize>(words: &mut impl Iterator<Item = &'a str>, needed: usize) -> Result<[f32; N], String> {
    let mut numbers = [0.0; N];
    let mut found = 0;
    for (number, word) in numbers.iter_mut().zip(words) {
        *number = number::real(word).ok_or_else(|| format!("{} is not a number", quote::bytes(word.as_bytes())))?;
        found += 1;
    }
    if found < needed { Err(format!("there are {found} numbers, not {needed}")) } else { Ok(numbers) }
}
