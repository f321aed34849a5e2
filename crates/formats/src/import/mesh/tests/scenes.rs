//! Objects, cameras and light of mesh files.
use super::{SQUARE, scene};
use crate::import::{ImportOptions, Imported, open, read};
use noisefall_base::{
    declare::Resources,
    progress::{Progress, Stage},
};
use noisefall_scene::{
    light::environment::EnvironmentDescription, model::Model, scene::description::ShapeKind, shape::mesh::MeshSource,
};

/// The mesh files of the objects.
fn files(scene: &Imported) -> Vec<&str> {
    fn file(shape: &ShapeKind) -> &str {
        match shape {
            ShapeKind::Mesh(mesh) => match &mesh.source {
                MeshSource::File(path) => path,
                _ => panic!("a mesh of a file"),
            },
            _ => panic!("a mesh"),
        }
    }
    scene.description.objects.iter().map(|object| file(&object.shape)).collect()
}

#[test]
fn a_file_with_one_material_is_an_object_of_the_file() {
    let scene = scene(&format!("{SQUARE}f 1 2 3\n"), &[]);
    assert_eq!(files(&scene), ["a.obj"]);
    assert_eq!((scene.description.objects[0].name.as_str(), scene.description.materials.len()), ("a", 1));
    assert!(matches!(scene.description.environment, Some(EnvironmentDescription::Image(_))));
    let found: Vec<&str> = scene.remarks.iter().map(|counted| counted.remark.found.as_str()).collect();
    assert_eq!(found, ["no material", "no camera", "no light"]);
}

#[test]
fn each_material_is_an_object_with_a_mesh_in_memory() {
    let mtl = b"newmtl red/1\nKd 1 0 0\nnewmtl light\nKd 0 0 0\nKe 2 3 4\n";
    let obj = format!("mtllib a.mtl\n{SQUARE}usemtl red/1\nf 1 2 3\nusemtl light\nf 1 3 4\nusemtl red/1\nf 2 3 4\n");
    let scene = scene(&obj, &[("a.mtl", mtl)]);
    assert_eq!(files(&scene), ["meshes/red_1.ply", "meshes/light.ply"]);
    let names: Vec<&str> = scene.description.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["red/1", "light"]);
    assert_eq!(scene.assets.get::<Model>("meshes/red_1.ply").expect("it is there").triangles.len(), 2);
    // The light is the light.
    assert!(scene.description.objects[1].emission.is_some() && scene.description.environment.is_none());
    assert_eq!(scene.remarks.len(), 1, "{:?}", scene.remarks.lines(9));
}

#[test]
fn other_mesh_files_are_scenes_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("tri.stl");
    let text = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
    std::fs::write(&path, text).expect("it is written");
    let scene = read(&path, &ImportOptions::default()).expect("it is a scene");
    assert_eq!(files(&scene), ["tri.stl"]);
    std::fs::write(&path, "solid\n").expect("it is written");
    let error = read(&path, &ImportOptions::default()).err().expect("it is empty").to_string();
    assert!(error.ends_with("tri.stl: the mesh is empty: it has no faces"), "{error}");
}

#[test]
fn colours_of_vertices_are_the_albedo_where_there_is_no_material() {
    let scene = scene("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n", &[]);
    assert_eq!(scene.description.textures.keys().collect::<Vec<_>>(), ["vertex color"]);
}

#[test]
fn an_image_that_a_ply_file_names_is_its_albedo() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.ply");
    let text = "ply\nformat ascii 1.0\ncomment TextureFile my wood.png\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n0 0 0 1 0 0 0 1 0 3 0 1 2 6 0 0 1 0 0 1\n";
    std::fs::write(&path, text).expect("it is written");
    std::fs::write(folder.path().join("my wood.png"), "not looked at").expect("it is written");
    let scene = read(&path, &ImportOptions::default()).expect("it is a scene");
    assert_eq!(scene.description.textures.keys().collect::<Vec<_>>(), ["my wood"]);
    std::fs::remove_file(folder.path().join("my wood.png")).expect("it is there");
    let bare = read(&path, &ImportOptions::default()).expect("it is a scene");
    assert!(bare.remarks.lines(9).join("").contains("`my wood.png`: there is no such file"), "{:?}", bare.remarks.lines(9));
}

#[test]
fn faces_without_normals_are_flat_unless_their_group_is_smooth() {
    let smooth = |faces: &str| match &scene(&format!("{SQUARE}{faces}"), &[]).description.objects[0].shape {
        ShapeKind::Mesh(mesh) => mesh.smooth,
        _ => panic!("a mesh"),
    };
    for flat in ["f 1 2 3\n", "s off\nf 1 2 3\n", "s 0\nf 1 2 3\n", "s 1\ns off\nf 1 2 3\n"] {
        assert_eq!(smooth(flat), Some(false), "{flat}");
    }
    for stated in ["s 1\nf 1 2 3\n", "s 1\nf 1 2 3\ns 2\nf 1 3 4\n", "vn 0 0 1\nf 1//1 2//1 3//1\n"] {
        assert_eq!(smooth(stated), None, "{stated}");
    }
    // A part is a mesh in memory, whose groups become normals.
    let parts = scene(&format!("{SQUARE}s 1\nf 1 2 3\ns 2\nf 1 3 4\nusemtl b\nf 2 3 4\n"), &[]);
    let grouped = parts.assets.get::<Model>("meshes/mesh.ply").expect("it is there");
    assert_eq!((grouped.vertices.len(), grouped.normals.as_ref().map(Vec::len)), (6, Some(6)));
}

#[test]
fn normals_and_coordinates_that_do_not_exist_are_remarks() {
    let found = scene("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/1 2/2/2 3/3/3\n", &[]).remarks.lines(9).join("\n");
    assert!(found.contains("3 corners with texture coordinates that do not exist"), "{found}");
    assert!(found.contains("3 corners with normals that do not exist → normals of the surface"), "{found}");
}

#[test]
fn point_clouds_and_pointers_are_named_in_the_error() {
    let folder = tempfile::tempdir().expect("a folder");
    let message = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("it is written");
        read(&path, &ImportOptions::default()).err().expect("it is refused")
    };
    let cloud = message(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n",
    );
    assert!(cloud.to_string().contains("it is a point cloud: it has 1 points"), "{cloud}");
    assert!(!cloud.report().contains("a mesh is an OBJ"), "{}", cloud.report());
    let pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:2c6b\nsize 4285914\n";
    for name in ["a.obj", "b.ply", "c.stl", "d.pbrt", "e.xml", "f.gltf", "g.glb"] {
        let found = message(name, pointer).to_string();
        assert!(found.contains("Git LFS"), "{name}: {found}");
    }
}

#[test]
fn the_mesh_of_a_file_is_read_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.obj");
    std::fs::write(&path, format!("{SQUARE}f 1 2 3 4\n")).expect("it is written");
    let scene = read(&path, &ImportOptions::default()).expect("it is a scene");
    let taken = || Resources::new(folder.path()).with_assets(scene.assets.clone()).file("a.obj").take_loaded::<Model>();
    assert_eq!(taken().expect("it is handed over"), noisefall_scene::model::read(&path).expect("it is a mesh"));
    assert!(taken().is_none());
}

#[test]
fn opening_reports_its_stages_and_ends_when_it_is_cancelled() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.obj");
    std::fs::write(&path, format!("{SQUARE}f 1 2 3 4\n")).expect("it is written");
    let options = ImportOptions::default();
    assert!(open(&path, &options).is_ok());
    assert_eq!((options.progress.stage(), options.progress.fraction()), (Stage::Trees, 1.0));
    options.progress.cancel();
    let error = open(&path, &options).err().expect("it is cancelled").to_string();
    assert!(error.ends_with("a.obj: cancelled"), "{error}");
    // The compile ends as well.
    let progress = Progress::default();
    let imported = read(&path, &ImportOptions { progress: progress.clone(), ..options }).expect("it is a scene");
    progress.cancel();
    let compiled = std::sync::Arc::new(imported.description).build_watched(&path, imported.assets, &progress);
    assert!(compiled.err().expect("it is cancelled").to_string().contains("cancelled"));
}
