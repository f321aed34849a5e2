//! Parts of quadrics, as meshes.
use glam::DVec3;

use super::{Areas, Built};
use crate::import::pbrt::{import::Import, parameters::Entity};
use noisefall_scene::{model::Model, scene::SceneError};

/// Columns and rows of a patch.
const FINE: [u32; 2] = [128, 64];
/// Number of patches after which further ones are coarse, and their columns and rows: a line of text must not take much memory.
const MANY: usize = 200;
const COARSE: [u32; 2] = [16, 8];

impl Import {
    /// A mesh over the unit square of u and v, from points and unit normals.
    pub(super) fn patch(
        &mut self,
        entity: &Entity,
        name: &str,
        surface: impl Fn(f64, f64) -> (DVec3, DVec3),
    ) -> Result<Built, SceneError> {
        self.patches += 1;
        let [columns, rows] = if self.patches > MANY { COARSE } else { FINE };
        let (mut vertices, mut normals, mut uvs) = (Vec::new(), Vec::new(), Vec::new());
        for row in 0..=rows {
            for column in 0..=columns {
                let (u, v) = (f64::from(column) / f64::from(columns), f64::from(row) / f64::from(rows));
                let (point, normal) = surface(u, v);
                vertices.push(point.as_vec3().to_array());
                normals.push(normal.as_vec3().to_array());
                uvs.push([u as f32, v as f32]);
            }
        }
        let mut triangles = Vec::new();
        for row in 0..rows {
            for column in 0..columns {
                let corner = row * (columns + 1) + column;
                let above = corner + columns + 1;
                triangles.extend([[corner, corner + 1, above + 1], [corner, above + 1, above]]);
            }
        }
        let mut model = Model { vertices, triangles, normals: Some(normals), uvs: Some(uvs), ..Model::default() };
        super::meshes::face_normals(&mut model);
        if model.vertices.iter().flatten().any(|x| !x.is_finite()) {
            return Err(entity.error("the shape is too large", "its coordinates must be finite in single precision"));
        }
        self.remark(entity, &format!("a mesh of {} triangles", 2 * columns * rows), "its outline is a polygon");
        let path = self.new_files.add_model(name, model);
        Ok(Built::mesh(name, path, true, Areas::Unknown))
    }
}
