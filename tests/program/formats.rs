//! Scenes of other formats: in memory, converted, and on the command line.
use std::{fs, path::Path, sync::Arc};

use glam::DVec3;
use noisefall_base::{
    declare::{Assets, Precision},
    math::SimdLevel,
};
use noisefall_formats::{
    export::{ExportSource, write},
    import,
};
use noisefall_render::render::{image_file::read, threads::Threads};
use noisefall_scene::{
    light::environment::image::Image as Sky,
    material::Lambertian,
    model::Model,
    scene::{
        Scene,
        description::{SceneDescription, Transform},
        load,
    },
    shape::mesh::{Mesh, MeshSource},
    texture::kinds::Image,
};

use crate::{
    command_line::{Shell, scene, text},
    edited_scenes::picture,
};

/// An encoded PNG of a gradient.
fn png() -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let image = ::image::RgbImage::from_fn(8, 8, |x, y| ::image::Rgb([30 * x as u8, 30 * y as u8, 120]));
    image.write_to(&mut bytes, ::image::ImageFormat::Png).expect("it is encoded");
    bytes.into_inner()
}

/// A panorama as a Radiance file.
fn sky() -> Vec<u8> {
    let mut bytes = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n".to_vec();
    bytes.extend((0..32).flat_map(|i| [100 + i, 128, 140, 129]));
    bytes
}

/// A tent with normals and coordinates whose numbers have no short decimal form.
fn tent() -> Model {
    let third = 1.0 / 3.0;
    let vertices = vec![[-third, -0.3, 0.1], [third, -0.3, 0.2], [0.0, third, -0.1], [0.1, 0.2, 0.7]];
    Model {
        triangles: vec![[0, 1, 2], [1, 3, 2]],
        normals: Some(vec![[0.36, 0.48, 0.8], [0.0, 0.6, 0.8], [0.6, 0.0, 0.8], [0.0, 0.28, 0.96]]),
        uvs: Some(vec![[0.1, 0.2], [third, 0.7], [0.9, 1.1], [-0.4, 0.3]]),
        vertices,
        ..Model::default()
    }
}

/// A scene all of whose files are in memory.
fn in_memory() -> (Arc<SceneDescription>, Assets) {
    let mut assets = Assets::default();
    assets.insert("meshes/tent.ply", tent());
    assets.insert("textures/gradient.png", png());
    assets.insert("textures/sky.hdr", sky());
    let mut scene = SceneDescription { environment: Some(environment("textures/sky.hdr")), ..SceneDescription::default() };
    (scene.camera.eye, scene.camera.look_at) = (DVec3::new(0.1, 0.2, 2.0), DVec3::ZERO);
    scene.textures.insert("gradient".to_owned(), Image { path: "textures/gradient.png".to_owned(), ..Image::default() }.into());
    scene.add_material("paint", Lambertian { albedo: noisefall_base::declare::Textured::Texture("gradient".to_owned()) });
    let tent = scene.add_object("tent", Mesh { source: MeshSource::File("meshes/tent.ply".to_owned()), smooth: None });
    tent.material = Some("paint".to_owned());
    tent.transform = vec![Transform::Translate(DVec3::new(0.1, 0.0, 1.0 / 7.0))];
    (Arc::new(scene), assets)
}

fn environment(path: &str) -> noisefall_scene::scene::description::EnvironmentDescription {
    Sky { path: path.to_owned(), ..Sky::default() }.into()
}

fn threads() -> Threads {
    Threads::new(1, SimdLevel::best()).expect("a thread")
}

fn is_lit(scene: &Scene) -> bool {
    picture(scene, &threads()).iter().flatten().collect::<std::collections::BTreeSet<_>>().len() > 20
}

#[test]
fn a_scene_in_memory_and_the_exported_one_have_the_same_bits() {
    let folder = tempfile::tempdir().expect("a folder");
    let (description, assets) = in_memory();
    let scene = description.build_with(&folder.path().join("tent.xml"), assets.clone()).expect("it is valid");
    assert!(is_lit(&scene));
    let path = folder.path().join("out/tent.toml");
    fs::create_dir(folder.path().join("out")).expect("a folder");
    let source =
        ExportSource { description: &description, assets: &assets, folder: folder.path(), allow_outside: false, text: None };
    let exported = write(source, &path).expect("it is written");
    assert_eq!((exported.written, exported.copied), (3, 0));
    let read = load(&path).unwrap_or_else(|error| panic!("{}", error.report()));
    assert!(picture(&scene, &threads()) == picture(&read, &threads()), "images");
    assert_eq!((scene.camera, scene.settings, scene.size.to_bits()), (read.camera, read.settings, read.size.to_bits()));
}

#[test]
fn files_in_memory_stay_with_the_scene_through_edits() {
    let (description, assets) = in_memory();
    let before = description.build_with(Path::new("tent.xml"), assets).expect("it is valid");
    let rebuild = |description: &Arc<SceneDescription>, before: &Scene| {
        description.rebuild(Path::new(""), before, Precision::Exact).unwrap_or_else(|error| panic!("{}", error.report()))
    };
    let without = Arc::new(SceneDescription { objects: Vec::new(), ..(*description).clone() });
    let empty = rebuild(&without, &before);
    let again = rebuild(&description, &empty);
    let made = |scene: &Scene| ["meshes", "skies", "images"].map(|part| scene.compiled.made(part));
    assert_eq!((made(&before), made(&again)), ([1, 1, 1], [1, 0, 0]), "a mesh that was gone is made of the same data");
    assert!(picture(&before, &threads()) == picture(&again, &threads()));
    assert_eq!(made(&rebuild(&description, &again)), [0; 3]);
}

#[test]
fn a_mesh_in_memory_that_cannot_be_rendered_is_an_error_with_its_name() {
    let (description, mut assets) = in_memory();
    assets.insert("meshes/tent.ply", Model { triangles: vec![[0, 1, 9]], ..tent() });
    let error = description.build_with(Path::new("tent.xml"), assets.clone()).err().expect("it is refused").to_string();
    assert!(error.contains("tent.xml") && error.contains("meshes/tent.ply") && error.contains("vertex 9"), "{error}");
    assets.insert("meshes/tent.ply", tent());
    assets.insert("textures/gradient.png", b"no image".to_vec());
    let error = description.build_with(Path::new("tent.xml"), assets).err().expect("it is refused").to_string();
    assert!(error.contains("textures/gradient.png") && error.contains("not an image"), "{error}");
}

#[test]
fn a_scene_of_files_is_converted_with_copies_of_them() {
    let shell = Shell::new();
    let original = scene("textures_and_bump");
    let done = shell.run(&["convert", &original, "-o", "copy.toml"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert!(text(&done.stdout).contains("copied to copy.files"), "{}", text(&done.stdout));
    let render = |scene: &str, image: &str| {
        let done = shell.run(&["render", scene, "-o", image, "--spp", "1", "--size", "24x16"]);
        assert!(done.status.success(), "{}", text(&done.stderr));
        read(&shell.path(image)).expect("an image").radiance
    };
    assert!(render(&original, "a.exr") == render("copy.toml", "b.exr"));
    // Nothing has to be copied a second time.
    let done = shell.run(&["convert", "copy.toml", "-o", "again.toml"]);
    assert!(done.status.success() && !shell.path("again.files").exists(), "{}", text(&done.stdout));
    assert!(render("again.toml", "c.exr") == render("copy.toml", "b.exr"));
}

#[test]
fn mistakes_of_a_conversion_are_told_before_anything_is_written() {
    let shell = Shell::new();
    let furnace = scene("furnace");
    fs::copy(&furnace, shell.path("own.toml")).expect("it is copied");
    let onto_itself = shell.run(&["convert", "own.toml", "-o", "./own.toml"]);
    assert_eq!(onto_itself.status.code(), Some(2));
    assert!(text(&onto_itself.stderr).contains("would replace the scene itself"));
    for (name, message) in [("a.blend", "must end in .toml, .xml, .gltf or .glb"), ("nowhere/a.toml", "there is no folder")] {
        let done = shell.run(&["convert", &furnace, "-o", name]);
        assert_eq!(done.status.code(), Some(if name.ends_with("blend") { 2 } else { 1 }));
        assert!(text(&done.stderr).contains(message), "{}", text(&done.stderr));
    }
    assert_eq!(fs::read_dir(shell.folder()).expect("a folder").count(), 1);
}

#[test]
fn a_scene_that_is_written_for_mitsuba_and_read_again_has_the_same_picture() {
    let shell = Shell::new();
    let original = scene("glass_and_mirror");
    let done = shell.run(&["convert", &original, "-o", "copy.xml", "--strict"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let render = |scene: &str, image: &str| {
        let done = shell.run(&["render", scene, "-o", image, "--spp", "16", "--size", "48x32"]);
        assert!(done.status.success(), "{}", text(&done.stderr));
        read(&shell.path(image)).expect("an image").radiance
    };
    let (ours, theirs) = (render(&original, "a.exr"), render("copy.xml", "b.exr"));
    // The samples are the same but for rounding, so the difference of a pixel has mean 0: 5 standard errors.
    let differences: Vec<f64> =
        ours.as_flattened().iter().zip(theirs.as_flattened()).map(|(a, b)| f64::from(*a) - f64::from(*b)).collect();
    let count = differences.len() as f64;
    let mean = differences.iter().sum::<f64>() / count;
    let variance = differences.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / (count - 1.0);
    assert!(mean.abs() <= 5.0 * (variance / count).sqrt() + 1e-6, "{mean} ± {}", (variance / count).sqrt());
}

#[test]
fn parts_that_mitsuba_lacks_cause_a_warning_or_with_strict_an_error() {
    let shell = Shell::new();
    let original = scene("isosurfaces");
    let strict = shell.run(&["convert", &original, "-o", "copy.xml", "--strict"]);
    assert_eq!(strict.status.code(), Some(1));
    let message = text(&strict.stderr);
    assert!(
        message.contains("copy.xml") && message.contains("not written exactly") && message.contains("an isosurface"),
        "{message}"
    );
    assert_eq!(fs::read_dir(shell.folder()).expect("a folder").count(), 0);
    let done = shell.run(&["convert", &original, "-o", "copy.xml"]);
    assert!(done.status.success() && text(&done.stderr).contains("an isosurface"), "{}", text(&done.stderr));
    assert!(shell.path("copy.xml").exists());
}

#[test]
fn options_of_other_formats_are_checked_and_do_nothing_to_a_scene_of_ours() {
    let shell = Shell::new();
    let furnace = scene("furnace");
    let done = shell.run(&["check", &furnace, "-D", "spp=16", "--at", "1.5", "--strict"]);
    assert!(done.status.success() && text(&done.stderr).contains("-D affects scenes of Mitsuba only"), "{}", text(&done.stderr));
    for wrong in [&["-D", "spp"][..], &["--at", "noon"]] {
        assert_eq!(shell.run(&[&["check", &furnace], wrong].concat()).status.code(), Some(2));
    }
}

const TENT: &str = "mtllib tent.mtl\no tent\nv -0.5 0 0\nv 0.5 0 0.1\nv 0 0.75 -0.3\nusemtl red\nf 1 2 3\n";

#[test]
fn a_mesh_file_is_a_scene_for_every_command() {
    let shell = Shell::new();
    fs::write(shell.path("tent.obj"), TENT).expect("it is written");
    fs::write(shell.path("tent.mtl"), "newmtl red\nKd 0.6 0.1 0.1\n").expect("it is written");
    let opened = import::open(&shell.path("tent.obj"), &Default::default()).unwrap_or_else(|error| panic!("{}", error.report()));
    assert!(opened.scene.source.contains("format = 1") && !opened.scene.objects.is_empty());
    let run = |arguments: &[&str]| {
        let done = shell.run(arguments);
        assert!(done.status.success(), "{arguments:?}: {}", text(&done.stderr));
        text(&done.stdout)
    };
    assert!(run(&["check", "tent.obj"]).contains("tent.obj: ok"));
    assert!(run(&["convert", "tent.obj", "-o", "tent.toml"]).contains("tent.toml: "));
    for (scene, image) in [("tent.obj", "a.exr"), ("tent.toml", "b.exr")] {
        run(&["render", scene, "-o", image, "--spp", "2", "--size", "24x16"]);
    }
    let radiance = |image: &str| read(&shell.path(image)).expect("an image").radiance;
    assert!(radiance("a.exr") == radiance("b.exr"));
    run(&["render", "tent.obj", "--pixel", "12,8"]);
    run(&["sheet", "tent.obj", "-o", "sheet.png", "--spp", "1", "--size", "16x16"]);
}
