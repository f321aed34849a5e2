//! A new bump map is visible at once.
use noisefall_base::declare::{OwnedValue, Path};
use noisefall_edit::edit::Tree;
use noisefall_scene::scene::Scene;

use super::{
    edited::{bits, description, edits, select},
    selection::AMBER_BALL,
    *,
};

/// The mean angle between the shading normals of an object in two scenes, degrees.
fn tilt(window: &Window, [before, after]: [&Scene; 2], object: &str) -> f64 {
    let camera = window.state().camera();
    let [before, after] = [before, after].map(|scene| {
        noisefall_kernel::integrator::features(SimdLevel::best(), scene, &camera, &|| false).expect("they are found")
    });
    let dot = |a: [f32; 3], b: [f32; 3]| f64::from(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
    let scene = &window.state().opened().as_ref().expect("it is open").scene;
    let is_of = |place: &usize| scene.objects.get(before.object[*place] as usize).is_some_and(|found| found.name == object);
    let angles: Vec<f64> = (0..before.normal.len())
        .filter(is_of)
        .map(|place| dot(before.normal[place], after.normal[place]).clamp(-1.0, 1.0).acos().to_degrees())
        .collect();
    assert!(angles.len() > 50, "{object} is in the image");
    angles.iter().sum::<f64>() / angles.len() as f64
}

#[test]
fn a_bump_map_that_is_ticked_tilts_the_normals_of_small_and_of_large_objects() {
    for (material, object) in [("amber", "amber ball"), ("white", "back wall")] {
        let mut window = window("cornell_spheres");
        let scene = |window: &Window| window.state().opened().as_ref().expect("it is open").scene.clone();
        let (before, start) = (scene(&window), bits(&window));
        select(&mut window, Subject::Material(material.to_owned()));
        edits(&mut window, "the bumps", |w| check_box(w, "Bump"));
        let angle = tilt(&window, [&before, &scene(&window)], object);
        assert!((5.0..40.0).contains(&angle), "{object}: {angle:.1}°");
        assert_eq!(window.state().history.names()[0].as_deref(), Some(&*format!("addition of bump to {material}")));
        undo(&mut window);
        assert!(bits(&window).is_identical(&start), "bump and texture are one step");
    }
}

#[test]
fn a_bump_map_has_a_texture_of_its_own() {
    let mut window = window("cornell_spheres");
    assert_eq!(description(&window).objects[AMBER_BALL].material.as_deref(), Some("amber"));
    window.state_mut().add(crate::viewer::panels::outliner::New::Texture);
    select(&mut window, Subject::Material("amber".to_owned()));
    check_box(&mut window, "Bump");
    let texture = Tree::at(&mut description(&window).clone(), &Path::of("materials.amber.bump.texture"));
    assert_eq!(texture.and_then(|tree| tree.value().cloned()), Some(OwnedValue::Text("bumps".to_owned())));
    assert!(description(&window).textures.contains_key("bumps"), "and not the checker that is there");
}
