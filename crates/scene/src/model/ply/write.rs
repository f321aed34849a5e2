//! Writes a mesh as binary PLY: little-endian `float` numbers, so that reading gives the same bits.
use crate::model::Model;
use noisefall_base::memory::{Size, TooMuch, reserve};

/// The bytes of a PLY file. Texture coordinates are `s` and `t`, colours `red`, `green`, `blue` and `alpha`, linear, and tangents `tx`,
/// `ty`, `tz` and `tw`.
pub fn encode(model: &Model) -> Result<Vec<u8>, TooMuch> {
    const TRIANGLE: usize = 13;
    let columns = columns(model);
    let width: usize = columns.iter().map(|column| 4 * column.names.len()).sum();
    let length = width * model.vertices.len() + TRIANGLE * model.triangles.len();
    let _room = reserve(format_args!("{} of a mesh file", Size(length as u64)), length as u64)?;
    let mut bytes = header(model, &columns).into_bytes();
    bytes.reserve_exact(length);
    for vertex in 0..model.vertices.len() {
        for column in &columns {
            (column.values)(vertex).iter().for_each(|x| bytes.extend(x.to_le_bytes()));
        }
    }
    for triangle in &model.triangles {
        bytes.push(3);
        triangle.iter().for_each(|index| bytes.extend(index.to_le_bytes()));
    }
    Ok(bytes)
}

/// Numbers of every vertex.
struct Column<'m> {
    names: &'static [&'static str],
    values: Box<dyn Fn(usize) -> &'m [f32] + 'm>,
}

fn columns(model: &Model) -> Vec<Column<'_>> {
    fn column<'m, const N: usize>(names: &'static [&'static str; N], values: &'m [[f32; N]]) -> Column<'m> {
        Column { names, values: Box::new(move |vertex| &values[vertex]) }
    }
    let normals = model.normals.as_deref().map(|normals| column(&["nx", "ny", "nz"], normals));
    let uvs = model.uvs.as_deref().map(|uvs| column(&["s", "t"], uvs));
    let colours = model.colours.as_deref().map(|colours| column(&["red", "green", "blue", "alpha"], colours));
    let tangents = model.tangents.as_deref().map(|tangents| column(&["tx", "ty", "tz", "tw"], tangents));
    [Some(column(&["x", "y", "z"], &model.vertices)), normals, uvs, colours, tangents].into_iter().flatten().collect()
}

fn header(model: &Model, columns: &[Column]) -> String {
    let names = columns.iter().flat_map(|column| column.names);
    let properties: String = names.map(|name| format!("property float {name}\n")).collect();
    let [vertices, faces] = [model.vertices.len(), model.triangles.len()];
    format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\n{properties}element face {faces}\n\
         property list uchar uint vertex_indices\nend_header\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ply::decode;
    use noisefall_base::progress::Progress;

    #[test]
    fn reading_gives_the_same_bits() {
        let model = Model {
            vertices: vec![[0.1, -0.0, 1e-30], [1.0, 0.0, 3.4e38], [0.0, 1.0, 0.3]],
            triangles: vec![[0, 1, 2], [2, 1, 0]],
            normals: Some(vec![[0.0, 0.6, 0.8]; 3]),
            uvs: Some(vec![[0.1, 0.7], [-3.5, 2.0], [0.0, 1.0]]),
            tangents: Some(vec![[0.8, -0.36, 0.48, -1.0]; 3]),
            ..Model::default()
        };
        let read = decode(&encode(&model).expect("there is room"), &Progress::default()).expect("it is a mesh");
        let bits = |model: &Model| model.vertices.iter().flatten().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!((bits(&read), &read), (bits(&model), &model));
        let bare = Model { normals: None, uvs: None, tangents: None, ..model };
        assert_eq!(decode(&encode(&bare).expect("there is room"), &Progress::default()).expect("it is a mesh"), bare);
    }

    #[test]
    fn colours_are_properties_of_vertices() {
        let model = Model {
            vertices: vec![[0.0; 3]; 3],
            triangles: vec![[0, 1, 2]],
            colours: Some(vec![[0.25, 0.5, 0.75, 1.0]; 3]),
            ..Model::default()
        };
        let bytes = encode(&model).expect("there is room");
        let header = String::from_utf8_lossy(&bytes);
        assert!(header.contains("property float red\nproperty float green\nproperty float blue\nproperty float alpha\n"));
        assert!(bytes.windows(4).any(|word| word == 0.75f32.to_le_bytes()));
    }
}
