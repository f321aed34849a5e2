//! Ellipsoids and grids of distances.
use std::fs;

use glam::DVec3;

use super::{SENSOR, read_with, remarks, shapes::map};
use crate::import::{ImportOptions, Imported, read};
use noisefall_scene::{model::Model, scene::SceneError};

const HEADER: &str = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n\
    property float nx\nproperty float ny\nproperty float nz\nproperty float opacity\nproperty float scale_0\n\
    property float scale_1\nproperty float scale_2\nproperty float rot_0\nproperty float rot_1\nproperty float rot_2\n\
    property float rot_3\nend_header\n";

fn cloud(lines: &str, within: &str) -> Result<Imported, SceneError> {
    let text = format!(
        "<scene version=\"3.0.0\">{SENSOR}<shape type=\"ellipsoids\"><string name=\"filename\" value=\"a.ply\"/>{within}\
         <transform name=\"to_world\"><scale value=\"2\"/></transform></shape></scene>"
    );
    read_with(&[("a.ply", &format!("{HEADER}{lines}"))], &text, &ImportOptions::default())
}

#[test]
fn ellipsoids_are_spheres_with_transforms() {
    // The second one turns x to y.
    let lines = "1 2 3 0 0 0 1 0 0.6931471805599453 -0.6931471805599453 1 0 0 0\n0 0 0 0 0 0 1 0 0.6931471805599453 0 1 0 0 1\n";
    let imported = cloud(lines, "<float name=\"extent\" value=\"1\"/>").unwrap_or_else(|error| panic!("{}", error.report()));
    let maps: Vec<_> = imported.description.objects.iter().map(map).collect();
    assert_eq!(maps.len(), 2);
    assert!(maps[0].transform_point3(DVec3::Y).abs_diff_eq(2.0 * DVec3::new(1.0, 4.0, 3.0), 1e-5), "{maps:?}");
    assert!(maps[1].transform_point3(DVec3::X).abs_diff_eq(2.0 * DVec3::Y, 1e-5), "{maps:?}");
    assert!(maps[1].transform_point3(DVec3::Y).abs_diff_eq(-4.0 * DVec3::X, 1e-5), "{maps:?}");
    assert!(remarks(&imported)[0].contains("ellipsoids"), "{:?}", remarks(&imported));
    let three = cloud(lines, "").unwrap_or_else(|error| panic!("{}", error.report()));
    assert!(map(&three.description.objects[1]).transform_point3(DVec3::X).abs_diff_eq(6.0 * DVec3::Y, 1e-5));
}

#[test]
fn ellipsoids_without_size_are_refused() {
    let good = "0 0 0 0 0 0 1 0 0 0 1 0 0 0\n";
    for bad in ["0 0 0 0 0 0 1 0 0 0 0 0 0 0\n", "0 0 0 0 0 0 1 0 0 900 1 0 0 0\n", "nan 0 0 0 0 0 1 0 0 0 1 0 0 0\n"] {
        let report = cloud(&format!("{good}{bad}"), "").err().map(|error| error.report()).unwrap_or_default();
        assert!(report.contains("ellipsoid 2 has no size or place"), "{report}");
    }
    assert!(cloud(good, "").is_err(), "one of two is missing");
}

/// A volume of Mitsuba with the values of a plane x = 0.25 in the unit cube.
fn volume() -> Vec<u8> {
    let words = [1_u32, 3, 2, 2, 1].map(u32::to_le_bytes).concat();
    let bounds = [0.0_f32, 0.0, 0.0, 1.0, 1.0, 1.0].map(f32::to_le_bytes).concat();
    let values = [-0.25_f32, 0.25, 0.75].repeat(4).into_iter().flat_map(f32::to_le_bytes).collect();
    [b"VOL\x03".to_vec(), words, bounds, values].concat()
}

fn grid(bytes: &[u8]) -> Result<Imported, SceneError> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scene.xml");
    let text = format!(
        "<scene version=\"3.0.0\">{SENSOR}<shape type=\"sdfgrid\"><string name=\"filename\" value=\"a.vol\"/></shape></scene>"
    );
    fs::write(&path, text).expect("it is written");
    fs::write(folder.path().join("a.vol"), bytes).expect("it is written");
    read(&path, &ImportOptions::default())
}

#[test]
fn a_grid_of_distances_is_a_mesh_that_faces_the_positive_ones() {
    let imported = grid(&volume()).unwrap_or_else(|error| panic!("{}", error.report()));
    let model = imported.assets.get::<Model>("meshes/a.ply").expect("it is a mesh in memory");
    assert!(model.vertices.iter().all(|[x, ..]| (x - 0.25).abs() < 1e-6) && !model.triangles.is_empty());
    assert!(model.normals.iter().flatten().all(|normal| *normal == [1.0, 0.0, 0.0]));
    assert!(remarks(&imported)[0].contains("triangles"));
}

#[test]
fn damaged_grids_are_refused() {
    let good = volume();
    let damaged = |place: usize, byte: u8| {
        let mut bytes = good.clone();
        bytes[place] = byte;
        bytes
    };
    let positive = [&good[..48], &[0; 48]].concat();
    for bytes in [&good[..95], &damaged(0, b'W'), &damaged(4, 2), &damaged(8, 1), &damaged(20, 3), &damaged(51, 0xff), &positive]
    {
        let report = grid(bytes).err().map(|error| error.report()).unwrap_or_default();
        assert!(report.contains("not a grid of distances") || report.contains("nowhere"), "{report}");
    }
}
