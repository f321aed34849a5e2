//! Geometry.
use glam::{DMat3, DVec3, Vec3};

use super::round_trip;
use crate::export::{
    geometry,
    gltf::units::unit,
    round_trip::{RoundTrip, near},
};
use noisefall_base::declare::{Assets, Resources, Textured};
use noisefall_scene::{
    geometry::{MeshData, Outline, Shape},
    material::Lambertian,
    model::Model,
    scene::description::{MaterialDescription, ObjectDescription, SceneDescription, ShapeKind, Transform},
    shape::{
        Bounds,
        cuboid::Cuboid,
        mesh::{Mesh, MeshSource},
    },
    texture::{image::Channel, vertex_color::VertexColor},
};

/// A triangle with every attribute. Its numbers have few digits, so that 1 − v does not round, and its normals are on its front.
fn triangle() -> Model {
    Model {
        vertices: vec![[0.1, 0.2, 0.3], [1.0, -7e-9, 0.0], [0.0, 1.0, 3e8]],
        triangles: vec![[0, 2, 1], [2, 1, 0]],
        normals: Some(vec![[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]),
        uvs: Some(vec![[0.1, 0.25], [1.5, -2.0], [0.0, 1.0]]),
        colours: Some(vec![[0.1, 0.2, 0.3, 0.4], [1.0; 4], [0.0; 4]]),
        tangents: Some(vec![[1.0, 0.0, 0.0, 1.0], [0.0, 0.6, 0.8, -1.0], [0.0, 1.0, 0.0, 1.0]]),
        ..Model::default()
    }
}

/// A scene of objects without names that show a file.
fn scene(places: &[Vec<Transform>], assets: &mut Assets) -> SceneDescription {
    assets.insert("meshes/tri.ply", triangle());
    let mut scene = SceneDescription::default();
    for transform in places {
        let mesh = Mesh { source: MeshSource::File("meshes/tri.ply".to_owned()), smooth: None };
        let object = ObjectDescription { name: "tri".to_owned(), shape: mesh.into(), ..ObjectDescription::default() };
        scene.objects.push(ObjectDescription { transform: transform.clone(), ..object });
    }
    scene
}

/// The paths of the meshes of a scene.
fn paths(scene: &SceneDescription) -> Vec<&str> {
    scene.objects.iter().map(path).collect()
}

fn path(object: &ObjectDescription) -> &str {
    match &object.shape {
        ShapeKind::Mesh(Mesh { source: MeshSource::File(path), .. }) => path,
        other => panic!("a {}", other.name()),
    }
}

#[test]
fn meshes_keep_their_bits_and_instances_share_them() {
    let mut assets = Assets::default();
    let matrix = Transform::Matrix([[0.0, -3.0, 0.0, 1e9], [2.0, 0.0, 0.0, 0.25], [0.0, 0.0, -0.5, 0.0], [0.0, 0.0, 0.0, 1.0]]);
    let mut ours = scene(&[Vec::new(), vec![matrix.clone()]], &mut assets);
    for (name, channel) in [("colors", Channel::Rgb), ("opacity", Channel::Alpha)] {
        ours.textures.insert(name.to_owned(), VertexColor { channel }.into());
    }
    let material = MaterialDescription {
        kind: Lambertian { albedo: Textured::Texture("colors".to_owned()) }.into(),
        opacity: Some(Textured::Texture("opacity".to_owned())),
        ..MaterialDescription::default()
    };
    ours.materials.insert("paint".to_owned(), material);
    ours.objects.iter_mut().for_each(|object| object.material = Some("paint".to_owned()));
    let RoundTrip { imported, .. } = round_trip(&ours, &assets);
    let theirs = &imported.description;
    let [first, second] = paths(theirs)[..] else { panic!("two objects") };
    assert_eq!(first, second);
    assert_eq!((&theirs.objects[0].transform[..], &theirs.objects[1].transform[..]), (&[][..], &[matrix][..]));
    // No material reads the tangents.
    assert_eq!(*imported.assets.get::<Model>(first).expect("a mesh"), Model { tangents: None, ..triangle() });
    assert!(matches!(theirs.materials["paint"].opacity, Some(Textured::Texture(_))));
}

#[test]
fn meshes_that_a_matrix_would_shear_are_moved_themselves() {
    let mut assets = Assets::default();
    let shear = Transform::Matrix([[1.0, 0.5, 0.0, 7.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, -1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]);
    let ours = scene(&[vec![shear]], &mut assets);
    let RoundTrip { imported, remarks, .. } = round_trip(&ours, &assets);
    let [Transform::Matrix(matrix)] = imported.description.objects[0].transform[..] else { panic!("a matrix") };
    assert_eq!(matrix, [[1.0, 0.0, 0.0, 7.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]);
    let found = imported.assets.get::<Model>(paths(&imported.description)[0]).expect("a mesh");
    assert_eq!(found.vertices[2], [0.5, 1.0, -3e8]);
    assert_eq!(found.triangles, [[0, 1, 2], [2, 0, 1]], "the front stays");
    assert_eq!(remarks, [""; 0]);
}

#[test]
fn colors_of_vertices_that_no_material_uses_are_left_out() {
    let mut assets = Assets::default();
    let ours = scene(&[Vec::new()], &mut assets);
    let RoundTrip { imported, .. } = round_trip(&ours, &assets);
    let path = paths(&imported.description)[0];
    let found = imported.assets.get::<Model>(path).expect("a mesh");
    assert_eq!(*found, Model { colours: None, tangents: None, ..triangle() });
}

#[test]
fn reversed_and_flat_meshes_face_the_same_side() {
    let mut assets = Assets::default();
    let mut ours = scene(&[Vec::new(), Vec::new()], &mut assets);
    ours.objects[0].flip = true;
    let lists = MeshSource::Lists { vertices: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], triangles: vec![[0, 1, 2]] };
    ours.objects[1].shape = Mesh { source: lists, smooth: None }.into();
    let RoundTrip { imported, .. } = round_trip(&ours, &assets);
    let [reversed, flat] = paths(&imported.description)[..] else { panic!("two objects") };
    let reversed = imported.assets.get::<Model>(reversed).expect("a mesh");
    assert_eq!(reversed.triangles, [[0, 1, 2], [2, 0, 1]]);
    assert_eq!(reversed.normals.as_ref().expect("normals")[1], [0.0, -1.0, 0.0]);
    assert_eq!(imported.assets.get::<Model>(flat).expect("a mesh").normals, None);
    assert!(matches!(&imported.description.objects[1].shape, ShapeKind::Mesh(mesh) if mesh.smooth == Some(false)));
}

/// Volume that closed triangles enclose, negative if they face inwards.
fn volume(data: &MeshData) -> f64 {
    let corner = |i: u32| Vec3::from(data.vertices[i as usize]).as_dvec3();
    data.triangles.iter().map(|[a, b, c]| corner(*a).dot(corner(*b).cross(corner(*c))) / 6.0).sum()
}

#[test]
fn unit_shapes_are_moved_to_their_place_and_keep_their_front() {
    let mirror = DMat3::from_cols(DVec3::new(1.0, 0.5, 0.0), DVec3::new(0.0, -2.0, 0.3), DVec3::new(0.1, 0.0, 3.0));
    let closed = [
        (Shape::sphere(DVec3::ONE, 2.0), 4.0 / 3.0 * std::f64::consts::PI * 8.0),
        (Shape::Ellipsoid { center: DVec3::ZERO, axes: mirror }, 4.0 / 3.0 * std::f64::consts::PI * mirror.determinant().abs()),
        (Shape::Cuboid { origin: DVec3::X, edges: mirror }, mirror.determinant().abs()),
        (Shape::Cylinder { base: DVec3::Y, axes: mirror, capped: true }, std::f64::consts::PI * mirror.determinant().abs()),
    ];
    for (shape, expected) in closed {
        let (unit, map) = unit(&shape).expect("it has one");
        let model = geometry::triangles(&unit, DVec3::ZERO).expect("it has triangles");
        let data = MeshData { vertices: model.vertices, triangles: model.triangles, ..MeshData::default() }
            .transformed(&map)
            .into_owned();
        assert!((volume(&data) / expected - 1.0).abs() < 2e-3, "{}", shape.name());
    }
    for (outline, mirrored) in [(Outline::Parallelogram, false), (Outline::Triangle, true), (Outline::Ellipse, true)] {
        let edges = [DVec3::new(2.0, 0.5, 0.0), DVec3::new(0.0, 3.0, 1.0)];
        let front = edges[0].cross(edges[1]) * if mirrored { -1.0 } else { 1.0 };
        let (unit, map) = unit(&Shape::Flat { outline, origin: DVec3::ONE, edges, mirrored }).expect("it has one");
        let model = geometry::triangles(&unit, DVec3::ZERO).expect("it has triangles");
        let data = MeshData { vertices: model.vertices, triangles: model.triangles, ..MeshData::default() }
            .transformed(&map)
            .into_owned();
        let [a, b, c] = data.triangles[0].map(|i| Vec3::from(data.vertices[i as usize]).as_dvec3());
        assert!((b - a).cross(c - a).dot(front) > 0.0 && (b - a).dot(front).abs() < 1e-4, "{outline:?}");
    }
}

#[test]
fn cuboids_come_back_with_their_corners() {
    let mut ours = SceneDescription::default();
    ours.camera.resolution = [1280, 960];
    let [min, max] = [DVec3::new(-1.0, 0.1, 0.2), DVec3::new(3.0, 1.1, 7.0)];
    ours.add_object("box", Cuboid(Bounds { min, max }));
    let RoundTrip { imported, remarks, folder, .. } = round_trip(&ours, &Assets::default());
    assert_eq!(remarks, [""; 0]);
    let resources = Resources::new(folder.path()).with_assets(imported.assets.clone());
    let shapes = geometry::shapes(&imported.description.objects[0], &resources).expect("it is valid");
    let [Shape::Mesh { data, map, .. }] = &shapes[..] else { panic!("a mesh") };
    let corners: Vec<DVec3> = data.vertices.iter().map(|v| map.transform_point3(Vec3::from(*v).as_dvec3())).collect();
    let fold = |f: fn(DVec3, DVec3) -> DVec3| corners.iter().copied().reduce(f).expect("corners");
    assert!(near(fold(DVec3::min), min) && near(fold(DVec3::max), max), "{corners:?}");
}
