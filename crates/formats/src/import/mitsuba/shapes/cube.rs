//! Cubes from −1 to 1.
use glam::{DVec3, Vec3};

use super::{
    super::{context::Import, tree::Element},
    Geometry, Placed, meshes,
};
use noisefall_scene::{
    model::Model,
    scene::SceneError,
    shape::{Bounds, cuboid::Cuboid},
};

pub fn cube(import: &mut Import, _: Element, placed: Placed) -> Result<Geometry, SceneError> {
    let shape = if placed.uses.coordinates {
        let path = import.shared_model("cube", "cube", |_| Ok(faces()))?;
        meshes::in_memory(path, false)
    } else {
        Cuboid(Bounds { min: DVec3::NEG_ONE, max: DVec3::ONE }).into()
    };
    Ok(Geometry { shape, map: placed.map, flip: placed.flip })
}

/// Six squares with the coordinates of Mitsuba: each has its normal, the direction of u, and that of v.
const FACES: [[Vec3; 3]; 6] = [
    [Vec3::NEG_Y, Vec3::Z, Vec3::X],
    [Vec3::Y, Vec3::NEG_X, Vec3::NEG_Z],
    [Vec3::X, Vec3::Y, Vec3::NEG_Z],
    [Vec3::Z, Vec3::Y, Vec3::X],
    [Vec3::NEG_X, Vec3::Y, Vec3::Z],
    [Vec3::NEG_Z, Vec3::NEG_Y, Vec3::X],
];

fn faces() -> Model {
    let mut model = Model { uvs: Some(Vec::new()), ..Model::default() };
    for [n, along_u, along_v] in FACES {
        let first = model.vertices.len() as u32;
        for [u, v] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
            model.vertices.push((n + along_u * (2.0 * u - 1.0) + along_v * (2.0 * v - 1.0)).to_array());
            // v of a model runs upwards.
            model.uvs.get_or_insert_default().push([u, 1.0 - v]);
        }
        let is_front = along_u.cross(along_v).dot(n) > 0.0;
        let corners = if is_front { [[0, 1, 2], [0, 2, 3]] } else { [[0, 2, 1], [0, 3, 2]] };
        model.triangles.extend(corners.map(|corners| corners.map(|corner| first + corner)));
    }
    model
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_faces_point_outwards_and_have_the_coordinates_of_mitsuba() {
        let model = faces();
        assert_eq!((model.vertices.len(), model.triangles.len()), (24, 12));
        for triangle in &model.triangles {
            let [a, b, c] = triangle.map(|i| Vec3::from(model.vertices[i as usize]));
            assert!((b - a).cross(c - a).dot(a) > 0.0);
        }
        // Corners of Mitsuba's cube with u and v, which runs downwards.
        let known = [([1.0, -1.0, -1.0], [0.0, 1.0], -Vec3::Y), ([1.0, 1.0, 1.0], [0.0, 0.0], Vec3::Y)];
        let more = [([1.0, 1.0, -1.0], [1.0, 1.0], Vec3::X), ([-1.0, -1.0, 1.0], [0.0, 0.0], Vec3::Z)];
        for (place, [u, v], n) in known.into_iter().chain(more) {
            let face = FACES.iter().position(|[normal, ..]| *normal == n).expect("a face");
            let corner = (4 * face..4 * face + 4).find(|i| model.vertices[*i] == place).expect("a corner");
            assert_eq!(model.uvs.as_ref().map(|uvs| uvs[corner]), Some([u, 1.0 - v]), "{place:?}");
        }
    }
}
