//! Dropping objects onto what is below.
use super::*;
use noisefall_scene::{
    scene::description::ObjectDescription,
    shape::{ShapeKind, Transform, rectangle::Rectangle, sphere::Sphere},
};

#[test]
fn objects_are_dropped_onto_the_surface_below() {
    let mut document = room();
    let lift = |by: f64| Transform::Translate(DVec3::Y * by);
    for by in [0.75, -0.2] {
        let edit = document.transformed(1, &lift(by), DVec3::ZERO).expect("there is such an object");
        does(&mut document, &edit);
        let edit = document.drop_to_floor(&compiled(&document), 1).expect("the floor is below");
        does(&mut document, &edit);
        let [min, _] = extent(&document, "ball");
        assert!(min.y.abs() < 1e-6, "{min}");
    }
    // A light falls onto the ball.
    let edit = document.drop_to_floor(&compiled(&document), 2).expect("the ball is below");
    does(&mut document, &edit);
    let [min, _] = extent(&document, "light");
    assert!((min.y - 1.0).abs() < 0.01, "{min}");
    // Below the floor is nothing.
    assert!(document.drop_to_floor(&compiled(&document), 0).is_none());
}

#[test]
fn objects_beside_a_dropped_one_do_not_raise_it() {
    let mut document = room();
    // Its box reaches into the ball of the room, which it does not touch.
    let pearl = ShapeKind::from(Sphere { center: DVec3::new(0.6, 0.7, 0.6), radius: 0.3 });
    let mut pearl = ObjectDescription { shape: pearl, ..Default::default() };
    does(&mut document, &Edit::insert_tree(path("objects.3"), Tree::of(&mut pearl)));
    let edit = document.drop_to_floor(&compiled(&document), 3).expect("the floor is below");
    does(&mut document, &edit);
    let ShapeKind::Sphere(pearl) = &document.description().objects[3].shape else { panic!("it is a ball") };
    assert_eq!(pearl.center, DVec3::new(0.6, 0.3, 0.6), "to the last digit");
    // No vertical ray meets an upright sheet.
    let origin = DVec3::new(-0.9, 0.4, 0.9);
    let sheet = ShapeKind::from(Rectangle { origin, edge_u: DVec3::X * 0.2, edge_v: DVec3::Y * 0.5 });
    let mut sheet = ObjectDescription { shape: sheet, ..Default::default() };
    does(&mut document, &Edit::insert_tree(path("objects.4"), Tree::of(&mut sheet)));
    let edit = document.drop_to_floor(&compiled(&document), 4).expect("the floor is below");
    does(&mut document, &edit);
    let ShapeKind::Rectangle(sheet) = &document.description().objects[4].shape else { panic!("it is a rectangle") };
    assert_eq!(sheet.origin, DVec3::new(-0.9, 0.0, 0.9));
}
