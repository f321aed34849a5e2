//! Shapes, meshes and instances of pbrt.
use super::{SceneFolder, error, remarks, world};
use crate::import::Imported;
use noisefall_scene::{
    model::Model,
    scene::description::ShapeKind,
    shape::{Transform, mesh::MeshSource},
};

fn model(found: &Imported, object: usize) -> Model {
    let ShapeKind::Mesh(mesh) = &found.description.objects[object].shape else { panic!("a mesh") };
    let MeshSource::File(path) = &mesh.source else { panic!("a file") };
    Model::clone(&found.assets.get::<Model>(path).expect("it is among the assets"))
}

#[test]
fn quadrics_are_shapes_and_their_parts_are_meshes() {
    let found = world(
        "Shape \"sphere\" \"float radius\" 2\nReverseOrientation\nShape \"disk\" \"float height\" 1\n\
         Shape \"cylinder\" \"float zmin\" 0\nShape \"sphere\" \"float phimax\" 90",
    );
    let objects = &found.description.objects;
    assert!(matches!(&objects[0].shape, ShapeKind::Sphere(sphere) if sphere.radius == 2.0) && !objects[0].flip);
    assert!(
        matches!(&objects[1].shape, ShapeKind::Disk(disk) if disk.center.z == 1.0 && disk.normal.z == 1.0) && objects[1].flip
    );
    assert!(matches!(&objects[2].shape, ShapeKind::Cylinder(tube) if !tube.capped && tube.top.z == 1.0));
    let part = model(&found, 3);
    assert!(part.vertices.iter().all(|[x, y, _]| *x >= -1e-6 && *y >= -1e-6));
    let outwards = part.triangles.iter().all(|triangle| {
        let [a, b, c] = triangle.map(|i| glam::Vec3::from(part.vertices[i as usize]));
        (b - a).cross(c - a).dot(a + b + c) >= -1e-9
    });
    assert!(outwards && remarks(&found).len() == 1);
}

#[test]
fn meshes_keep_normals_and_coordinates_and_turn_to_their_normals() {
    let found = world(
        "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"normal N\" [0 0 -1 0 0 -1 0 0 -1] \"point2 uv\" [0 0 1 0 0 1]\n\
         Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]",
    );
    let mesh = model(&found, 0);
    assert_eq!((mesh.triangles.as_slice(), mesh.uvs.map(|uvs| uvs[2])), ([[0, 2, 1]].as_slice(), Some([0.0, 1.0])));
    let square = model(&found, 1);
    assert_eq!((square.triangles.len(), square.uvs.map(|uvs| uvs[3])), (2, Some([1.0, 1.0])));
    assert!(matches!(&found.description.objects[1].shape, ShapeKind::Mesh(mesh) if mesh.smooth == Some(false)));
}

#[test]
fn instances_share_their_mesh() {
    let triangle = "\"point3 P\" [0 0 0 1 0 0 0 1 0]";
    let found = world(&format!(
        "ObjectBegin \"leaf\"\nTranslate 1 0 0\nShape \"trianglemesh\" {triangle}\nObjectEnd\n\
         AttributeBegin\nTranslate 0 2 0\nObjectInstance \"leaf\"\nAttributeEnd\nScale 2 2 2\nObjectInstance \"leaf\""
    ));
    let [a, b] = &found.description.objects[..] else { panic!("two objects") };
    assert_eq!(a.shape, b.shape);
    let places = [a, b].map(|object| match &object.transform[0] {
        Transform::Matrix([x, y, ..]) => [x[3], y[3]],
        _ => panic!("a matrix"),
    });
    assert_eq!(places, [[1.0, 2.0], [2.0, 0.0]]);
    assert_eq!(found.assets.paths().filter(|path| path.starts_with("meshes/")).count(), 1);
}

#[test]
fn ply_files_are_flat_without_normals() {
    let header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    let files = SceneFolder::new(&[
        (
            "a.pbrt",
            "WorldBegin\nShape \"plymesh\" \"string filename\" \"flat.ply\"\nShape \"plymesh\" \"string filename\" \"smooth.ply\"",
        ),
        ("flat.ply", &format!("{header}end_header\n")),
        ("smooth.ply", &format!("{header}property float nx\nend_header\n")),
    ]);
    let found = files.read().expect("meshes are read later");
    let smooth: Vec<_> = found
        .description
        .objects
        .iter()
        .map(|object| match &object.shape {
            ShapeKind::Mesh(mesh) => (mesh.source.clone(), mesh.smooth),
            _ => panic!("a mesh"),
        })
        .collect();
    assert_eq!(smooth[0], (MeshSource::File("flat.ply".into()), Some(false)));
    assert_eq!(smooth[1], (MeshSource::File("smooth.ply".into()), Some(true)));
}

#[test]
fn moving_shapes_open_the_shutter() {
    let found = world("TransformTimes 0 2\nActiveTransform EndTime\nTranslate 1 0 0\nActiveTransform All\nShape \"sphere\"");
    assert!(matches!(&found.description.objects[0].motion[..], [Transform::Translate(by)] if by.x == 1.0));
    assert!(found.description.camera.shutter.is_some());
    assert!(world("Shape \"sphere\"").description.camera.shutter.is_none());
}

#[test]
fn included_files_continue_and_imported_ones_return() {
    let files = [("b.pbrt", "Translate 1 0 0\nShape \"sphere\"")];
    let x = |word: &str| {
        let text = format!("WorldBegin\n{word} \"b.pbrt\"\nShape \"sphere\"");
        let found = SceneFolder::new(&[files[0], ("a.pbrt", &text)]).read().expect("it is read");
        match &found.description.objects[1].transform[0] {
            Transform::Matrix([x, ..]) => x[3].abs(),
            _ => panic!("a matrix"),
        }
    };
    assert_eq!((x("Include"), x("Import")), (1.0, 0.0));
}

#[test]
fn broken_meshes_are_refused() {
    let mesh = |parameters: &str| error(&format!("WorldBegin\nShape \"trianglemesh\" {parameters}"));
    assert!(mesh("").contains("vertices"));
    assert!(mesh("\"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 3]").contains("no vertex 3"));
    assert!(mesh("\"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 -1]").contains("no vertex -1"));
    assert!(mesh("\"point3 P\" [0 0 0 1 0 0 0 1 1e300]").contains("too large"));
    assert!(error("WorldBegin\nShape \"nurbs\"").contains("not a shape"));
}
