//! The list of parts and the parameters below it: each scrolls by itself, and a handle divides the room.
use super::*;
use crate::viewer::panels::outliner::New;

/// A window with many objects, one material of which is selected.
fn long_scene() -> Window {
    let mut window = window("cornell_spheres");
    (0..60).for_each(|_| window.state_mut().add(New::Shape("sphere")));
    click(&mut window, "Edit");
    window.state_mut().selection.select(Some(Subject::Material("amber".to_owned())));
    window.run_steps(4);
    window
}

#[test]
fn the_parameters_are_in_sight_however_long_the_list_is() {
    let mut window = long_scene();
    for [width, height] in [[1280.0, 800.0], [900.0, 600.0]] {
        window.set_size(vec2(width, height));
        window.run_steps(6);
        let [parts, parameters, albedo] = ["Parts", "amber", "Albedo ρ"].map(|label| window.get_all_by_label(label).next());
        let [parts, parameters, albedo] = [parts, parameters, albedo].map(|node| node.expect("it is there").rect());
        assert!(parts.bottom() + 120.0 < parameters.top(), "the list has room at {height}");
        // The line of figures is below.
        assert!(albedo.bottom() < height - 30.0 && albedo.right() < width, "{albedo:?} at {width} × {height}");
    }
}

#[test]
fn the_handle_divides_the_room_and_stays_where_it_was_left() {
    let mut window = long_scene();
    window.set_size(vec2(1280.0, 800.0));
    window.run_steps(4);
    let top = |window: &Window| window.get_by_role_and_label(Role::Label, "amber").rect().top();
    let before = top(&window);
    let handle = [1280.0 - 168.0, before];
    let above = (0..20).map(|step| handle[1] - step as f32);
    // The line lies a few points above the title.
    let moved = above.into_iter().find(|y| {
        drag(&mut window, PointerButton::Primary, [handle[0], *y], [handle[0], *y - 150.0]);
        top(&window) < before - 100.0
    });
    assert!(moved.is_some(), "nothing was dragged near {handle:?}");
    let after = top(&window);
    click(&mut window, "Render");
    click(&mut window, "Edit");
    window.run_steps(3);
    assert!((top(&window) - after).abs() < 1.0);
}
