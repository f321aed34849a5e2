//! Values of PLY files that a mesh does not have.
use std::{collections::HashMap, io::Read, path::Path};

use super::super::tree::Element;
use noisefall_base::{file::open_regular, math::colour::linear_from_srgb};
use noisefall_scene::{model::LARGEST_FILE, scene::SceneError};

/// The bytes of a file.
pub fn read_file(element: Element, path: &Path) -> Result<Vec<u8>, SceneError> {
    let mut bytes = Vec::new();
    let read = open_regular(path).and_then(|file| file.take(LARGEST_FILE + 1).read_to_end(&mut bytes));
    let length = read.map_err(|error| element.error(format!("the file cannot be read: {error}"), "check the file"))?;
    if length as u64 > LARGEST_FILE {
        return Err(element.error(format!("the file is larger than {} MB", LARGEST_FILE >> 20), "split it"));
    }
    Ok(bytes)
}

/// Gives the channels of each item of the group `of`, such as `vertex`, and the number of its corners. `channel` tells which of them
/// a property is. `None` if the file is damaged, or if no property is a channel.
pub fn read_values<const N: usize>(
    bytes: &[u8],
    of: &str,
    channel: impl Fn(&str) -> Option<usize>,
    mut take: impl FnMut([Option<f64>; N], usize),
) -> Option<()> {
    let (groups, mut body) = header(bytes)?;
    let of_property = |property: &Property| channel(&property.name).filter(|slot| property.count.is_none() && *slot < N);
    // Without properties, a count is not bounded by the size of the file.
    for group in groups.iter().filter(|group| !group.properties.is_empty()) {
        let slots: Vec<Option<usize>> = group.properties.iter().map(of_property).collect();
        let is_wanted = group.name == of && slots.iter().any(Option::is_some);
        for _ in 0..group.count {
            let (channels, corners) = body.item(group, &slots)?;
            if is_wanted {
                take(channels, corners);
            }
        }
        if is_wanted {
            return Some(());
        }
    }
    None
}

/// A type of values: its size in bytes, and whether it is a fraction or a signed number.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Signed(usize),
    Unsigned(usize),
    Real(usize),
}

struct Property {
    name: String,
    /// The type of the count of a list.
    count: Option<Kind>,
    kind: Kind,
}

/// An element of a PLY file: its count and properties.
struct PlyElement {
    name: String,
    count: usize,
    properties: Vec<Property>,
}

/// The values of a file.
struct Body<'a> {
    rest: &'a [u8],
    format: Format,
}

#[derive(Clone, Copy, PartialEq)]
enum Format {
    Text,
    Little,
    Big,
}

impl Body<'_> {
    /// A vertex or a face: its channels, and the number of its corners. Bytes are colours in sRGB.
    fn item<const N: usize>(&mut self, group: &PlyElement, slots: &[Option<usize>]) -> Option<([Option<f64>; N], usize)> {
        let mut channels = [None; N];
        let mut corners = 0;
        for (property, slot) in group.properties.iter().zip(slots) {
            if let Some(count) = property.count {
                let count = self.number(count)? as usize;
                for _ in 0..count {
                    self.number(property.kind)?;
                }
                if matches!(property.name.as_str(), "vertex_indices" | "vertex_index") {
                    corners = count;
                }
                continue;
            }
            let value = self.number(property.kind)?;
            if let Some(slot) = slot {
                channels[*slot] = Some(if property.kind == Kind::Unsigned(1) { linear_from_srgb(value / 255.0) } else { value });
            }
        }
        Some((channels, corners))
    }

    fn number(&mut self, kind: Kind) -> Option<f64> {
        if self.format == Format::Text {
            let start = self.rest.trim_ascii_start();
            let length = start.iter().position(u8::is_ascii_whitespace).unwrap_or(start.len());
            let (word, rest) = start.split_at(length);
            self.rest = rest;
            return str::from_utf8(word).ok()?.parse().ok();
        }
        let (Kind::Signed(size) | Kind::Unsigned(size) | Kind::Real(size)) = kind;
        let (bytes, rest) = self.rest.split_at_checked(size)?;
        self.rest = rest;
        let mut eight = [0u8; 8];
        eight[..size].copy_from_slice(bytes);
        if self.format == Format::Big {
            eight[..size].reverse();
        }
        let whole = u64::from_le_bytes(eight);
        let unused = 64 - 8 * size as u32;
        Some(match kind {
            Kind::Signed(_) => ((whole << unused) as i64 >> unused) as f64,
            Kind::Unsigned(_) => whole as f64,
            Kind::Real(4) => f64::from(f32::from_bits(whole as u32)),
            Kind::Real(_) => f64::from_bits(whole),
        })
    }
}

/// The groups of a file and its values.
fn header(bytes: &[u8]) -> Option<(Vec<PlyElement>, Body<'_>)> {
    let kinds: HashMap<&str, Kind> = HashMap::from([
        ("char", Kind::Signed(1)),
        ("int8", Kind::Signed(1)),
        ("short", Kind::Signed(2)),
        ("int16", Kind::Signed(2)),
        ("int", Kind::Signed(4)),
        ("int32", Kind::Signed(4)),
        ("uchar", Kind::Unsigned(1)),
        ("uint8", Kind::Unsigned(1)),
        ("ushort", Kind::Unsigned(2)),
        ("uint16", Kind::Unsigned(2)),
        ("uint", Kind::Unsigned(4)),
        ("uint32", Kind::Unsigned(4)),
        ("float", Kind::Real(4)),
        ("float32", Kind::Real(4)),
        ("double", Kind::Real(8)),
        ("float64", Kind::Real(8)),
    ]);
    let (mut groups, mut format, mut rest) = (Vec::<PlyElement>::new(), None, bytes);
    loop {
        let end = rest.iter().position(|byte| *byte == b'\n')?;
        let line = String::from_utf8_lossy(&rest[..end]).into_owned();
        rest = &rest[end + 1..];
        match line.split_ascii_whitespace().collect::<Vec<_>>()[..] {
            ["format", "ascii", _] => format = Some(Format::Text),
            ["format", "binary_little_endian", _] => format = Some(Format::Little),
            ["format", "binary_big_endian", _] => format = Some(Format::Big),
            ["element", name, count] => {
                groups.push(PlyElement { name: name.to_owned(), count: count.parse().ok()?, properties: Vec::new() });
            }
            ["property", "list", count, kind, name] => {
                let (count, kind) = (Some(*kinds.get(count)?), *kinds.get(kind)?);
                groups.last_mut()?.properties.push(Property { name: name.to_owned(), count, kind });
            }
            ["property", kind, name] => {
                let kind = *kinds.get(kind)?;
                groups.last_mut()?.properties.push(Property { name: name.to_owned(), count: None, kind });
            }
            ["end_header"] => return Some((groups, Body { rest, format: format? })),
            _ => {}
        }
    }
}
