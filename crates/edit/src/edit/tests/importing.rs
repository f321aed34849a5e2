//! Adding meshes and skies from files.
use std::path::Path as FilePath;

use glam::DVec3;

use super::*;
use crate::edit::Placement;
use noisefall_scene::{
    light::environment::{EnvironmentDescription, image::Image},
    shape::Transform,
};

/// A box of 2 × 1 × 2 m that begins 3 m above the origin of its file.
const BOUNDS: [DVec3; 2] = [DVec3::new(0.0, 3.0, 0.0), DVec3::new(2.0, 4.0, 2.0)];

/// Where a mesh with a size in the file is put, by its transforms.
fn transforms(at: DVec3, normal: DVec3, unit: f64) -> Vec<Transform> {
    let mut document = room();
    let scene = document.description().build(FilePath::new("")).unwrap_or_else(|error| panic!("{}", error.report()));
    let placement = Placement { at, normal, extent: 5.0 };
    let (edit, path) = document.add_mesh("some/chair.obj", BOUNDS.map(|corner| corner * unit), placement, &scene);
    does(&mut document, &edit);
    assert_eq!(path, Path::of("objects.3"));
    let object = &document.description().objects[3];
    assert_eq!((object.name.as_str(), object.material.as_deref()), ("chair", Some("floor")), "the first diffuse material");
    object.transform.clone()
}

#[test]
fn a_mesh_stands_on_the_point_of_a_floor() {
    let at = DVec3::new(1.0, 0.5, -1.0);
    assert_eq!(transforms(at, DVec3::Y, 1.0), [Transform::Translate(DVec3::new(0.0, -2.5, -2.0))]);
}

#[test]
fn a_mesh_of_another_unit_is_scaled_by_a_power_of_ten() {
    let at = DVec3::new(1.0, 0.0, -1.0);
    let [Transform::Scale(factor), Transform::Translate(by)] = &transforms(at, DVec3::Y, 1000.0)[..] else {
        panic!("it is scaled and moved")
    };
    assert_eq!((*factor, *by), (DVec3::splat(1e-3), DVec3::new(0.0, -3.0, -2.0)));
}

#[test]
fn at_a_wall_it_stands_before_it_on_the_floor_and_in_the_air_below() {
    // Half of its width away from the wall, with the floor 1.5 m below.
    let by = |at, normal| match &transforms(at, normal, 1.0)[..] {
        [Transform::Translate(by)] => *by,
        other => panic!("{other:?}"),
    };
    let feet = DVec3::new(1.0, 3.0, 1.0);
    assert!((by(DVec3::new(-1.9, 1.5, 1.0), DVec3::X) + feet).distance(DVec3::new(-0.9, 0.0, 1.0)) < 2e-3);
    assert!((by(DVec3::new(1.0, 1.0, 1.0), DVec3::ZERO) + feet).distance(DVec3::new(1.0, 0.0, 1.0)) < 2e-3);
    assert!((by(DVec3::new(9.0, 1.0, 1.0), DVec3::ZERO) + feet).distance(DVec3::new(9.0, 1.0, 1.0)) < 2e-3, "no floor");
}

#[test]
fn a_sky_replaces_the_environment_or_is_added() {
    let mut document = room();
    for path in ["sky.hdr", "other.exr"] {
        let start = document.text();
        let edit = document.set_sky(path);
        let inverse = document.apply(&edit).expect("it can be made");
        let sky = EnvironmentDescription::Image(Image { path: path.to_owned(), ..Image::default() });
        assert_eq!(document.description().environment, Some(sky));
        let again = document.apply(&inverse).expect("it can be taken back");
        assert_eq!(document.text(), start);
        does(&mut document, &again);
    }
}

#[test]
fn the_colour_of_a_material_is_its_first_one_that_takes_a_texture() {
    let document = room();
    assert_eq!(document.colour_of_material("white"), Some(Path::of("materials.white.lambertian.albedo")));
    assert_eq!(document.colour_of_material("gold"), Some(Path::of("materials.gold.conductor.f0")));
    assert_eq!(document.colour_of_material("none"), None);
}
