//! Smooth normals.
use glam::Vec3;

use super::super::{smooth_normals, turn_normals};

fn assert_near(normals: &[[f32; 3]], expected: &[[f32; 3]]) {
    let is_near = |(a, b): (&[f32; 3], &[f32; 3])| Vec3::from(*a).distance(Vec3::from(*b)) < 1e-6;
    assert!(normals.len() == expected.len() && normals.iter().zip(expected).all(is_near), "{normals:?}, not {expected:?}");
}

const CUBE: [[f32; 3]; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [1.0, 1.0, 1.0],
];
const FACES: [[u32; 4]; 6] = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

fn cube_normals() -> [[f32; 3]; 8] {
    CUBE.map(|vertex| Vec3::from(vertex).normalize().to_array())
}

#[test]
fn only_normals_that_contradict_all_their_triangles_are_turned() {
    let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    let mut normals = [[0.0, 0.0, -1.0]; 4];
    turn_normals(&vertices, &mut normals, &[[0, 1, 2], [3, 1, 2]]);
    assert_eq!(normals.map(|n| n[2]), [1.0, -1.0, -1.0, -1.0], "the second triangle agrees with its normals");
}

#[test]
fn a_cube_is_symmetric_however_its_faces_are_cut() {
    for cuts in 0..64 {
        let cut = |(face, [a, b, c, d]): (usize, [u32; 4])| {
            if cuts >> face & 1 == 0 { [[a, b, c], [a, c, d]] } else { [[b, c, d], [b, d, a]] }
        };
        let triangles: Vec<[u32; 3]> = FACES.into_iter().enumerate().flat_map(cut).collect();
        assert_near(&smooth_normals(&CUBE, &triangles), &cube_normals());
    }
}

#[test]
fn vertices_in_one_place_share_a_normal() {
    let corners = FACES.as_flattened();
    let vertices: Vec<[f32; 3]> = corners.iter().map(|corner| CUBE[*corner as usize]).collect();
    let triangles: Vec<[u32; 3]> = (0..6).flat_map(|face| [[0, 1, 2], [0, 2, 3]].map(|t| t.map(|i| 4 * face + i))).collect();
    let expected: Vec<[f32; 3]> = corners.iter().map(|corner| cube_normals()[*corner as usize]).collect();
    assert_near(&smooth_normals(&vertices, &triangles), &expected);
    let zeros = smooth_normals(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-0.0; 3]], &[[0, 1, 2]]);
    assert_near(&zeros, &[[0.0, 0.0, 1.0]; 4]);
}

#[test]
fn angles_are_the_weights_at_any_size() {
    // At the origin a right angle towards +z and one of 45° towards −y.
    let vertices = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 1.0, 0.0], [5.0, 0.0, 5.0]];
    let expected = Vec3::new(0.0, -1.0, 2.0).normalize().to_array();
    for size in [1e-37, 1e-20, 1.0, 1e20, 1e37] {
        let vertices = vertices.map(|vertex| vertex.map(|x: f32| x * size));
        let normals = smooth_normals(&vertices, &[[0, 1, 2], [0, 1, 3]]);
        assert_near(&normals[..1], &[expected]);
    }
}

#[test]
fn both_sides_of_a_sheet_have_the_normal_of_one() {
    let vertices = [[0.1, 0.2, 0.3], [0.7, 0.1, 0.2], [0.3, 0.9, 0.4]];
    let one = smooth_normals(&vertices, &[[0, 1, 2]]);
    assert_near(&smooth_normals(&vertices, &[[0, 1, 2], [2, 1, 0]]), &one);
}

#[test]
fn a_vertex_without_a_surface_points_up() {
    let vertices = [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [2.0, 2.0, 2.0], [9.0, 9.0, 9.0]];
    assert_eq!(smooth_normals(&vertices, &[[0, 1, 2], [0, 0, 1]]), [[0.0, 1.0, 0.0]; 4]);
}

/// Three normals at 120° whose sum is rounding: the vertices are those of f32.
#[test]
fn normals_that_cancel_but_for_rounding_are_replaced_by_the_first() {
    let (half, high) = (-0.5, 0.75f32.sqrt());
    let vertices = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [half, high, 0.0], [1.0, 0.0, 0.0], [half, -high, 0.0]];
    let normals = smooth_normals(&vertices, &[[0, 1, 2], [0, 1, 3], [0, 1, 4]]);
    assert_near(&normals[..1], &[[-high, half, 0.0]]);
}
