//! Adding and posing objects.
use glam::{DAffine3, DVec3};

use super::*;
use crate::edit::Placement;
use noisefall_base::declare::OneOf;
use noisefall_scene::{
    light::punctual_light::PunctualLightKind,
    scene::description::PunctualLightDescription,
    shape::{Rotation, ShapeKind, Transform, product},
};

fn name_of(document: &Document) -> String {
    document.description().objects.last().expect("there are objects").name.clone()
}

#[test]
fn every_shape_is_added_to_every_side_of_a_surface() {
    let at = DVec3::new(0.3217, 0.0, -0.41);
    for kind in ShapeKind::alternatives() {
        for normal in [DVec3::Y, DVec3::NEG_Y, DVec3::X, DVec3::NEG_Z, DVec3::new(0.6, 0.0, 0.8)] {
            let placement = Placement { at, normal, extent: 5.0 };
            let mut document = room();
            let (edit, path) = document.add_shape(kind.name(), &placement, None).expect("there is such a kind");
            does(&mut document, &edit);
            assert_eq!(path, Path::of("objects.3"));
            assert_eq!(document.description().objects[3].material.as_deref(), Some("floor"), "the first diffuse one");
            let [min, max] = extent(&document, &name_of(&document));
            let size = (max - min).max_element();
            assert!((0.25..1.5).contains(&size), "{} {normal}: {size}", kind.name());
            // The side towards the surface is at it, to the rounding of coordinates; knots do not fill their cube.
            let near = (0..8)
                .map(|corner| DVec3::from([0, 1, 2].map(|axis| if corner >> axis & 1 == 0 { min[axis] } else { max[axis] })));
            let height = near.map(|corner| (corner - at).dot(normal)).fold(f64::INFINITY, f64::min);
            let is_filled = !matches!(kind, ShapeKind::Mesh(_) | ShapeKind::SphereField(_) | ShapeKind::Isosurface(_));
            let is_axis = normal.abs().max_element() == 1.0;
            assert!(height > -0.5 && (!is_axis || height > -0.01), "{} {normal}: {height}", kind.name());
            assert!(!is_filled || !is_axis || height < 0.01, "{} {normal}: {height}", kind.name());
            let [x, y, z] = min.to_array();
            assert!(x.is_finite() && y.is_finite() && z.is_finite());
        }
    }
}

#[test]
fn lights_emit_away_from_the_surface_behind_them() {
    let placement = Placement { at: DVec3::new(0.0, 2.5, 0.0), normal: DVec3::NEG_Y, extent: 5.0 };
    let mut document = room();
    let (edit, _) = document.add_light("rectangle", &placement, 0.0).expect("there is such a kind");
    does(&mut document, &edit);
    assert_eq!(name_of(&document), "light 2");
    let ShapeKind::Rectangle(light) = &document.description().objects[3].shape else { panic!("it is a rectangle") };
    assert!(light.edge_u.cross(light.edge_v).normalize().distance(DVec3::NEG_Y) < 1e-9);
    let [_, max] = extent(&document, "light 2");
    assert!(max.y < 2.5 && max.y > 2.49);
}

#[test]
fn new_lights_are_as_bright_as_the_exposure_needs() {
    let placement = Placement { at: DVec3::new(0.0, 2.5, 0.0), normal: DVec3::NEG_Y, extent: 5.0 };
    for (exposure, brightness) in [(0.0, 20.0), (3.0, 2.5), (-10.0, 2e4)] {
        let mut document = room();
        let (edit, path) = document.add_light("sphere", &placement, exposure).expect("there is such a kind");
        does(&mut document, &edit);
        assert_eq!(document.value(&path.key("emission").key("radiance")), Some(OwnedValue::Colour([brightness; 3])));
    }
}

fn punctual_light(document: &Document, place: usize) -> PunctualLightDescription {
    document.description().punctual_lights[place].clone()
}

#[test]
fn lights_without_surface_are_added_duplicated_renamed_and_deleted() {
    let placement = Placement { at: DVec3::new(0.3, 0.0, -0.4), normal: DVec3::Y, extent: 5.0 };
    for kind in PunctualLightKind::alternatives() {
        let mut document = room();
        let before = document.text();
        let (edit, added) = document.add_punctual_light(kind.name(), &placement, 1.0, 0.0).expect("there is such a kind");
        let inverse = does(&mut document, &edit);
        assert_eq!(added, path("lights.0"));
        assert!(document.text().contains("[[lights]]"), "{}", document.text());
        let found = punctual_light(&document, 0);
        assert_eq!((found.name.as_str(), found.kind.name()), (kind.name(), kind.name()));
        assert!(found.position().is_none_or(|position| position.distance(DVec3::new(0.3, 1.0, -0.4)) < 1e-9), "{found:?}");
        let scene = compiled(&document);
        assert_eq!((scene.punctual_lights.len(), scene.lights.punctual_lights.len()), (1, 1));
        let (edit, copy) = document.duplicate(&added).expect("it is there");
        let duplicated = does(&mut document, &edit);
        assert_eq!((copy, punctual_light(&document, 1).name), (path("lights.1"), format!("{} 2", kind.name())));
        does(&mut document, &text("lights.1.name", "other"));
        does(&mut document, &text("lights.1.name", &format!("{} 2", kind.name())));
        does(&mut document, &duplicated);
        does(&mut document, &inverse);
        assert_eq!(document.text(), before);
    }
    assert!(room().add_punctual_light("candle", &placement, 1.0, 0.0).is_none());
}

#[test]
fn the_kind_and_the_parameters_of_a_light_change_by_their_paths() {
    let placement = Placement { at: DVec3::ZERO, normal: DVec3::Y, extent: 5.0 };
    let mut document = room();
    let (edit, added) = document.add_punctual_light("point", &placement, 1.0, 0.0).expect("there is such a kind");
    does(&mut document, &edit);
    does(&mut document, &Edit::set(path("lights.0.point.intensity"), OwnedValue::Colour([3.0, 2.0, 1.0])));
    let spot = document.change_kind(&added, PunctualLightKind::WHAT, "spot");
    does(&mut document, &spot);
    let PunctualLightKind::Spot(spot) = punctual_light(&document, 0).kind else { panic!("it is a spot") };
    assert_eq!((spot.intensity, spot.position.y), ([3.0, 2.0, 1.0], 1.0), "it keeps what both have");
    let problem = refuses(&mut document, &Edit::set(path("lights.0.spot.target"), OwnedValue::Vector(spot.position)));
    assert!(problem.message.contains("the same point"), "{problem:?}");
}

#[test]
fn lights_are_transformed_as_their_points_are() {
    let placement = Placement { at: DVec3::new(0.5, 0.0, 0.0), normal: DVec3::Y, extent: 5.0 };
    let changes = [
        Transform::Translate(DVec3::new(0.5, -0.25, 1.0)),
        Transform::Rotate(Rotation { axis: DVec3::Z, degrees: 90.0 }),
        Transform::Scale(DVec3::new(-1.0, 1.0, 1.0)),
        Transform::Translate(DVec3::X),
    ];
    let pivot = DVec3::new(0.2, 0.3, -0.1);
    for kind in PunctualLightKind::alternatives() {
        let mut document = room();
        let (edit, _) = document.add_punctual_light(kind.name(), &placement, 1.0, 0.0).expect("there is such a kind");
        does(&mut document, &edit);
        let mut position = punctual_light(&document, 0).position();
        for change in &changes {
            let edit = document.transformed_light(0, change, pivot).expect("it can be transformed");
            does(&mut document, &edit);
            let map = DAffine3::from_translation(pivot)
                * product(std::slice::from_ref(change)).expect("it is valid")
                * DAffine3::from_translation(-pivot);
            position = position.map(|p| map.transform_point3(p));
            let found = punctual_light(&document, 0).position();
            assert!(found.zip(position).is_none_or(|(a, b)| a.distance(b) < 1e-9), "{}: {found:?} {position:?}", kind.name());
            compiled(&document);
        }
        // Until it was mirrored, only its points changed.
        assert!(!punctual_light(&document, 0).transform.is_empty());
    }
    assert!(room().transformed_light(0, &changes[0], pivot).is_none());
}

#[test]
fn a_scene_without_materials_gets_one() {
    let bare = "format = 1\ncamera = { eye = [0, 0, 4], look_at = [0, 0, 0], fov = 40, resolution = [64, 64] }\nobjects = []\n";
    let mut document = Document::untitled(bare).unwrap_or_else(|error| panic!("{}", error.report()));
    let placement = Placement { at: DVec3::ZERO, normal: DVec3::Y, extent: 1.0 };
    let (edit, _) = document.add_shape("sphere", &placement, None).expect("there is such a kind");
    let inverse = does(&mut document, &edit);
    assert!(document.text().contains("grey"), "{}", document.text());
    compiled(&document);
    does(&mut document, &inverse);
    assert_eq!(document.text(), bare);
    assert!(document.add_shape("dodecahedron", &placement, None).is_none());
}

#[test]
fn names_that_are_free() {
    let mut document = room();
    assert_eq!(document.free_name("objects", "sphere"), "sphere");
    assert_eq!(document.free_name("objects", "ball"), "ball 2");
    does(&mut document, &text("objects.0.name", "ball 2"));
    assert_eq!(document.free_name("objects", "ball"), "ball 3");
    assert_eq!(document.free_name("objects", "ball 2"), "ball 3");
    assert_eq!(document.free_name("materials", "gold"), "gold 2");
}

/// Shapes of all kinds, moved by edits as by the map.
#[test]
fn objects_are_transformed_as_their_points_are() {
    let rotation = Transform::Rotate(Rotation { axis: DVec3::new(1.0, 2.0, 0.5), degrees: 33.0 });
    let changes = [
        Transform::Translate(DVec3::new(0.5, -0.25, 1.0)),
        Transform::Scale(DVec3::splat(1.5)),
        rotation.clone(),
        Transform::Scale(DVec3::new(0.5, 2.0, 1.25)),
        rotation,
        Transform::Translate(DVec3::new(0.0, 1.0, 0.0)),
    ];
    let pivot = DVec3::new(0.2, 0.3, -0.1);
    for kind in ShapeKind::alternatives() {
        let placement = Placement { at: DVec3::ZERO, normal: DVec3::Y, extent: 5.0 };
        let mut document = room();
        let (edit, _) = document.add_shape(kind.name(), &placement, None).expect("there is such a kind");
        does(&mut document, &edit);
        for change in &changes {
            let shapes = |document: &Document| -> Vec<noisefall_scene::geometry::Shape> {
                let scene = compiled(document);
                let name = name_of(document);
                let of_name = |object: &noisefall_scene::scene::Object| object.name.starts_with(&name);
                scene.objects.iter().filter(|object| of_name(object)).map(|object| object.shape.clone()).collect()
            };
            let map = product(&[Transform::Translate(-pivot), change.clone(), Transform::Translate(pivot)]);
            let map = map.expect("it can be inverted");
            let expected: Vec<_> = shapes(&document).iter().map(|shape| shape.transformed(&map)).collect();
            let edit = document.transformed(3, change, pivot).expect("there is such an object");
            does(&mut document, &edit);
            for (expected, found) in expected.iter().zip(shapes(&document)) {
                let ([a, b], [c, d]) = (expected.corners(), found.corners());
                let off = a.distance(c).max(b.distance(d));
                let is_field = matches!(kind, ShapeKind::SphereField(_));
                assert!(off < if is_field { 1e-6 } else { 1e-9 }, "{} {change:?}: {a} {b}, {c} {d}", kind.name());
            }
        }
        let transforms = document.description().objects[3].transform.len();
        assert!(transforms <= 6, "{}: {transforms}", kind.name());
    }
}

#[test]
fn turning_by_the_mouse_makes_one_transform() {
    let mut document = room();
    for degrees in [10.0, 5.0, -2.0] {
        let turn = Transform::Rotate(Rotation { axis: DVec3::Y, degrees });
        let edit = document.transformed(1, &turn, DVec3::new(0.0, 0.5, 0.0)).expect("there is such an object");
        does(&mut document, &edit);
    }
    let [Transform::Rotate(turn)] = &document.description().objects[1].transform[..] else { panic!("it is one rotation") };
    assert_eq!(turn.degrees, 13.0);
}

/// A room of 2.5 m with a ball on its floor, closed above.
fn closed_room() -> Document {
    let mut document = room();
    let ceiling = ShapeKind::from(noisefall_scene::shape::rectangle::Rectangle {
        origin: DVec3::new(-2.0, 2.6, -2.0),
        edge_u: DVec3::X * 4.0,
        edge_v: DVec3::Z * 4.0,
    });
    let mut ceiling = noisefall_scene::scene::description::ObjectDescription { shape: ceiling, ..Default::default() };
    does(&mut document, &Edit::insert_tree(path("objects.3"), Tree::of(&mut ceiling)));
    document
}

#[test]
fn objects_that_are_added_at_a_wall_stand_on_the_floor_and_lights_hang_over_it_facing_down() {
    let scene = compiled(&closed_room());
    let wall = Placement { at: DVec3::new(-1.5, 1.2, -1.0), normal: DVec3::X, extent: 5.0 };
    let floor = wall.on_floor(&scene, 0.5);
    assert!(floor.at.distance(DVec3::new(-1.0, 0.0, -1.0)) < 1e-5 && floor.normal == DVec3::Y, "{floor:?}");
    for placement in [wall, floor] {
        let hung = placement.hung(&scene);
        assert!((0.9..=1.1).contains(&hung.at.y) && hung.normal == DVec3::NEG_Y, "{hung:?}");
        let mut document = closed_room();
        let (edit, at) = document.add_light("rectangle", &hung, 0.0).expect("there is such a kind");
        does(&mut document, &edit);
        let ShapeKind::Rectangle(light) = &document.description().objects[4].shape else { panic!("it is a rectangle") };
        assert!(light.edge_u.cross(light.edge_v).normalize().distance(DVec3::NEG_Y) < 1e-9, "{at}");
    }
    let ceiling = Placement { at: DVec3::new(0.5, 2.6, 0.5), normal: DVec3::NEG_Y, extent: 5.0 };
    assert_eq!(ceiling.hung(&scene).at, ceiling.at, "lights hang on it");
    // Where there is little room above, a light is lower.
    let low = Placement { at: DVec3::new(0.0, 2.1, 0.0), normal: DVec3::Y, extent: 5.0 };
    assert!((low.light_height(&scene) - 0.6 * 0.4).abs() < 1e-3, "{}", low.light_height(&scene));
}
