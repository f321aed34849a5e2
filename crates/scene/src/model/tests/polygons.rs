//! Polygons that are not convex.
use std::fmt::Write;

use glam::Vec3;
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{super::Model, model};

/// An OBJ file with one polygon.
fn polygon(points: &[[f32; 3]]) -> Model {
    let mut text = String::new();
    points.iter().for_each(|[x, y, z]| writeln!(text, "v {x} {y} {z}").expect("text grows"));
    text += "f";
    (1..=points.len()).for_each(|corner| write!(text, " {corner}").expect("text grows"));
    model(text.as_bytes())
}

/// Twice the area of each triangle, with its direction.
fn areas(model: &Model) -> Vec<Vec3> {
    let area = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|vertex| Vec3::from(model.vertices[vertex as usize]));
        (b - a).cross(c - a)
    };
    model.triangles.iter().map(area).collect()
}

/// Checks that the triangles cover a polygon without overlap: none is reversed, and their areas sum to that of the polygon.
fn covers(model: &Model, corners: usize) {
    let areas = areas(model);
    let whole: Vec3 = areas.iter().sum();
    assert_eq!(areas.len(), corners - 2);
    assert!(areas.iter().all(|area| area.dot(whole) >= -1e-5 * whole.length_squared()), "{areas:?}");
    let sum: f32 = areas.iter().map(|area| area.length()).sum();
    assert!((sum / whole.length() - 1.0).abs() < 1e-4, "{sum} {whole}");
}

#[test]
fn an_arrow_is_cut_on_either_side_of_its_notch() {
    // The notch is the third corner.
    let arrow = [[0.0, 0.0, 0.0], [2.0, -1.0, 0.0], [1.0, 0.0, 0.0], [2.0, 1.0, 0.0]];
    // All of it can be seen from the first corner: the fan stays.
    assert_eq!(polygon(&arrow).triangles, [[0, 1, 2], [0, 2, 3]]);
    let turned = [arrow[1], arrow[2], arrow[3], arrow[0]];
    assert_eq!(polygon(&turned).triangles, [[1, 2, 3], [0, 1, 3]]);
    covers(&polygon(&turned), 4);
}

#[test]
fn stars_and_combs_are_covered_in_any_plane() {
    let mut random = SmallRng::seed_from_u64(7);
    for case in 0..200 {
        let corners = random.random_range(4..60);
        let mut star: Vec<Vec3> = (0..corners)
            .map(|corner| {
                let angle = corner as f32 / corners as f32 * std::f32::consts::TAU;
                Vec3::new(angle.cos(), angle.sin(), 0.0) * random.random_range(0.3..2.0)
            })
            .collect();
        if case % 2 == 0 {
            // A comb: teeth along a line, and back above them.
            star = (0..corners).map(|i| Vec3::new(i as f32, if i % 2 == 0 { 0.0 } else { 5.0 }, 0.0)).collect();
            star.push(Vec3::new(corners as f32, 9.0, 0.0));
            star.push(Vec3::new(-1.0, 9.0, 0.0));
        }
        let axis = Vec3::new(random.random(), random.random(), random.random::<f32>() + 0.1).normalize();
        let turn = glam::Quat::from_axis_angle(axis, random.random_range(0.0..6.0));
        let start = random.random_range(0..star.len());
        star.rotate_left(start);
        let points: Vec<[f32; 3]> = star.iter().map(|point| (turn * *point).to_array()).collect();
        covers(&polygon(&points), points.len());
    }
}

#[test]
fn a_hole_at_the_end_of_a_seam_stays_open() {
    let outer = [[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0], [0.0, 0.0]];
    let inner = [[1.0, 1.0], [1.0, 2.0], [2.0, 2.0], [2.0, 1.0], [1.0, 1.0]];
    let points: Vec<[f32; 3]> = outer.iter().chain(&inner).map(|[x, y]| [*x, *y, 0.0]).collect();
    let model = polygon(&points);
    covers(&model, points.len());
    let area: f32 = areas(&model).iter().map(|area| area.length() / 2.0).sum();
    assert!((area - 8.0).abs() < 1e-4, "{area}");
}

#[test]
fn polygons_without_area_and_those_that_cross_themselves_are_read() {
    let bow = [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-3.0, 0.5, 0.0]];
    assert_eq!(polygon(&bow).triangles.len(), 3);
    assert_eq!(polygon(&[[1.0; 3]; 6]).triangles, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]);
}

#[test]
fn polygons_of_very_many_corners_stay_fans() {
    let corners = 300_000;
    let zigzag: Vec<[f32; 3]> = (0..corners).map(|i| [i as f32, if i % 2 == 0 { 0.0 } else { 5.0 }, 0.0]).collect();
    assert_eq!(polygon(&zigzag).triangles[corners - 3], [0, corners as u32 - 2, corners as u32 - 1]);
}
