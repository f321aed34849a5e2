//! The camera by numbers, mouse and keys.
use super::*;

#[test]
fn the_camera_moves_by_numbers_by_mouse_and_by_keys() {
    let mut window = window("cornell_spheres");
    let start = window.state().camera();
    restarts(&mut window, "another field of view", |w| {
        w.get_by_role_and_label(Role::Slider, "Field of view").set_value_accesskit(60.0);
        w.run_steps(2);
    });
    assert_eq!(window.state().camera().fov, 60.0);
    restarts(&mut window, "a pixel filter", |w| click(w, "Gaussian"));
    assert_eq!(window.state().camera().filter, Filter::GAUSSIAN);
    restarts(&mut window, "a lens", |w| {
        w.get_by_role_and_label(Role::SpinButton, "Lens radius").set_value_accesskit(0.05);
        w.run_steps(2);
    });
    restarts(&mut window, "another focus", |w| {
        w.get_by_role_and_label(Role::SpinButton, "Focus").set_value_accesskit(2.0);
        w.run_steps(2);
    });
    assert_eq!(window.state().camera().lens, Some(Lens { radius: 0.05, focus: 2.0 }));
    restarts(&mut window, "parallel rays", |w| click(w, "Orthographic"));
    assert!(window.state().camera().projection != Projection::Perspective && window.state().camera().lens.is_none());
    restarts(&mut window, "perspective", |w| click(w, "Perspective"));
    window.get_by_role_and_label(Role::Button, "Camera").click();
    window.run_steps(3);
    assert_eq!(window.state().tool(), Tool::Camera);
    restarts(&mut window, "an orbit", |w| drag(w, PointerButton::Primary, [400.0, 400.0], [440.0, 420.0]));
    let orbited = window.state().camera();
    assert!((orbited.eye.distance(orbited.look_at) - start.eye.distance(start.look_at)).abs() < 1e-9);
    assert_ne!(orbited.eye, start.eye);
    restarts(&mut window, "a pan", |w| drag(w, PointerButton::Secondary, [400.0, 400.0], [380.0, 400.0]));
    assert_ne!(window.state().camera().look_at, start.look_at);
    let distance = |window: &Window| window.state().camera().eye.distance(window.state().camera().look_at);
    let before = distance(&window);
    restarts(&mut window, "a dolly", |w| scroll(w, [400.0, 400.0], 40.0));
    assert!(distance(&window) < before);
    let before = window.state().camera();
    restarts(&mut window, "flight", |w| {
        w.key_down(Key::W);
        w.run_steps(5);
        w.key_up(Key::W);
        w.run_steps(2);
    });
    let moved = window.state().camera().eye - before.eye;
    assert!(moved.normalize().dot(before.axes()[2]) > 0.999, "W flies forwards");
    restarts(&mut window, "the scene's camera", |w| {
        w.key_press(Key::Home);
        w.run_steps(2);
    });
    assert_eq!(window.state().camera().eye, start.eye);
}

#[test]
fn eye_look_at_up_and_resolution_can_be_typed() {
    let mut window = window("cornell_spheres");
    for (what, label) in [("an eye", "Eye"), ("a look-at", "Look at"), ("an up", "Up")] {
        restarts(&mut window, what, |w| {
            w.get_all_by_role_and_label(Role::SpinButton, label).next().expect("x comes first").set_value_accesskit(0.25);
            w.run_steps(2);
        });
    }
    let camera = window.state().camera();
    assert_eq!((camera.eye.x, camera.look_at.x, camera.up.x), (0.25, 0.25, 0.25));
    restarts(&mut window, "a width", |w| {
        w.get_all_by_role_and_label(Role::SpinButton, "Resolution")
            .next()
            .expect("the width comes first")
            .set_value_accesskit(120.0);
        w.run_steps(2);
    });
    wait(&mut window, "the new width", |app| {
        app.shown_frame().as_ref().is_some_and(|frame| frame.width == 120 && frame.height == 64)
    });
}
