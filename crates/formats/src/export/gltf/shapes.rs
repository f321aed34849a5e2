//! Objects: meshes, and the nodes that show them.
use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3, Vec3};
use serde_json::{Map, Value, json};

use super::{
    super::{
        ExportError,
        geometry::{fineness, triangles},
        notes,
    },
    context::{Export, table},
    known::{Columns, Made, MeshKey, Triangles, VertexColors},
    units,
};
use noisefall_scene::{
    geometry::{MeshData, Shape},
    model::Model,
    scene::description::ObjectDescription,
};

/// Error of the square of a normal's length, and of the cosine of a right angle, that counts as rounding.
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
        let unit = units::unit(shape);
        let (triangles, name, map) = match (shape, &unit) {
            (Shape::Mesh { data, map, .. }, _) => {
                if made.uses_coordinates && data.uvs.is_empty() {
                    self.remark("textures of a mesh without coordinates", "their factors", "the surface has one colour");
                }
                (Triangles::Mesh(Arc::as_ptr(data) as usize), object.name.as_str(), map)
            }
            (_, Some((unit, map))) => {
                if let Some(used) = fineness(shape) {
                    self.remark(format!("a shape `{}`", shape.name()), used, "its outline is a polygon");
                }
                (Triangles::Unit(units::number(unit)), unit.name(), map)
            }
            _ => {
                self.remark("an isosurface", "nothing", "it is missing");
                return Ok(());
            }
        };
        let data = || match (shape, &unit) {
            (_, Some((unit, _))) => Arc::new(tessellated(unit)),
            (Shape::Mesh { data, .. }, _) => data.clone(),
            _ => Arc::default(),
        };
        let key = |triangles| MeshKey { triangles, flip: object.flip, material: made.index, colors: made.colors };
        let (mesh, place) = match is_sheared(&map.matrix3) {
            false => (self.mesh(key(triangles), name, data)?, *map),
            // The format has no such matrices.
            true => {
                self.sheared += 1;
                let linear = DAffine3 { translation: DVec3::ZERO, ..*map };
                let mesh = self
                    .mesh(key(Triangles::Sheared(self.sheared)), name, || Arc::new(data().transformed(&linear).into_owned()))?;
                (mesh, DAffine3::from_translation(map.translation))
            }
        };
        self.node(&object.name, &place, table(json!({ "mesh": mesh })));
        Ok(())
    }

    /// The index of a mesh.
    fn mesh(&mut self, key: MeshKey, name: &str, data: impl FnOnce() -> Arc<MeshData>) -> Result<usize, ExportError> {
        if let Some(mesh) = self.meshes.get(&key) {
            return Ok(*mesh);
        }
        let data = data();
        let Columns { mut attributes, indices } = self.columns(key, &data)?;
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
        if !data.tangents.is_empty() && !data.normals.is_empty() {
            let tangents: Vec<[f32; 4]> = data.tangents.iter().map(|t| tangent(*t)).collect();
            attributes.insert("TANGENT".to_owned(), json!(self.document.attribute(&tangents)?));
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

/// A tangent of unit length, and its handedness.
fn tangent([x, y, z, w]: [f32; 4]) -> [f32; 4] {
    let [x, y, z] = normal([x, y, z], false);
    [x, y, z, 1f32.copysign(w)]
}

/// Whether a map is more than a scale, a rotation and a mirror.
fn is_sheared(map: &DMat3) -> bool {
    let [x, y, z] = [map.x_axis, map.y_axis, map.z_axis].map(DVec3::normalize_or_zero);
    [x.dot(y), y.dot(z), z.dot(x)].iter().any(|cosine| cosine.abs() > f64::from(ROUNDING))
}

/// The triangles of a unit shape.
fn tessellated(unit: &Shape) -> MeshData {
    let Model { vertices, triangles, normals, uvs, .. } = triangles(unit, DVec3::ZERO).unwrap_or_default();
    let (normals, uvs) = (normals.unwrap_or_default(), uvs.unwrap_or_default());
    MeshData { vertices, triangles, normals, uvs, ..MeshData::default() }
}
