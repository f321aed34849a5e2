//! Meshes, textures and skies are dropped on the window.
use noisefall_base::declare::{OwnedValue, Path, Textured};
use noisefall_edit::edit::Tree;
use noisefall_scene::{
    light::environment::{EnvironmentDescription, image::Image},
    material::Material,
    shape::{ShapeKind, mesh::MeshSource},
};

use super::{
    edited::{bits, description, edits},
    selection::{AMBER_BALL, ball, seen},
    *,
};
use crate::viewer::background::dropped::tests::hdr;

/// A file in a folder that lasts as long as the test.
fn file(folder: &tempfile::TempDir, name: &str, bytes: &[u8]) -> PathBuf {
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).expect("it is written");
    path
}

fn picture(folder: &tempfile::TempDir, name: &str) -> PathBuf {
    let path = folder.path().join(name);
    image::RgbImage::from_pixel(4, 4, image::Rgb([200, 30, 30])).save(&path).expect("it is written");
    path
}

/// Drops a file and waits for the image of the edited scene; then undo gives the scene before, and redo this one.
fn is_one_step(window: &mut Window, path: PathBuf) -> Option<usize> {
    let before = bits(window);
    edits(window, "the image with the file", |w| {
        drop_file(w, path);
        wait(w, "the edit", App::has_unsaved_changes);
    });
    let selected = window.state().selection.object();
    let after = bits(window);
    undo(window);
    assert!(bits(window).is_identical(&before));
    assert!(!window.state().has_unsaved_changes());
    redo(window);
    assert!(bits(window).is_identical(&after) && !after.is_identical(&before));
    selected
}

fn albedo(window: &Window) -> Textured {
    match &description(window).materials["amber"].kind {
        Material::Lambertian(diffuse) => diffuse.albedo.clone(),
        other => panic!("{other:?} is not diffuse"),
    }
}

fn messages(window: &Window) -> Vec<&str> {
    window.state().dialogs.notices.0.iter().map(|notice| notice.text.as_str()).collect()
}

#[test]
fn a_mesh_stands_on_the_floor_where_it_is_dropped() {
    let folder = tempfile::tempdir().expect("a folder");
    // A tetrahedron in millimetres.
    let mesh = file(&folder, "tent.obj", b"v -150 10 -150\nv 150 10 -150\nv 0 10 150\nv 0 310 0\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    let mut window = window("cornell_spheres");
    // Between the balls. A pixel there is 0.16 m deep.
    let spot = DVec3::new(0.0, 0.0, -0.85);
    let at = seen(&mut window, spot);
    window.hover_at(at);
    window.run_steps(2);
    let selected = is_one_step(&mut window, mesh.clone());
    assert_eq!(selected, Some(8), "it is selected");
    let objects = &description(&window).objects;
    let tent = objects.last().expect("there are objects");
    assert_eq!((objects.len(), tent.name.as_str(), tent.material.as_deref()), (9, "tent", Some("amber")));
    assert!(
        matches!(&tent.shape, ShapeKind::Mesh(of) if of.source == MeshSource::File(mesh.display().to_string())),
        "{:?}",
        tent.shape
    );
    wait(&mut window, "the compiled tent", |app| app.opened().as_ref().is_some_and(|opened| opened.scene.objects.len() == 9));
    let scene = &window.state().opened().as_ref().expect("it is open").scene;
    let [min, max] = scene.objects[scene.objects_of(8)][0].shape.corners();
    assert!(min.y.abs() < 2e-3 && (max.y - 0.3).abs() < 2e-3, "{min} {max}");
    assert!((0.5 * (min + max)).with_y(0.0).distance(spot) < 0.25, "{min} {max}");
}

#[test]
fn a_picture_becomes_the_colour_of_the_object_under_the_pointer() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window("cornell_spheres");
    window.state_mut().selection.select(Some(Subject::Object(0)));
    let at = seen(&mut window, ball());
    window.hover_at(at);
    window.run_steps(2);
    is_one_step(&mut window, picture(&folder, "red paint.png"));
    assert_eq!(albedo(&window), Textured::Texture("red paint".to_owned()));
    let mut texture = description(&window).textures["red paint"].clone();
    let tree = Tree::at(&mut texture, &Path::of("image.path")).expect("it is an image");
    let path = folder.path().join("red paint.png").display().to_string();
    assert_eq!(tree.value(), Some(&OwnedValue::Text(path)));
}

#[test]
fn without_an_object_under_the_pointer_it_is_that_of_the_selected_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window("cornell_spheres");
    window.event(egui::Event::PointerGone);
    window.state_mut().selection.select(Some(Subject::Object(AMBER_BALL)));
    window.run_steps(2);
    is_one_step(&mut window, picture(&folder, "paint.jpg"));
    assert_eq!(albedo(&window), Textured::Texture("paint".to_owned()));
}

#[test]
fn a_panorama_becomes_the_sky() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window("cornell_spheres");
    let sky = file(&folder, "sky.hdr", &hdr(8, 4));
    is_one_step(&mut window, sky.clone());
    let expected = EnvironmentDescription::Image(Image { path: sky.display().to_string(), ..Image::default() });
    assert_eq!(description(&window).environment, Some(expected));
    assert!(window.state().session.given_reference.is_none());
}

#[test]
fn unusable_files_change_nothing_and_are_reported_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window("cornell_spheres");
    window.event(egui::Event::PointerGone);
    window.run_steps(2);
    let before = bits(&window);
    let unknown = file(&folder, "notes.txt", b"milk");
    let broken = file(&folder, "broken.obj", b"v 1 2\n");
    let paint = picture(&folder, "paint.png");
    for (path, reason) in
        [(unknown, "notes.txt cannot be used. Drop a scene"), (broken, "broken.obj"), (paint, "Drop the texture on an object")]
    {
        window.state_mut().dialogs.notices.0.clear();
        drop_file(&mut window, path);
        wait(&mut window, "the message", |app| !app.dialogs.notices.0.is_empty());
        window.run_steps(3);
        assert!(messages(&window).len() == 1 && messages(&window)[0].contains(reason), "{:?}", messages(&window));
    }
    // A light without a material has no colour.
    window.state_mut().selection.select(Some(Subject::Object(7)));
    window.state_mut().dialogs.notices.0.clear();
    drop_file(&mut window, folder.path().join("paint.png"));
    wait(&mut window, "the message", |app| !app.dialogs.notices.0.is_empty());
    assert!(messages(&window)[0].contains("no material"), "{:?}", messages(&window));
    assert!(bits(&window).is_identical(&before) && !window.state().has_unsaved_changes());
}
