//! Attributes of PLY files, such as `vertex_color` and `face_weight`, as colours of vertices.
//!
//! An attribute is a group of properties `name_0`, `name_1`, `name_2` of vertices or faces; `r`, `g` and `b` are its name `color`.
use std::path::Path;

use super::{
    super::{
        context::{Import, Uses},
        tree::Element,
    },
    ply_values::{read_file, read_values},
};
use noisefall_scene::{
    model::{Model, smooth_normals},
    scene::SceneError,
};

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
        import.remark(
            element,
            &format!("the attribute `{name}` alone"),
            "textures that use other attributes of the mesh show its values",
        );
    }
    let missing =
        || element.error(format!("the mesh has no attribute `{name}`"), "such as `vertex_color` or `face_weight` of a PLY");
    let bytes = read_file(element, path)?;
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
    let mut found = Vec::new();
    read_values(
        bytes,
        of,
        |name| channel(attribute, name),
        |channels, corners| {
            let copies = if of == "face" { corners.saturating_sub(2) } else { 1 };
            found.extend(std::iter::repeat_n(colour(channels), copies));
        },
    )?;
    Some(found)
}

/// The channel of an attribute that a property holds.
fn channel(attribute: &str, name: &str) -> Option<usize> {
    let color = ["r", "g", "b"].iter().position(|channel| *channel == name);
    let color = color.or_else(|| ["red", "green", "blue"].iter().position(|channel| *channel == name));
    if attribute == "color" && color.is_some() {
        return color;
    }
    let (prefix, number) = name.rsplit_once('_')?;
    if prefix == attribute { number.parse().ok() } else { None }
}

/// A single number is that of all channels.
fn colour(channels: [Option<f64>; 3]) -> [f32; 4] {
    let first = channels[0].unwrap_or(0.0);
    let [r, g, b] = channels.map(|channel| channel.unwrap_or(if channels[1].is_none() { first } else { 0.0 }) as f32);
    [r, g, b, 1.0]
}

/// A model whose triangles share no vertices. Smooth normals stay smooth.
pub fn unwelded(model: &Model, face_normals: bool) -> Model {
    let smooth = || smooth_normals(&model.vertices, &model.triangles);
    let normals = (!face_normals).then(|| model.normals.clone().unwrap_or_else(smooth));
    let corners = || model.triangles.iter().flatten().map(|corner| *corner as usize);
    Model {
        vertices: corners().map(|corner| model.vertices[corner]).collect(),
        triangles: (0..model.triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        normals: normals.map(|normals| corners().map(|corner| normals[corner]).collect()),
        uvs: model.uvs.as_ref().map(|uvs| corners().map(|corner| uvs[corner]).collect()),
        ..Model::default()
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
    fn truncated_files_and_excessive_counts_are_refused() {
        for end in 0..FILE.len() - 1 {
            let _ = values(&FILE.as_bytes()[..end], "face", "weight");
        }
        let many = FILE.replace("vertex 3", "vertex 99999999999");
        assert!(values(many.as_bytes(), "face", "weight").is_none());
    }
}
