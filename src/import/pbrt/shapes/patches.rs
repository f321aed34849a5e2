//! Parts of quadrics, as meshes.
use glam::DVec3;

use super::{Areas, Built};
use crate::{
    import::pbrt::{import::Import, parameters::Entity},
    model::Model,
    scene::SceneError,
};

/// Columns and rows of a patch.
const COLUMNS: u32 = 128;
const ROWS: u32 = 64;

impl Import {
    /// A mesh over the unit square of u and v, from points and unit normals.
    pub(super) fn patch(
        &mut self,
        entity: &Entity,
        name: &str,
        surface: impl Fn(f64, f64) -> (DVec3, DVec3),
    ) -> Result<Built, SceneError> {
        let (mut vertices, mut normals, mut uvs) = (Vec::new(), Vec::new(), Vec::new());
        for row in 0..=ROWS {
            for column in 0..=COLUMNS {
                let (u, v) = (f64::from(column) / f64::from(COLUMNS), f64::from(row) / f64::from(ROWS));
                let (point, normal) = surface(u, v);
                vertices.push(point.as_vec3().to_array());
                normals.push(normal.as_vec3().to_array());
                uvs.push([u as f32, v as f32]);
            }
        }
        let mut triangles = Vec::new();
        for row in 0..ROWS {
            for column in 0..COLUMNS {
                let corner = row * (COLUMNS + 1) + column;
                let above = corner + COLUMNS + 1;
                triangles.extend([[corner, corner + 1, above + 1], [corner, above + 1, above]]);
            }
        }
        let mut model = Model { vertices, triangles, normals: Some(normals), uvs: Some(uvs), colours: None };
        super::meshes::face_normals(&mut model);
        if model.vertices.iter().flatten().any(|x| !x.is_finite()) {
            return Err(entity.error("the shape is too large", "its coordinates must be finite in single precision"));
        }
        self.remark(entity, "a mesh of 16384 triangles", "its outline is a polygon");
        let path = self.new_files.add_model(name, model);
        Ok(Built::mesh(name, path, true, Areas::Unknown))
    }
}
