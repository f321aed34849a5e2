//! Meshes in the text of the scene.
use glam::Vec3;

use super::{Areas, Built};
use crate::import::pbrt::{import::Import, parameters::Entity};
use noisefall_base::memory::reserve;
use noisefall_scene::{
    model::{Model, turn_triangles},
    scene::SceneError,
};

/// Steps along each side of a bilinear patch that is not flat.
const STEPS: u32 = 8;
/// Steps along each side where there are many patches.
const FEW_STEPS: u32 = 2;
const MANY: usize = 4096;
/// A patch whose fourth corner is off the plane of the others by more than this part of its size is not flat.
const FLATNESS: f32 = 1e-4;

impl Import {
    pub(super) fn triangle_mesh(&mut self, entity: &Entity) -> Result<Option<Built>, SceneError> {
        let mut model = vertices(entity, 3)?;
        let indices = indices(entity, 3, model.vertices.len())?;
        model.triangles = indices.chunks_exact(3).map(|corners| [corners[0], corners[1], corners[2]]).collect();
        entity.ignore(&["faceIndices", "S"]);
        Ok(self.mesh("trianglemesh", model, 1))
    }

    pub(super) fn bilinear_mesh(&mut self, entity: &Entity) -> Result<Option<Built>, SceneError> {
        let corners = vertices(entity, 4)?;
        let patches = indices(entity, 4, corners.vertices.len())?;
        entity.ignore(&["faceIndices"]);
        let patches: Vec<[u32; 4]> = patches.chunks_exact(4).map(|p| [p[0], p[1], p[2], p[3]]).collect();
        let is_flat = patches.iter().all(|patch| is_flat(patch.map(|i| Vec3::from(corners.vertices[i as usize]))));
        let fine = 2 * u64::from(STEPS * STEPS) * patches.len() as u64;
        let steps = match patches.len() {
            _ if is_flat => 1,
            0..=MANY if self.files.folder.budget.make(fine) => STEPS,
            _ => FEW_STEPS,
        };
        // A patch without coordinates spans the unit square, so that its corners are its own.
        let room = reserve("vertices of bilinear patches", patches.len() as u64 * u64::from(steps + 1).pow(2) * 64);
        let _room = room.map_err(|error| entity.error(error.to_string(), "too much memory"))?;
        if !is_flat {
            self.remark(entity, &format!("{steps} × {steps} quads per patch"), "curved patches have flat pieces");
        }
        let mut model = Model { normals: corners.normals.is_some().then(Vec::new), uvs: Some(Vec::new()), ..Model::default() };
        for patch in patches {
            add_patch(&mut model, &corners, patch, steps);
        }
        Ok(self.mesh("bilinearmesh", model, 2 * (steps * steps) as usize))
    }

    /// A mesh that exists in memory only; `None` if it is empty. `each` triangles are a face of the file.
    pub(super) fn mesh(&mut self, name: &str, mut model: Model, each: usize) -> Option<Built> {
        if model.triangles.is_empty() {
            return None;
        }
        face_normals(&mut model);
        let smooth = model.normals.is_some();
        const FEW: usize = 4096;
        let corner = |i: u32| model.vertices[i as usize];
        let areas = match model.triangles.len() {
            0..=FEW => Areas::Faces { triangles: model.triangles.iter().map(|triangle| triangle.map(corner)).collect(), each },
            _ => Areas::Unknown,
        };
        let path = self.new_files.add_model(name, model);
        Some(Built::mesh(name, path, smooth, areas))
    }
}

/// Turns triangles so that their fronts are on the side of their normals, which decide in pbrt.
pub fn face_normals(model: &mut Model) {
    if let Some(normals) = &model.normals {
        turn_triangles(&model.vertices, normals, &mut model.triangles);
    }
}

/// Positions, normals and coordinates of a mesh. `corners` of a face: without indices there is one face.
fn vertices(entity: &Entity, corners: usize) -> Result<Model, SceneError> {
    let vertices = triples(entity, "P")?;
    if vertices.len() < corners {
        return Err(entity.error(format!("the mesh has {} vertices", vertices.len()), "`point3 P` holds the positions"));
    }
    let count = vertices.len();
    let normals = Some(triples(entity, "N")?).filter(|normals| !normals.is_empty());
    // pbrt-v3 has another name, too.
    let uvs = entity
        .list(entity.named(&["uv", "st"]))
        .map(|numbers| numbers.chunks_exact(2).map(|uv| [uv[0] as f32, uv[1] as f32]).collect::<Vec<_>>());
    let uvs = uvs.filter(|uvs| !uvs.is_empty());
    for (name, length) in [("N", normals.as_ref().map(Vec::len)), ("uv", uvs.as_ref().map(Vec::len))] {
        if length.is_some_and(|length| length != count) {
            return Err(entity.error(format!("`{name}` has another length than `P`"), format!("there are {count} vertices")));
        }
    }
    Ok(Model { vertices, normals, uvs, ..Model::default() })
}

pub(super) fn triples(entity: &Entity, name: &str) -> Result<Vec<[f32; 3]>, SceneError> {
    let found: Vec<[f32; 3]> =
        entity.list(name).unwrap_or_default().chunks_exact(3).map(|xyz| [xyz[0] as f32, xyz[1] as f32, xyz[2] as f32]).collect();
    if found.iter().flatten().any(|x| !x.is_finite()) {
        return Err(entity.error(format!("a number of `{name}` is too large"), "it must be finite in single precision"));
    }
    Ok(found)
}

pub(super) fn indices(entity: &Entity, corners: usize, vertices: usize) -> Result<Vec<u32>, SceneError> {
    let Some(numbers) = entity.list("indices") else {
        if vertices == corners {
            return Ok((0..corners as u32).collect());
        }
        return Err(entity.error("the mesh has no indices", "`integer indices` holds the vertices of its faces"));
    };
    if !numbers.len().is_multiple_of(corners) {
        return Err(entity.error(format!("there are {} indices", numbers.len()), format!("each face has {corners}")));
    }
    let index = |number: &f64| (*number >= 0.0 && *number < vertices as f64).then_some(*number as u32);
    let wrong =
        |number: &f64| entity.error(format!("there is no vertex {number}"), format!("there are {vertices}, counted from 0"));
    numbers.iter().map(|number| index(number).ok_or_else(|| wrong(number))).collect()
}

fn is_flat([p00, p10, p01, p11]: [Vec3; 4]) -> bool {
    let normal = (p10 - p00).cross(p01 - p00);
    let size = (p10 - p00).length().max((p01 - p00).length());
    let diagonal = p11 - (p10 + p01 - p00);
    // Coordinates are bilinear: only parallelograms have them on two triangles.
    normal.length() == 0.0 || diagonal.length() <= FLATNESS * size
}

fn add_patch(model: &mut Model, corners: &Model, patch: [u32; 4], steps: u32) {
    let first = model.vertices.len() as u32;
    let at = |values: &[[f32; 3]], u: f32, v: f32| {
        let [a, b, c, d] = patch.map(|i| Vec3::from(values[i as usize]));
        a.lerp(b, u).lerp(c.lerp(d, u), v)
    };
    for row in 0..=steps {
        for column in 0..=steps {
            let (u, v) = (column as f32 / steps as f32, row as f32 / steps as f32);
            model.vertices.push(at(&corners.vertices, u, v).to_array());
            if let (Some(normals), Some(known)) = (&mut model.normals, &corners.normals) {
                normals.push(at(known, u, v).normalize_or_zero().to_array());
            }
            let uv = match &corners.uvs {
                Some(uvs) => {
                    let [a, b, c, d] = patch.map(|i| glam::Vec2::from(uvs[i as usize]));
                    a.lerp(b, u).lerp(c.lerp(d, u), v).to_array()
                }
                None => [u, v],
            };
            model.uvs.get_or_insert_default().push(uv);
        }
    }
    let index = |column: u32, row: u32| first + row * (steps + 1) + column;
    for row in 0..steps {
        for column in 0..steps {
            let [a, b, c, d] = [index(column, row), index(column + 1, row), index(column, row + 1), index(column + 1, row + 1)];
            model.triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
}
