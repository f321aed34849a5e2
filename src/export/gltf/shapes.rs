//! Objects: meshes, and the nodes that show them.
use std::sync::Arc;

use glam::{DVec3, Vec3};
use serde_json::{Map, Value, json};

use super::{
    super::{
        ExportError,
        geometry::{fineness, triangles},
        notes,
    },
    context::{Export, table},
    known::{Columns, Made, MeshKey, VertexColors},
    units,
};
use crate::{
    geometry::{MeshData, Shape},
    model::Model,
    scene::description::ObjectDescription,
};

/// Error of the square of a normal's length that counts as rounding.
const ROUNDING: f32 = 1e-5;

/// Adds the shapes of an object.
pub fn object(export: &mut Export, number: usize, object: &ObjectDescription, shapes: &[Shape]) -> Result<(), ExportError> {
    export.at(notes::element("object", number, &object.name), |export| {
        if !object.motion.is_empty() {
            export.remark("`motion`", "the place at time 0", "the object is sharp");
        }
        let is_closed = shapes.iter().all(|shape| {
            let is_capped = matches!(shape, Shape::Cylinder { capped: true, .. });
            is_capped || matches!(shape, Shape::Sphere { .. } | Shape::Ellipsoid { .. } | Shape::Cuboid { .. })
        });
        let made = export.surface(object, is_closed)?;
        shapes.iter().try_for_each(|shape| export.shape(object, shape, made))
    })
}

impl Export<'_> {
    fn shape(&mut self, object: &ObjectDescription, shape: &Shape, made: Made) -> Result<(), ExportError> {
        let key = |triangles| MeshKey { triangles, flip: object.flip, material: made.index, colors: made.colors };
        let (mesh, place) = match (shape, units::unit(shape)) {
            (Shape::Mesh { data, map, .. }, _) => (self.mesh(key(Arc::as_ptr(data) as usize), data, &object.name)?, *map),
            (_, Some((unit, map))) => {
                if let Some(used) = fineness(shape) {
                    self.remark(format!("a shape `{}`", shape.name()), used, "its outline is a polygon");
                }
                let key = key(units::number(&unit));
                let mesh = match self.meshes.get(&key) {
                    Some(mesh) => *mesh,
                    None => self.mesh(key, &of_model(triangles(&unit, DVec3::ZERO).unwrap_or_default()), unit.name())?,
                };
                (mesh, map)
            }
            _ => {
                self.remark("an isosurface", "nothing", "it is missing");
                return Ok(());
            }
        };
        self.node(&object.name, &place, table(json!({ "mesh": mesh })));
        Ok(())
    }

    /// The index of a mesh.
    fn mesh(&mut self, key: MeshKey, data: &MeshData, name: &str) -> Result<usize, ExportError> {
        if let Some(mesh) = self.meshes.get(&key) {
            return Ok(*mesh);
        }
        let Columns { mut attributes, indices } = self.columns(key, data)?;
        if key.colors != VertexColors::None && !data.colours.is_empty() {
            attributes.insert("COLOR_0".to_owned(), json!(self.vertex_colors(key, &data.colours)?));
        }
        let primitive = json!({ "attributes": attributes, "indices": indices, "material": key.material });
        let mut mesh = table(json!({ "primitives": [primitive] }));
        if !name.is_empty() {
            mesh.insert("name".to_owned(), json!(name));
        }
        let mesh = self.document.add("meshes", Value::Object(mesh));
        self.meshes.insert(key, mesh);
        Ok(mesh)
    }

    /// Vertices and triangles.
    fn columns(&mut self, key: MeshKey, data: &MeshData) -> Result<Columns, ExportError> {
        let known = (key.triangles, key.flip);
        if let Some(columns) = self.columns.get(&known) {
            return Ok(columns.clone());
        }
        let mut attributes = Map::new();
        attributes.insert("POSITION".to_owned(), json!(self.document.positions(&data.vertices)?));
        if !data.normals.is_empty() {
            let normals: Vec<[f32; 3]> = data.normals.iter().map(|n| normal(*n, key.flip)).collect();
            attributes.insert("NORMAL".to_owned(), json!(self.document.attribute(&normals)?));
        }
        if !data.uvs.is_empty() {
            // v of glTF points down.
            let uvs: Vec<[f32; 2]> = data.uvs.iter().map(|[u, v]| [*u, 1.0 - *v]).collect();
            attributes.insert("TEXCOORD_0".to_owned(), json!(self.document.attribute(&uvs)?));
        }
        let indices = match key.flip {
            true => self.document.corners(&data.triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect::<Vec<_>>())?,
            false => self.document.corners(&data.triangles)?,
        };
        let columns = Columns { attributes, indices };
        self.columns.insert(known, columns.clone());
        Ok(columns)
    }

    fn vertex_colors(&mut self, key: MeshKey, colors: &[[f32; 4]]) -> Result<usize, ExportError> {
        let has_opacity = key.colors == VertexColors::Rgba;
        let known = (key.triangles, has_opacity);
        if let Some(accessor) = self.vertex_colors.get(&known) {
            return Ok(*accessor);
        }
        let accessor = match has_opacity {
            true => self.document.attribute(colors)?,
            false => self.document.attribute(&colors.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect::<Vec<_>>())?,
        };
        self.vertex_colors.insert(known, accessor);
        Ok(accessor)
    }
}

/// A normal of unit length. One that has it keeps its bits.
fn normal(n: [f32; 3], flip: bool) -> [f32; 3] {
    let n = Vec3::from(n);
    let unit = if (n.length_squared() - 1.0).abs() <= ROUNDING { n } else { n.try_normalize().unwrap_or(n) };
    if flip { (-unit).to_array() } else { unit.to_array() }
}

fn of_model(model: Model) -> MeshData {
    let Model { vertices, triangles, normals, uvs, .. } = model;
    MeshData { vertices, triangles, normals: normals.unwrap_or_default(), uvs: uvs.unwrap_or_default(), ..MeshData::default() }
}
