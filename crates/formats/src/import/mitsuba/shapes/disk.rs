//! Disks.
use std::f32::consts::TAU;

use glam::DVec3;

use super::{
    super::{context::Import, tree::Element},
    Geometry, Placed, meshes,
};
use noisefall_scene::{model::Model, scene::SceneError, shape::disk::Disk};

/// Triangles of a disk with a texture.
const SECTORS: u32 = 512;

pub fn disk(import: &mut Import, element: Element, placed: Placed) -> Result<Geometry, SceneError> {
    if !placed.uses.coordinates {
        let shape = Disk { center: DVec3::ZERO, normal: DVec3::Z, radius: 1.0 };
        return Ok(Geometry { shape: shape.into(), map: placed.map, flip: placed.flip });
    }
    import.remark(element, "512 triangles", "its edge is 0.01 % of the radius away from a circle");
    let path = import.shared_model("disk", "disk", |_| Ok(sectors()))?;
    Ok(Geometry { shape: meshes::in_memory(path, false), map: placed.map, flip: placed.flip })
}

/// A fan. u is the distance from the centre, and v the angle, in turns. Green of a normal map tilts along n × ∂p/∂u as everywhere in
/// Mitsuba, and so against the image, whose v runs around clockwise.
fn sectors() -> Model {
    let mut model = Model { uvs: Some(Vec::new()), ..Model::default() };
    let mut corner = |radius: f32, turns: f32| {
        let (sin, cos) = (turns * TAU).sin_cos();
        model.vertices.push([radius * cos, radius * sin, 0.0]);
        // v of a model runs upwards.
        model.uvs.get_or_insert_default().push([radius, 1.0 - turns]);
        model.tangents.get_or_insert_default().push([cos, sin, 0.0, 1.0]);
    };
    for sector in 0..SECTORS {
        let turns = |part: f32| (sector as f32 + part) / SECTORS as f32;
        corner(0.0, turns(0.5));
        corner(1.0, turns(0.0));
        corner(1.0, turns(1.0));
    }
    model.triangles = (0..SECTORS).map(|sector| [3 * sector, 3 * sector + 1, 3 * sector + 2]).collect();
    model
}
