//! Mitsuba's own mesh format: zlib streams of vertices and triangles.
//!
//! A file holds several meshes one after the other, and ends in a dictionary of their offsets. Its format is in Mitsuba's manual, at the
//! plugin `serialized`.
use std::{io::Read, path::Path};

use miniz_oxide::inflate::decompress_to_vec_zlib_with_limit;

use noisefall_base::{
    file::open_regular,
    memory::{Reservation, reserve},
};
use noisefall_scene::model::{LARGEST_FILE, Model};

const MAGIC: u16 = 0x041C;
const NORMALS: u32 = 0x1;
const COORDINATES: u32 = 0x2;
const COLORS: u32 = 0x8;
const FACE_NORMALS: u32 = 0x10;
const DOUBLE: u32 = 0x2000;
/// Room for a small file that unpacks well.
const ROOM: usize = 64 << 20;
/// Bytes of all meshes per byte of their file, besides.
const MOST_UNPACKED: u64 = 8;
const ENDS: &str = "the file ends too early";

/// A file. The shapes of a scene often lie in one file, which is read once.
pub struct Packed {
    bytes: Vec<u8>,
    /// Bytes of the meshes so far: entries of the dictionary can name the same stream again and again.
    unpacked: u64,
    _room: Reservation,
}

impl Packed {
    /// Reads a file. An error is the end of a sentence.
    pub fn read(path: &Path) -> Result<Packed, String> {
        let mut bytes = Vec::new();
        let read = open_regular(path).and_then(|file| file.take(LARGEST_FILE).read_to_end(&mut bytes));
        read.map_err(|reason| reason.to_string())?;
        let room = reserve("the bytes of a mesh", bytes.len() as u64).map_err(|reason| reason.to_string())?;
        Ok(Packed { bytes, unpacked: 0, _room: room })
    }

    /// Bytes of the file.
    pub fn length(&self) -> u64 {
        self.bytes.len() as u64
    }

    /// The mesh of a number. An error is the end of a sentence.
    pub fn mesh(&mut self, number: i64) -> Result<Model, String> {
        let number = usize::try_from(number).map_err(|_| "there is no mesh of this number")?;
        let work = reserve("the bytes of an unpacked mesh", (3 * self.bytes.len() + ROOM) as u64);
        let _work = work.map_err(|reason| reason.to_string())?;
        let model = decode(&self.bytes, number)?;
        self.unpacked += model.bytes();
        if self.unpacked > MOST_UNPACKED * self.bytes.len() as u64 + ROOM as u64 {
            return Err("the scene unpacks it again and again".to_owned());
        }
        Ok(model)
    }
}

/// The mesh of a number.
fn decode(bytes: &[u8], number: usize) -> Result<Model, &'static str> {
    let short = |at: usize| bytes.get(at..at + 2).map(|two| u16::from_le_bytes([two[0], two[1]]));
    let offset = offset(bytes, number, short(2).ok_or(ENDS)?).ok_or("there is no mesh of this number")?;
    let version = match (short(offset), short(offset + 2)) {
        (Some(MAGIC), Some(version @ (3 | 4))) => version,
        (Some(_), Some(_)) => return Err("it is not a serialized mesh of version 3 or 4"),
        _ => return Err(ENDS),
    };
    let packed = &bytes[offset + 4..];
    let limit = 3 * bytes.len() + ROOM;
    let unpacked = decompress_to_vec_zlib_with_limit(packed, limit).map_err(|_| "its data are damaged or unpack to too much")?;
    Stream { rest: &unpacked }.mesh(version).ok_or(ENDS)?
}

/// Where a mesh begins.
fn offset(bytes: &[u8], number: usize, version: u16) -> Option<usize> {
    if number == 0 {
        return Some(0);
    }
    let size = if version == 3 { 4 } else { 8 };
    let end = bytes.len().checked_sub(4)?;
    let count = u32::from_le_bytes(bytes[end..].try_into().ok()?) as usize;
    let start = end.checked_sub(size * count.checked_sub(number)?)?;
    if number >= count {
        return None;
    }
    let mut eight = [0; 8];
    eight[..size].copy_from_slice(bytes.get(start..start + size)?);
    usize::try_from(u64::from_le_bytes(eight)).ok().filter(|offset| *offset < bytes.len() - 4)
}

/// Unpacked bytes.
struct Stream<'a> {
    rest: &'a [u8],
}

impl Stream<'_> {
    /// `None` if the bytes end too early.
    fn mesh(&mut self, version: u16) -> Option<Result<Model, &'static str>> {
        let flags = u32::from_le_bytes(self.take()?);
        if version == 4 {
            let end = self.rest.iter().position(|byte| *byte == 0)?;
            self.rest = &self.rest[end + 1..];
        }
        let [vertices, triangles] = [u64::from_le_bytes(self.take()?), u64::from_le_bytes(self.take()?)];
        let [vertices, triangles] = [usize::try_from(vertices).ok()?, usize::try_from(triangles).ok()?];
        let is_double = flags & DOUBLE != 0;
        let places = self.numbers::<3>(vertices, is_double)?;
        let normals = if flags & NORMALS != 0 { Some(self.numbers::<3>(vertices, is_double)?) } else { None };
        let uvs = if flags & COORDINATES != 0 { Some(self.numbers::<2>(vertices, is_double)?) } else { None };
        let colors = if flags & COLORS != 0 { Some(self.numbers::<3>(vertices, is_double)?) } else { None };
        let corners = self.rest.get(..triangles.checked_mul(12)?)?;
        let corner = |bytes: &[u8]| u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
        let triangles: Vec<[u32; 3]> =
            corners.chunks_exact(12).map(|three| [corner(three), corner(&three[4..]), corner(&three[8..])]).collect();
        if triangles.is_empty() {
            return Some(Err("the mesh is empty"));
        }
        if triangles.iter().flatten().any(|corner| *corner as usize >= vertices) {
            return Some(Err("a triangle has a vertex that does not exist"));
        }
        if !places.as_flattened().iter().all(|x| x.is_finite()) {
            return Some(Err("a vertex is not finite"));
        }
        let unit = |n: [f32; 3]| glam::Vec3::from(n).try_normalize().map(|n| n.to_array());
        let normals = normals.filter(|_| flags & FACE_NORMALS == 0);
        let normals = normals.and_then(|normals| normals.into_iter().map(unit).collect::<Option<Vec<_>>>());
        let colours = colors.map(|colors| colors.into_iter().map(|[r, g, b]| [r, g, b, 1.0]).collect());
        Some(Ok(Model { vertices: places, triangles, normals, uvs, colours, ..Model::default() }))
    }

    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (bytes, rest) = self.rest.split_first_chunk::<N>()?;
        self.rest = rest;
        Some(*bytes)
    }

    /// Groups of N numbers.
    fn numbers<const N: usize>(&mut self, count: usize, is_double: bool) -> Option<Vec<[f32; N]>> {
        let size = if is_double { 8 } else { 4 };
        let (bytes, rest) = self.rest.split_at_checked(count.checked_mul(N * size)?)?;
        self.rest = rest;
        let number = |bytes: &[u8]| match *bytes {
            [a, b, c, d] => f32::from_le_bytes([a, b, c, d]),
            [a, b, c, d, e, f, g, h] => f64::from_le_bytes([a, b, c, d, e, f, g, h]) as f32,
            _ => 0.0,
        };
        let group = |bytes: &[u8]| {
            let mut numbers = [0.0; N];
            numbers.iter_mut().zip(bytes.chunks_exact(size)).for_each(|(x, bytes)| *x = number(bytes));
            numbers
        };
        Some(bytes.chunks_exact(N * size).map(group).collect())
    }
}

#[cfg(test)]
mod tests {
    use miniz_oxide::deflate::compress_to_vec_zlib;

    use super::*;

    /// A triangle in a file of version 4, with a second, smaller one behind it.
    fn file() -> Vec<u8> {
        let mesh = |size: f32| {
            let mut data = Vec::new();
            data.extend((0x1000u32 | COORDINATES).to_le_bytes());
            data.extend(b"name\0");
            data.extend(3u64.to_le_bytes());
            data.extend(1u64.to_le_bytes());
            let places = [0.0, 0.0, 0.0, size, 0.0, 0.0, 0.0, size, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0f32];
            data.extend(places.iter().flat_map(|x| x.to_le_bytes()));
            data.extend([0u32, 1, 2].iter().flat_map(|i| i.to_le_bytes()));
            [&[0x1c, 4, 4, 0][..], &compress_to_vec_zlib(&data, 6)].concat()
        };
        let (first, second) = (mesh(1.0), mesh(0.5));
        let offsets = [0, first.len() as u64].map(u64::to_le_bytes).concat();
        [first, second, offsets, 2u32.to_le_bytes().to_vec()].concat()
    }

    #[test]
    fn each_mesh_of_a_file_is_found() {
        let first = decode(&file(), 0).expect("it is valid");
        assert_eq!((first.vertices[1], first.triangles.len(), first.normals), ([1.0, 0.0, 0.0], 1, None));
        assert_eq!(first.uvs, Some(vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]));
        assert_eq!(decode(&file(), 1).expect("it is valid").vertices[1], [0.5, 0.0, 0.0]);
        assert_eq!(decode(&file(), 2), Err("there is no mesh of this number"));
    }

    #[test]
    fn damaged_files_are_refused() {
        let file = file();
        for end in 0..file.len() - 20 {
            let _ = (decode(&file[..end], 0), decode(&file[..end], 1));
        }
        for at in 0..file.len() {
            let mut damaged = file.clone();
            damaged[at] ^= 0x55;
            let _ = (decode(&damaged, 0), decode(&damaged, 1));
        }
    }
}
