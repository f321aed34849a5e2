//! Attributes of PLY files, such as `vertex_color` and `face_weight`, as colours of vertices.
//!
//! An attribute is a group of properties `name_0`, `name_1`, `name_2` of vertices or faces; `r`, `g` and `b` are its name `color`.
use std::{collections::HashMap, path::Path};

use super::super::{
    context::{Import, Uses},
    tree::Element,
};
use crate::{
    file::open_regular,
    math::colour::linear_from_srgb,
    model::{Model, smooth_normals},
    scene::SceneError,
};

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

struct Group {
    name: String,
    count: usize,
    properties: Vec<Property>,
}

/// Puts the attribute that a shape uses into the colours of its model.
pub fn apply(
    import: &mut Import,
    element: Element,
    path: &Path,
    model: &mut Model,
    uses: &Uses,
    face_normals: bool,
) -> Result<(), SceneError> {
    let mut names = uses.attributes.iter();
    let Some(name) = names.next() else { return Ok(()) };
    if names.next().is_some() {
        import.remark(element, &format!("the attribute `{name}` alone"), "further attributes of the mesh have its values");
    }
    let missing =
        || element.error(format!("the mesh has no attribute `{name}`"), "such as `vertex_color` or `face_weight` of a PLY");
    let mut bytes = Vec::new();
    let read = open_regular(path).and_then(|mut file| std::io::Read::read_to_end(&mut file, &mut bytes));
    read.map_err(|error| element.error(format!("the mesh cannot be read: {error}"), "check the file"))?;
    let (of, property) = name.split_once('_').ok_or_else(missing)?;
    let values = values(&bytes, of, property).filter(|values| !values.is_empty()).ok_or_else(missing)?;
    if of == "vertex" && values.len() == model.vertices.len() {
        model.colours = Some(values);
        return Ok(());
    }
    if of != "face" || values.len() != model.triangles.len() {
        return Err(missing());
    }
    *model = unwelded(model, face_normals);
    model.colours = Some(values.iter().flat_map(|value| [*value; 3]).collect());
    Ok(())
}

/// The values of an attribute of vertices, or of faces once for each triangle.
fn values(bytes: &[u8], of: &str, attribute: &str) -> Option<Vec<[f32; 4]>> {
    let (groups, mut body) = header(bytes)?;
    // Without properties, a count is not bounded by the size of the file.
    for group in groups.iter().filter(|group| !group.properties.is_empty()) {
        let slots = slots(group, attribute);
        let is_wanted = group.name == of && slots.iter().any(Option::is_some);
        let mut found = Vec::new();
        for _ in 0..group.count {
            let (value, corners) = body.item(group, &slots)?;
            let copies = if of == "face" { corners.saturating_sub(2) } else { 1 };
            if is_wanted {
                found.extend(std::iter::repeat_n(value, copies));
            }
        }
        if is_wanted {
            return Some(found);
        }
    }
    None
}

/// For each property, the channels of the attribute that it holds: all for a single number.
fn slots(group: &Group, attribute: &str) -> Vec<Option<usize>> {
    let channel = |name: &str| -> Option<usize> {
        let color = ["r", "g", "b"].iter().position(|channel| *channel == name);
        let color = color.or_else(|| ["red", "green", "blue"].iter().position(|channel| *channel == name));
        if attribute == "color" && color.is_some() {
            return color;
        }
        let (prefix, number) = name.rsplit_once('_')?;
        if prefix == attribute { number.parse().ok().filter(|number| *number < 3) } else { None }
    };
    group.properties.iter().map(|property| channel(&property.name).filter(|_| property.count.is_none())).collect()
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
    /// A vertex or a face: its value of the attribute, and the number of its corners.
    fn item(&mut self, group: &Group, slots: &[Option<usize>]) -> Option<([f32; 4], usize)> {
        let mut channels = [None; 3];
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
        let first = channels[0].unwrap_or(0.0);
        let [r, g, b] = channels.map(|channel| channel.unwrap_or(if channels[1].is_none() { first } else { 0.0 }) as f32);
        Some(([r, g, b, 1.0], corners))
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
fn header(bytes: &[u8]) -> Option<(Vec<Group>, Body<'_>)> {
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
    let (mut groups, mut format, mut rest) = (Vec::<Group>::new(), None, bytes);
    loop {
        let end = rest.iter().position(|byte| *byte == b'\n')?;
        let line = String::from_utf8_lossy(&rest[..end]).into_owned();
        rest = &rest[end + 1..];
        match line.split_ascii_whitespace().collect::<Vec<_>>()[..] {
            ["format", "ascii", _] => format = Some(Format::Text),
            ["format", "binary_little_endian", _] => format = Some(Format::Little),
            ["format", "binary_big_endian", _] => format = Some(Format::Big),
            ["element", name, count] => {
                groups.push(Group { name: name.to_owned(), count: count.parse().ok()?, properties: Vec::new() });
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

/// A model whose triangles share no vertices. Smooth normals stay smooth.
fn unwelded(model: &Model, face_normals: bool) -> Model {
    let smooth = || smooth_normals(&model.vertices, &model.triangles);
    let normals = (!face_normals).then(|| model.normals.clone().unwrap_or_else(smooth));
    let corners = || model.triangles.iter().flatten().map(|corner| *corner as usize);
    Model {
        vertices: corners().map(|corner| model.vertices[corner]).collect(),
        triangles: (0..model.triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        normals: normals.map(|normals| corners().map(|corner| normals[corner]).collect()),
        uvs: model.uvs.as_ref().map(|uvs| corners().map(|corner| uvs[corner]).collect()),
        colours: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty uchar red\nproperty uchar green\n\
        property uchar blue\nelement face 2\nproperty list uchar int vertex_indices\nproperty float weight_0\nend_header\n\
        0 255 0 0\n1 0 255 0\n2 0 0 255\n3 0 1 2 0.25\n4 0 1 2 0 0.75\n";

    #[test]
    fn attributes_of_vertices_and_of_faces_are_found() {
        let colors = values(FILE.as_bytes(), "vertex", "color").expect("it is there");
        assert_eq!(colors, [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]]);
        let weights = values(FILE.as_bytes(), "face", "weight").expect("it is there");
        assert_eq!(
            weights,
            [[0.25, 0.25, 0.25, 1.0], [0.75, 0.75, 0.75, 1.0], [0.75, 0.75, 0.75, 1.0]],
            "a quad is two triangles"
        );
        assert!(values(FILE.as_bytes(), "face", "heat").is_none());
    }

    #[test]
    fn what_ends_too_early_or_counts_too_many_is_refused() {
        for end in 0..FILE.len() - 1 {
            let _ = values(&FILE.as_bytes()[..end], "face", "weight");
        }
        let many = FILE.replace("vertex 3", "vertex 99999999999");
        assert!(values(many.as_bytes(), "face", "weight").is_none());
    }
}
