//! Curves.
use std::sync::Arc;

use glam::Vec3;

use super::{read_with, shapes::map};
use crate::import::{ImportOptions, Imported};
use noisefall_scene::{model::Model, scene::SceneError};

const POINTS: &str = "-1 0 0 0.5\n1 0 0 0.25\r\n3 1 0 0.25\n4 2 0 0.25\n\n\n0 5 0 1\n0 6 0 1\n0 7 0 1\n0 8 0 1\n";

fn read(kind: &str, points: &str, steps: &str) -> Result<Imported, SceneError> {
    let text = format!(
        "<scene version=\"3.0.0\"><shape type=\"shapegroup\" id=\"g\"><shape type=\"{kind}\"><string name=\"filename\" \
         value=\"a.txt\"/><transform name=\"to_world\">{steps}</transform></shape></shape><shape type=\"instance\"><ref id=\"g\"/>\
         <transform name=\"to_world\"><translate x=\"9\"/></transform></shape></scene>"
    );
    read_with(&[("a.txt", points)], &text, &ImportOptions::default())
}

fn model(imported: &Imported) -> Arc<Model> {
    imported.assets.get::<Model>("meshes/a.ply").expect("it is a mesh in memory")
}

fn read_model(kind: &str, points: &str, steps: &str) -> Imported {
    read(kind, points, steps).unwrap_or_else(|error| panic!("{}", error.report()))
}

/// The least and the largest coordinates.
fn bounds(model: &Model) -> [Vec3; 2] {
    let vertices = || model.vertices.iter().map(|vertex| Vec3::from(*vertex));
    [vertices().reduce(Vec3::min), vertices().reduce(Vec3::max)].map(|corner| corner.expect("there are vertices"))
}

#[test]
fn lines_are_cones_between_balls_that_touch_them() {
    let imported = read_model("linearcurve", POINTS, "");
    let model = model(&imported);
    // Eight balls and six cones.
    assert_eq!(model.vertices.len(), (8 * 25 + 6 * 2) * 49);
    let [least, most] = bounds(&model);
    assert!(least.abs_diff_eq(Vec3::new(-1.5, -0.5, -1.0), 1e-3) && most.abs_diff_eq(Vec3::new(4.25, 9.0, 1.0), 1e-3));
    // The first cone: its normals lean by the sine of 0.25 / 2, and both ends lie on the balls.
    let normals = model.normals.as_ref().expect("it is smooth");
    let first = 4 * 25 * 49;
    let cone = model.vertices[first..].iter().zip(&normals[first..]).take(2 * 49);
    for (vertex, (at, normal)) in cone.enumerate() {
        let (at, normal) = (Vec3::from(*at), Vec3::from(*normal));
        assert!((normal.x - 0.125).abs() < 1e-6, "{normal}");
        let (center, radius) = if vertex < 49 { (-Vec3::X, 0.5) } else { (Vec3::X, 0.25) };
        assert!(((at - center).length() - radius).abs() < 1e-6);
    }
    let remarks = imported.remarks.lines(9);
    assert_eq!(remarks.iter().filter(|line| line.contains("a mesh with 48 sides")).count(), 1, "{remarks:?}");
}

#[test]
fn splines_are_tubes_and_v_runs_along_all_of_them() {
    let imported = read_model("bsplinecurve", POINTS, "");
    let model = model(&imported);
    assert_eq!(model.vertices.len(), 2 * 17 * 49);
    // Ends of a uniform spline: (p₀ + 4 p₁ + p₂) / 6. The second curve is straight.
    let [least, most] = bounds(&model);
    assert!((most.y - 7.0).abs() < 1e-5 && (least.x - -1.0).abs() < 1e-5, "{least} {most}");
    let uvs = model.uvs.as_ref().expect("it has coordinates");
    assert_eq!([0, 16 * 49, 17 * 49, 33 * 49].map(|vertex| uvs[vertex][1]), [1.0, 0.5, 0.5, 0.0]);
    assert_eq!([0, 48].map(|vertex| uvs[vertex][0]), [0.0, 1.0]);
}

#[test]
fn a_transform_moves_points_and_keeps_radii() {
    let straight = "0 0 0 0.5\n0 0 1 0.5\n0 0 2 0.5\n0 0 3 0.5\n";
    let imported = read_model("bsplinecurve", straight, "<scale value=\"10\"/>");
    let [least, most] = bounds(&model(&imported));
    assert!(least.abs_diff_eq(Vec3::new(-0.5, -0.5, 10.0), 1e-5) && most.abs_diff_eq(Vec3::new(0.5, 0.5, 20.0), 1e-5));
    let object = &imported.description.objects[0];
    assert_eq!(map(object).translation.x, 9.0, "an instance moves the whole mesh");
}

#[test]
fn many_curves_have_fewer_sides() {
    let line = |i: usize| format!("{i} 0 0 1\n");
    let points: String = (0..40_000).map(line).collect();
    let imported = read_model("bsplinecurve", &points, "");
    assert!(model(&imported).vertices.len() <= 1 << 20);
    assert_eq!(model(&imported).vertices.len(), (39_997 * 2 + 1) * 9);
    let error = read("linearcurve", &(0..200_000).map(line).collect::<String>(), "").map(drop);
    assert!(error.is_err_and(|error| error.report().contains("more than 1048576 vertices")));
}

#[test]
fn files_that_are_no_curves_are_refused() {
    let refused = |points: &str| match read("bsplinecurve", points, "") {
        Ok(_) => panic!("{points} is read"),
        Err(error) => error.report(),
    };
    assert!(refused("0 0 0 1\n1 0 0 1\n2 0 0 1\n").contains("a curve has 3 control points, and needs 4"));
    assert!(refused("\n\n").contains("there are no control points"));
    for line in ["1 2 3", "1 2 3 4 5", "1 2 3 -1", "1 2 nan 1", "1 2 inf 1", "a b c d", "1e31 0 0 1"] {
        assert!(refused(&format!("0 0 0 1\n{line}\n")).contains("line 2 is not x y z radius"), "{line}");
    }
}
