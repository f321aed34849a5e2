//! Tangents of meshes that have none of their own.
//!
//! As glTF asks, they are those of MikkTSpace: directions in which u grows on the triangles around a vertex, weighted by their angles there.
//! MikkTSpace divides a vertex between triangles whose coordinates are mirrored and triangles whose are not. Such a vertex gets no
//! tangent here: each of its triangles has its own.
use glam::{Vec2, Vec3};

use noisefall_scene::model::Model;

/// A tangent for each vertex; `None` for meshes without normals or coordinates, whose triangles have their own.
pub fn averaged(model: &Model) -> Option<Vec<[f32; 4]>> {
    let (normals, uvs) = model.normals.as_ref().zip(model.uvs.as_ref())?;
    let mut sums = vec![Vec3::ZERO; model.vertices.len()];
    let mut hands = vec![[false; 2]; model.vertices.len()];
    for triangle in &model.triangles {
        let corners = triangle.map(|vertex| Vec3::from(model.vertices[vertex as usize]));
        let places = triangle.map(|vertex| Vec2::from(uvs[vertex as usize]));
        let Some((along, is_mirrored)) = direction(&corners, &places) else { continue };
        for (corner, vertex) in triangle.iter().map(|vertex| *vertex as usize).enumerate() {
            let sides = [1, 2].map(|step| corners[(corner + step) % 3] - corners[corner]);
            let angle = sides[0].cross(sides[1]).length().atan2(sides[0].dot(sides[1]));
            let normal = Vec3::from(normals[vertex]);
            sums[vertex] += angle * (along - normal * normal.dot(along)).normalize_or_zero();
            hands[vertex][usize::from(is_mirrored)] = true;
        }
    }
    let tangent = |(sum, hands): (Vec3, [bool; 2])| match hands {
        [true, false] => sum.normalize_or_zero().extend(1.0).to_array(),
        [false, true] => sum.normalize_or_zero().extend(-1.0).to_array(),
        _ => [0.0; 4],
    };
    Some(sums.into_iter().zip(hands).map(tangent).collect())
}

/// The unit direction in which u grows on a triangle, and whether its coordinates are mirrored. `None` without an area in u and v.
fn direction([a, b, c]: &[Vec3; 3], [ta, tb, tc]: &[Vec2; 3]) -> Option<(Vec3, bool)> {
    let ([ab, ac], [tab, tac]) = ([b - a, c - a], [tb - ta, tc - ta]);
    let area = tab.perp_dot(tac);
    let along = (ab * tac.y - ac * tab.y).try_normalize().filter(|_| area != 0.0)?;
    Some((along * area.signum(), area < 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles over the square from (−1, 0) to (1, 1), folded at x = 0: u is |x|.
    fn folded() -> Model {
        Model {
            vertices: vec![[-1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
            triangles: vec![[0, 1, 2], [1, 3, 2]],
            normals: Some(vec![[0.0, 0.0, 1.0]; 4]),
            uvs: Some(vec![[1.0, 0.0], [0.0, 0.0], [0.0, 1.0], [1.0, 0.0]]),
            ..Model::default()
        }
    }

    #[test]
    fn mirrored_coordinates_turn_the_tangent_and_its_hand() {
        let found = averaged(&folded()).expect("it has normals and coordinates");
        assert_eq!((found[0], found[3]), ([-1.0, 0.0, 0.0, -1.0], [1.0, 0.0, 0.0, 1.0]));
        assert_eq!(found[1], [0.0; 4], "between both hands there is none");
        assert_eq!(averaged(&Model { normals: None, ..folded() }), None);
        assert_eq!(averaged(&Model { uvs: None, ..folded() }), None);
    }

    #[test]
    fn tangents_lie_in_the_surface_and_are_finite() {
        let slanted = Vec3::new(1.0, 0.0, 1.0).normalize().to_array();
        let model = Model { normals: Some(vec![slanted, [0.0; 3], slanted, slanted]), ..folded() };
        let found = averaged(&model).expect("it has normals and coordinates");
        for (tangent, normal) in found.iter().zip(model.normals.as_ref().expect("normals")) {
            let t = Vec3::from_slice(tangent);
            assert!(t.is_finite() && t.dot(Vec3::from(*normal)).abs() < 1e-6, "{tangent:?}");
        }
        let flat = Model { uvs: Some(vec![[0.5; 2]; 4]), ..folded() };
        assert_eq!(averaged(&flat), Some(vec![[0.0; 4]; 4]), "coordinates of one point have no direction");
    }
}
