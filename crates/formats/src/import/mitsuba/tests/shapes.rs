//! Shapes and instances.
use glam::{DAffine3, DVec3};

use super::{SENSOR, object, read_with, refused, scene};
use crate::import::ImportOptions;
use noisefall_scene::{
    model::Model,
    scene::description::{ObjectDescription, TextureKind},
    shape::{ShapeKind, mesh::MeshSource, product},
};

const SQUARES: &str = "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"checkerboard\"/></bsdf>";
const TRIANGLE: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
    property float u\nproperty float v\nelement face 1\nproperty list uchar int vertex_indices\nproperty float weight_0\n\
    end_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 0.75\n3 0 1 2 0.5\n";

pub fn map(object: &ObjectDescription) -> DAffine3 {
    product(&object.transform).expect("it is valid")
}

fn placed(kind: &str, steps: &str, within: &str) -> ObjectDescription {
    object(&format!("<shape type=\"{kind}\"><transform name=\"to_world\">{steps}</transform>{within}</shape>"))
}

#[test]
fn steps_of_a_transform_apply_in_order() {
    let ball = placed("sphere", "<scale value=\"2\"/><rotate z=\"1\" angle=\"90\"/><translate x=\"1\" y=\"2\"/>", "");
    let found = map(&ball).transform_point3(DVec3::X);
    assert!(found.abs_diff_eq(DVec3::new(1.0, 4.0, 0.0), 1e-9), "{found}");
    let matrix = placed("sphere", "<matrix value=\"1 0 0 5 0 1 0 6 0 0 1 7 0 0 0 1\"/>", "");
    assert_eq!(map(&matrix).translation, DVec3::new(5.0, 6.0, 7.0));
    let linear = placed("sphere", "<matrix value=\"1 2 0 0 1 0 0 0 3\"/>", "");
    assert_eq!(map(&linear).transform_point3(DVec3::ONE), DVec3::new(3.0, 1.0, 3.0));
}

/// The corner of the matrix that Mitsuba 3.9 makes of it.
#[test]
fn rotations_about_a_longer_axis_distort() {
    let found = map(&placed("sphere", "<rotate x=\"1\" y=\"1\" angle=\"40\"/>", "")).transform_vector3(DVec3::X);
    assert!(found.abs_diff_eq(DVec3::new(1.0, 0.233_956, -0.642_788), 1e-5), "{found}");
}

#[test]
fn rectangles_span_two_units_and_their_front_is_z() {
    let corners = |object: &ObjectDescription| match &object.shape {
        ShapeKind::Rectangle(r) => {
            (r.origin, r.edge_u, r.edge_v, if object.flip { -1.0 } else { 1.0 } * r.edge_u.cross(r.edge_v))
        }
        other => panic!("{other:?}"),
    };
    let (origin, u, v, front) = corners(&placed("rectangle", "<translate z=\"1\"/>", ""));
    assert_eq!((origin, u, v), (DVec3::new(-1.0, -1.0, 1.0), 2.0 * DVec3::X, 2.0 * DVec3::Y));
    assert!(front.z > 0.0);
    // With a texture, our v (against the second edge) is Mitsuba's, which runs upwards.
    let (origin, u, v, front) = corners(&placed("rectangle", "<translate z=\"1\"/>", SQUARES));
    assert_eq!((origin, u, v), (DVec3::new(-1.0, 1.0, 1.0), 2.0 * DVec3::X, -2.0 * DVec3::Y));
    assert!(front.z > 0.0);
    let flip = "<boolean name=\"flip_normals\" value=\"true\"/>";
    assert!(corners(&placed("rectangle", "<translate z=\"1\"/>", flip)).3.z < 0.0);
    // A mirror of x leaves the normal.
    assert!(corners(&placed("rectangle", "<scale x=\"-1\"/>", "")).3.z > 0.0);
}

#[test]
fn spheres_keep_center_and_radius_and_turn_with_their_textures() {
    let text = "<shape type=\"sphere\"><point name=\"center\" x=\"1\"/><float name=\"radius\" value=\"3\"/>BSDF</shape>";
    let plain = object(&text.replace("BSDF", ""));
    assert!(matches!(&plain.shape, ShapeKind::Sphere(ball) if ball.center == DVec3::X && ball.radius == 3.0));
    assert!(plain.transform.is_empty() && !plain.flip);
    let textured = object(&text.replace("BSDF", SQUARES));
    // The top of ours, y, is z of Mitsuba.
    let top = map(&textured).transform_point3(DVec3::Y);
    assert!(top.abs_diff_eq(DVec3::new(1.0, 0.0, 3.0), 1e-6), "{top}");
    // u runs from +x towards −z of ours, which is +y of Mitsuba.
    let quarter = map(&textured).transform_point3(DVec3::NEG_Z);
    assert!(quarter.abs_diff_eq(DVec3::new(1.0, 3.0, 0.0), 1e-6), "{quarter}");
}

#[test]
fn cylinders_are_open_and_textured_ones_run_from_p0() {
    let text = "<shape type=\"cylinder\"><point name=\"p0\" z=\"1\"/><point name=\"p1\" z=\"4\"/><float name=\"radius\" value=\"2\"/>BSDF</shape>";
    let plain = object(&text.replace("BSDF", ""));
    assert!(matches!(&plain.shape, ShapeKind::Cylinder(c) if c.base.z == 1.0 && c.top.z == 4.0 && c.radius == 2.0 && !c.capped));
    let textured = object(&text.replace("BSDF", SQUARES));
    // Our v is 0 at the top.
    let [top, base] = [DVec3::Z, DVec3::ZERO].map(|p| map(&textured).transform_point3(p));
    assert!(top.abs_diff_eq(DVec3::Z, 1e-9) && base.abs_diff_eq(4.0 * DVec3::Z, 1e-9), "{top} {base}");
}

#[test]
fn cubes_and_disks_with_textures_are_meshes() {
    for kind in ["cube", "disk"] {
        let plain = object(&format!("<shape type=\"{kind}\"/>"));
        assert!(matches!(&plain.shape, ShapeKind::Cuboid(_) | ShapeKind::Disk(_)));
        let imported =
            scene(&format!("{SENSOR}<shape type=\"{kind}\">{SQUARES}</shape><shape type=\"{kind}\">{SQUARES}</shape>"));
        let paths: Vec<&str> = imported.assets.paths().collect();
        assert_eq!(paths, [format!("meshes/{kind}.ply")], "both share one");
        let model = imported.assets.get::<Model>(paths[0]).expect("it is a model");
        assert!(model.uvs.as_ref().is_some_and(|uvs| uvs.len() == model.vertices.len()));
    }
}

#[test]
fn meshes_are_files_unless_their_coordinates_or_colors_change() {
    let read = |within: &str| {
        let text = format!(
            "<scene version=\"3.0.0\"><shape type=\"ply\"><string name=\"filename\" value=\"a.ply\"/>{within}</shape></scene>"
        );
        read_with(&[("a.ply", TRIANGLE)], &text, &ImportOptions::default()).unwrap_or_else(|error| panic!("{}", error.report()))
    };
    let source = |object: &ObjectDescription| match &object.shape {
        ShapeKind::Mesh(mesh) => (mesh.source.clone(), mesh.smooth),
        other => panic!("{other:?}"),
    };
    let plain = read("<boolean name=\"face_normals\" value=\"true\"/>");
    assert_eq!(source(&plain.description.objects[0]), (MeshSource::File("a.ply".into()), Some(false)));
    let textured = read(SQUARES);
    assert_eq!(source(&textured.description.objects[0]).0, MeshSource::File("meshes/a.ply".into()));
    let model = textured.assets.get::<Model>("meshes/a.ply").expect("it is a model");
    assert_eq!(model.uvs.as_ref().map(|uvs| uvs[2]), Some([0.0, 0.25]), "v of a PLY runs downwards in Mitsuba");
    let weights = "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"mesh_attribute\" id=\"w\">\
        <string name=\"name\" value=\"face_weight\"/></texture></bsdf>";
    let weighted = read(weights);
    let model = weighted.assets.get::<Model>("meshes/a.ply").expect("it is a model");
    assert_eq!(model.colours, Some(vec![[0.5, 0.5, 0.5, 1.0]; 3]));
    assert!(matches!(&weighted.description.textures["w"], TextureKind::VertexColor(_)));
    // Triangles that are mirrored have their back outside.
    let mirrored = read("<transform name=\"to_world\"><scale x=\"-1\"/></transform>");
    assert!(mirrored.description.objects[0].flip);
}

#[test]
fn instances_place_the_shapes_of_their_group() {
    let text = format!(
        "{SENSOR}<shape type=\"shapegroup\" id=\"g\"><shape type=\"sphere\"><transform name=\"to_world\"><translate x=\"1\"/>\
         </transform></shape><shape type=\"cube\"/></shape>\
         <shape type=\"instance\"><ref id=\"g\"/></shape>\
         <shape type=\"instance\"><ref id=\"g\"/><transform name=\"to_world\"><scale value=\"2\"/></transform></shape>"
    );
    let imported = scene(&text);
    let objects = &imported.description.objects;
    assert!(objects.len() == 4 && imported.remarks.is_empty());
    assert_eq!([0, 2].map(|i| map(&objects[i]).translation), [DVec3::X, 2.0 * DVec3::X]);
    assert!(objects.iter().all(|object| object.material.as_deref() == Some("default")));
    // A mirror of the instance moves the outside of a ball with it, and one of the ball turns it inside out.
    let mirror = "<transform name=\"to_world\"><scale x=\"-1\"/></transform>";
    let flips = [("", mirror), (mirror, ""), (mirror, mirror)].map(|(own, around)| {
        let group = format!("<shape type=\"shapegroup\" id=\"g\"><shape type=\"sphere\">{own}</shape></shape>");
        let text = format!("{SENSOR}{group}<shape type=\"instance\"><ref id=\"g\"/>{around}</shape>");
        scene(&text).description.objects[0].flip
    });
    assert_eq!(flips, [false, true, true]);
    let lone = scene(&format!("{SENSOR}<shape type=\"shapegroup\" id=\"g\"><shape type=\"sphere\"/></shape>"));
    assert!(lone.description.objects.is_empty());
}

#[test]
fn shapes_that_are_not_rendered_are_refused_by_name() {
    for kind in ["sdfgrid", "ellipsoids"] {
        assert!(refused(&format!("{SENSOR}<shape type=\"{kind}\"/>")).contains(kind));
    }
    let medium = format!(
        "{SENSOR}<medium type=\"homogeneous\" id=\"fog\"/><shape type=\"sphere\"><ref name=\"interior\" id=\"fog\"/></shape>"
    );
    assert!(refused(&medium).contains("participating medium, which Noisefall does not render"));
}

#[test]
fn textures_on_meshes_without_coordinates_cover_half_of_the_unit_square_in_each_triangle() {
    let mesh = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    let model = |bsdf: &str, mesh: &str| {
        let text = format!(
            "<scene version=\"3.0.0\">{SENSOR}<shape type=\"obj\"><string name=\"filename\" value=\"a.obj\"/>{bsdf}</shape></scene>"
        );
        let imported = read_with(&[("a.obj", mesh)], &text, &ImportOptions::default()).expect("it is valid");
        let ShapeKind::Mesh(mesh) = &imported.description.objects[0].shape else { panic!("not a mesh") };
        let MeshSource::File(path) = &mesh.source else { panic!("not a file") };
        imported.assets.get::<Model>(path)
    };
    // v of a model runs upwards. The corners of each triangle are at (0, 0), (1, 0) and (0, 1) of the image.
    let charted = model(SQUARES, mesh).expect("it is in memory");
    assert_eq!((charted.vertices.len(), charted.uvs.clone()), (6, Some([[0.0, 1.0], [1.0, 1.0], [0.0, 0.0]].repeat(2))));
    assert!(charted.normals.is_some(), "its vertices are smooth");
    assert!(model("", mesh).is_none());
    assert!(model(SQUARES, &format!("vt 0 0\n{}", mesh.replace("1 2 3 4", "1/1 2/1 3/1 4/1"))).is_none());
}
