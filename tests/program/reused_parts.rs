//! After a change, only what it concerns is compiled again.
use std::{fs, path::Path, sync::Arc};

use glam::DVec3;
use noisefall_base::{declare::Precision, math::SimdLevel};
use noisefall_render::render::threads::Threads;
use noisefall_scene::{
    light::environment::{constant::Constant, image::Image},
    material::{Dielectric, Lambertian, Roughness},
    scene::{
        Scene,
        description::{EnvironmentDescription, SceneDescription, Transform},
    },
    shape::{
        Mesh, Sphere,
        mesh::{Heightfield, MeshSource},
    },
};

use crate::edited_scenes::{assert_same, picture, shipped};

/// Moves an object.
fn shift(scene: &mut SceneDescription, name: &str) {
    let object = scene.objects.iter_mut().find(|object| object.name == name).expect("it is there");
    object.transform.push(Transform::Translate(DVec3::X * 0.1));
}

/// The parts that a change makes, and those that it reuses.
fn parts(
    folder: &Path,
    before: &Scene,
    change: impl FnOnce(&mut SceneDescription),
    description: &SceneDescription,
) -> [Vec<&'static str>; 2] {
    let mut changed = description.clone();
    change(&mut changed);
    let scene = Arc::new(changed).rebuild(folder, before, Precision::Interactive).expect("the change is valid");
    let parts = scene.compiled.parts;
    let of = |is_made: bool| {
        let mut names: Vec<_> = parts.iter().filter(|part| (part.made > 0) == is_made).map(|part| part.part).collect();
        names.sort_unstable();
        names
    };
    [of(true), of(false)]
}

#[test]
fn only_parts_that_a_change_concerns_are_made_again() {
    let (folder, mut description) = shipped("million_triangles");
    let assets = folder.join("assets");
    let sky = fs::read_dir(&assets).expect("the folder can be read").map(|file| file.expect("an entry").path());
    let sky = sky.filter(|path| path.extension().is_some_and(|extension| extension == "exr")).min().expect("there is a sky");
    let picture = |rotate: f64| Image { path: sky.display().to_string(), rotate, ..Image::default() };
    description.environment = Some(picture(0.0).into());
    let glass = Dielectric { roughness: Roughness::alpha(0.3), ..Dielectric::default() };
    description.add_material("glass", glass.clone());
    description.add_object("ball", Sphere { radius: 0.2, ..Sphere::default() }).material = Some("glass".to_owned());
    let before = description.build(&folder).expect("it is valid");
    let parts = |change: fn(&mut SceneDescription)| parts(&folder, &before, change, &description);
    let all = ["lights", "material tables", "mesh trees", "meshes", "shapes", "skies", "surfaces"];
    let without = |made: &[&str]| all.into_iter().filter(|part| !made.contains(part)).collect::<Vec<_>>();
    let is_made = |[made, reused]: [Vec<&'static str>; 2], expected: &[&str]| {
        assert_eq!((&made[..], reused), (expected, without(expected)));
    };
    is_made(parts(|_| ()), &["surfaces"]);
    is_made(parts(|scene| scene.camera.fov = Some(20.0)), &["surfaces"]);
    let darker = |scene: &mut SceneDescription| {
        scene.add_material("walls", Lambertian { albedo: [0.1; 3].into() });
    };
    is_made(parts(darker), &["surfaces"]);
    is_made(parts(|scene| scene.objects.last_mut().expect("the ball").flip = true), &["surfaces"]);
    let smoother = |scene: &mut SceneDescription| {
        scene.add_material("glass", Dielectric { roughness: Roughness::alpha(0.2), ..Dielectric::default() });
    };
    is_made(parts(smoother), &["material tables", "surfaces"]);
    let brighter = |scene: &mut SceneDescription| {
        scene.objects.iter_mut().find_map(|object| object.emission.as_mut()).expect("a light").scale = 2.0;
    };
    is_made(parts(brighter), &["lights", "surfaces"]);
    is_made(parts(|scene| shift(scene, "ball")), &["shapes", "surfaces"]);
    is_made(parts(|scene| shift(scene, "knot")), &["shapes", "surfaces"]);
    is_made(parts(|scene| shift(scene, "light")), &["lights", "shapes", "surfaces"]);
    let turned = |scene: &mut SceneDescription| match &mut scene.environment {
        Some(EnvironmentDescription::Image(image)) => image.rotate = 30.0,
        _ => panic!("it is an image"),
    };
    is_made(parts(turned), &["lights", "surfaces"]);
}

#[test]
fn a_mesh_that_moves_keeps_its_tree_until_it_is_compiled_exactly() {
    let environment = Some(Constant { radiance: [1.0; 3] }.into());
    let mut description = SceneDescription { environment, ..SceneDescription::default() };
    description.add_material("white", Lambertian { albedo: [0.8, 0.5, 0.3].into() });
    let hills = MeshSource::Heightfield(Heightfield { quads: 30, seed: 1 });
    description.add_object("hills", Mesh { source: hills, smooth: None }).material = Some("white".to_owned());
    let before = description.build(Path::new("")).expect("it is valid");
    description.objects[0].transform.push(Transform::Translate(DVec3::new(0.1, -0.2, 0.05)));
    let description = Arc::new(description);
    let [moved, exact] = [Precision::Interactive, Precision::Exact]
        .map(|precision| description.rebuild(Path::new(""), &before, precision).expect("it is valid"));
    let made = |scene: &Scene| (scene.compiled.made("mesh trees"), scene.shapes.have_moved_meshes());
    assert_eq!([&moved, &exact].map(made), [(0, true), (1, false)]);
    let threads = Threads::new(2, SimdLevel::best()).expect("threads can be had");
    let new = description.build(Path::new("")).expect("it is valid");
    assert_same(&exact, &new, &threads, "exact");
    // Of an image of two samples, some paths part at an edge that is rounded differently.
    let [a, b] = [&moved, &new].map(|scene| picture(scene, &threads));
    let near = |(a, b): (&[u32; 3], &[u32; 3])| (0..3).all(|i| (f32::from_bits(a[i]) - f32::from_bits(b[i])).abs() < 1e-3);
    let count = a.iter().zip(&b).filter(|(a, b)| near((a, b))).count();
    assert!(count * 10 > a.len() * 9, "{count} of {} pixels are near", a.len());
    // Back in its pose, the mesh has the tree that it had.
    let mut back = SceneDescription::clone(&description);
    back.objects[0].transform.clear();
    let back = Arc::new(back).rebuild(Path::new(""), &moved, Precision::Interactive).expect("it is valid");
    assert_eq!(made(&back), (0, false));
}

#[test]
fn tables_of_rough_glass_are_coarse_until_they_are_compiled_exactly() {
    let glass = |alpha: f32| Dielectric { roughness: Roughness::alpha(alpha), ..Dielectric::default() };
    let environment = Some(Constant { radiance: [1.0; 3] }.into());
    let mut description = SceneDescription { environment, ..SceneDescription::default() };
    description.add_material("glass", glass(0.3));
    description.add_object("ball", Sphere::default()).material = Some("glass".to_owned());
    let before = description.build(Path::new("")).expect("it is valid");
    description.add_material("glass", glass(0.2));
    let description = Arc::new(description);
    let coarse = description.rebuild(Path::new(""), &before, Precision::Interactive).expect("it is valid");
    let exact = description.rebuild(Path::new(""), &coarse, Precision::Exact).expect("it is valid");
    assert_eq!([&before, &coarse, &exact].map(Scene::is_exact), [true, false, true]);
    assert_eq!([&coarse, &exact].map(|scene| scene.compiled.made("material tables")), [1, 1]);
    let threads = Threads::new(2, SimdLevel::best()).expect("threads can be had");
    let new = description.build(Path::new("")).expect("it is valid");
    assert_same(&exact, &new, &threads, "exact");
    // Exact parts serve both precisions.
    let again = description.rebuild(Path::new(""), &exact, Precision::Interactive).expect("it is valid");
    assert_eq!((again.is_exact(), again.compiled.made("material tables")), (true, 0));
}

#[test]
fn a_file_that_changes_on_the_disk_is_read_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |triangles: &str| {
        let text = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n{triangles}");
        fs::write(folder.path().join("mesh.obj"), text).expect("it is written");
    };
    let mut description = SceneDescription::default();
    description.add_object("mesh", Mesh { source: MeshSource::File("mesh.obj".to_owned()), smooth: Some(false) });
    let description = Arc::new(description);
    write("f 1 2 3\n");
    let one = description.build(folder.path()).expect("it is valid");
    let again = description.rebuild(folder.path(), &one, Precision::Exact).expect("it is valid");
    assert_eq!((one.compiled.made("meshes"), again.compiled.made("meshes")), (1, 0));
    write("f 1 2 3\nf 2 4 3\n");
    let two = description.rebuild(folder.path(), &again, Precision::Exact).expect("it is valid");
    assert_eq!((two.compiled.made("meshes"), two.compiled.made("mesh trees")), (1, 1));
}
