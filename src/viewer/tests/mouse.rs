//! Mouse and keys over the image: which way things move, by how much, and with which tool.
use noisefall_scene::scene::Camera;

use super::*;
use crate::viewer::{canvas::navigation, instruments::compare::comparison::CompareLayout};

/// The middle of the image, which fills the width of a window of 1280 × 1300.
const MIDDLE: [f32; 2] = [472.0, 600.0];

fn beside([x, y]: [f32; 2], dx: f32, dy: f32) -> [f32; 2] {
    [x + dx, y + dy]
}

/// Texts that are painted and no widgets, with their places.
fn painted(window: &Window) -> Vec<(String, Pos2)> {
    let texts = window.output().shapes.iter().filter_map(|clipped| match &clipped.shape {
        egui::Shape::Text(text) => Some((text.galley.text().to_owned(), text.pos)),
        _ => None,
    });
    texts.collect()
}

fn wheel(window: &mut Window, at: [f32; 2], by: f32, modifiers: Modifiers) {
    window.hover_at(at.into());
    window.run_steps(2);
    let event = egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        source: egui::MouseWheelSource::Wheel,
        delta: vec2(0.0, by),
        phase: egui::TouchPhase::Move,
        modifiers,
    };
    window.event_modifiers(event, modifiers);
    window.run_steps(10);
}

#[test]
fn the_pointer_is_over_the_pixel_that_lies_under_it() {
    let mut window = window("cornell_spheres");
    let zoom = window.state().picture_view().drawn_zoom;
    window.hover_at(MIDDLE.into());
    window.run_steps(2);
    let [x, y] = window.state().hovered().expect("it is over the image");
    assert!(x.abs_diff(48) <= 1, "the middle of 96: {x}");
    for (dx, dy) in [(7.0, 0.0), (0.0, 5.0), (-9.0, -4.0)] {
        window.hover_at(beside(MIDDLE, dx * zoom, dy * zoom).into());
        window.run_steps(2);
        let at = window.state().hovered().expect("it is over the image");
        assert_eq!([at[0] as f32 - x as f32, at[1] as f32 - y as f32], [dx, dy]);
    }
    // Its number stands in the line below.
    let ([x, y], frame) =
        (window.state().hovered().expect("as before"), window.state().shown_frame().clone().expect("it is shown"));
    let label = format!("({x}, {y})  RGB");
    assert!(window.query_all_by_label_contains(&label).count() == 1, "{label}");
    assert_eq!(frame.index_at([x, y]), Some((y * 96 + x) as usize));
}

#[test]
fn with_any_tool_ctrl_and_wheel_magnify_and_a_middle_drag_pans_unless_it_orbits() {
    for key in [Key::P, Key::C, Key::B, Key::I] {
        let mut window = window("furnace");
        window.key_press(key);
        window.run_steps(3);
        let fitted = window.state().picture_view().drawn_zoom;
        let at = beside(MIDDLE, 100.0, -60.0);
        window.hover_at(at.into());
        window.run_steps(2);
        let under = window.state().hovered();
        never_restarts(&mut window, |w| wheel(w, at, 60.0, Modifiers::COMMAND));
        assert!(window.state().picture_view().drawn_zoom > 1.1 * fitted, "{key:?}");
        assert_eq!(window.state().hovered(), under, "about the pointer");
        if key == Key::C {
            // It orbits.
            continue;
        }
        let before = window.state().picture_view().offset;
        never_restarts(&mut window, |w| drag(w, PointerButton::Middle, MIDDLE, beside(MIDDLE, 40.0, 20.0)));
        let moved = (window.state().picture_view().offset - before) * window.state().picture_view().drawn_zoom;
        assert!((moved - vec2(-40.0, -20.0)).length() < 0.5, "{key:?} {moved:?}");
    }
}

#[test]
fn the_wheel_and_a_drag_belong_to_the_tool() {
    let mut window = window("cornell_spheres");
    let start = window.state().camera();
    let fitted = window.state().picture_view().drawn_zoom;
    wheel(&mut window, MIDDLE, -40.0, Modifiers::NONE);
    assert!(window.state().picture_view().drawn_zoom < 0.95 * fitted && window.state().camera() == start);
    // A double click fits the image again.
    let press = |pressed| egui::Event::PointerButton {
        pos: MIDDLE.into(),
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    window.input_mut().events = [true, false, true, false].map(press).into();
    window.run_steps(2);
    assert_eq!(window.state().picture_view().zoom, None);
    window.key_press(Key::C);
    window.run_steps(2);
    wheel(&mut window, MIDDLE, -40.0, Modifiers::NONE);
    assert!(window.state().picture_view().zoom.is_none());
    let distance = |camera: &Camera| camera.eye.distance(camera.look_at);
    let farther = window.state().camera();
    assert!(distance(&farther) > 1.1 * distance(&start) && farther.look_at == start.look_at);
    window.state_mut().camera_mut().projection = Projection::orthographic(2.0);
    wheel(&mut window, MIDDLE, 40.0, Modifiers::NONE);
    let nearer = window.state().camera();
    assert!(
        nearer.eye == farther.eye && nearer.width_at_look_at() < 1.9 && !nearer.projection.has_angle(),
        "parallel rays: {nearer:?}"
    );
}

#[test]
fn the_look_at_point_follows_a_pan() {
    let mut window = window("cornell_spheres");
    window.key_press(Key::C);
    window.run_steps(2);
    let start = window.state().camera();
    // The image is 944 points wide.
    let width = window.state().picture_view().drawn_zoom * 96.0;
    let by = [0.05 * width, 0.03 * width];
    drag(&mut window, PointerButton::Secondary, MIDDLE, beside(MIDDLE, by[0], by[1]));
    let expected = navigation::pan(&start, 0.05, -0.03);
    assert!(window.state().camera().eye.distance(expected.eye) < 1e-3, "{} {}", window.state().camera().eye, expected.eye);
    let moved = window.state().camera().eye - start.eye;
    let [right, up, _] = start.axes();
    assert!(moved.dot(right) < -0.05 && moved.dot(up) > 0.03, "the eye goes against the drag: {moved}");
    // Shift makes a pan of a drag that would orbit.
    *window.state_mut().camera_mut() = start;
    window.run_steps(2);
    shift_drag(&mut window, PointerButton::Primary, by);
    let camera = window.state().camera();
    assert!((camera.look_at - camera.eye).distance(start.look_at - start.eye) < 1e-9 && camera.eye != start.eye, "{camera:?}");
}

/// Drags from the middle of the image while Shift is held.
fn shift_drag(window: &mut Window, button: PointerButton, by: [f32; 2]) {
    let at = Pos2::from(MIDDLE);
    window.hover_at(at);
    window.run_steps(2);
    let press = |window: &Window, pos, pressed| {
        let event = egui::Event::PointerButton { pos, button, pressed, modifiers: Modifiers::SHIFT };
        window.event_modifiers(event, Modifiers::SHIFT);
    };
    press(window, at, true);
    window.run_steps(1);
    for part in 1..=4 {
        let pos = at + vec2(by[0], by[1]) * (part as f32 / 4.0);
        window.event_modifiers(egui::Event::PointerMoved(pos), Modifiers::SHIFT);
        window.run_steps(1);
    }
    press(window, at + vec2(by[0], by[1]), false);
    window.run_steps(2);
}

#[test]
fn with_the_camera_tool_a_middle_drag_orbits_and_pans_with_shift() {
    let mut window = window("cornell_spheres");
    window.key_press(Key::C);
    window.run_steps(2);
    let (start, offset) = (window.state().camera(), window.state().picture_view().offset);
    drag(&mut window, PointerButton::Middle, MIDDLE, beside(MIDDLE, 20.0, 10.0));
    let orbited = window.state().camera();
    assert!(orbited.look_at == start.look_at && orbited.eye.distance(start.eye) > 0.05, "{orbited:?}");
    let distance = |camera: &Camera| camera.eye.distance(camera.look_at);
    assert!((distance(&orbited) - distance(&start)).abs() < 1e-9);
    shift_drag(&mut window, PointerButton::Middle, [20.0, 10.0]);
    let panned = window.state().camera();
    let way = |camera: &Camera| camera.look_at - camera.eye;
    assert!(way(&panned).distance(way(&orbited)) < 1e-9 && panned.eye.distance(orbited.eye) > 0.01, "{panned:?}");
    assert_eq!(
        (window.state().picture_view().offset, window.state().picture_view().zoom),
        (offset, None),
        "the image stays in place"
    );
}

#[test]
fn keys_fly_and_turn_and_shift_is_faster() {
    let mut window = window("cornell_spheres");
    let start = window.state().camera();
    let held = |window: &mut Window, key: Key, modifiers: Modifiers| {
        *window.state_mut().camera_mut() = start;
        window.step();
        // In one frame the key is down, in the next it is not.
        let event = |pressed| egui::Event::Key { key, physical_key: None, pressed, repeat: false, modifiers };
        window.input_mut().events = vec![egui::Event::ModifiersChanged(modifiers), event(true)];
        window.step();
        window.input_mut().events = vec![event(false), egui::Event::ModifiersChanged(Modifiers::NONE)];
        window.step();
        window.state().camera()
    };
    let size = window.state().opened().as_ref().expect("it is open").scene.size;
    // A frame counts as a tenth of a second at most.
    let step = 0.25 * size * 0.1;
    let [slow, fast] = [Modifiers::NONE, Modifiers::SHIFT].map(|modifiers| held(&mut window, Key::W, modifiers));
    assert!((slow.eye.distance(start.eye) - step).abs() < 1e-3 * step, "{}", slow.eye.distance(start.eye) / step);
    assert!((fast.eye.distance(start.eye) - 4.0 * step).abs() < 1e-3 * step);
    assert_eq!(held(&mut window, Key::W, Modifiers::COMMAND), start, "with other modifiers a key is another one");
    for (key, axis, sign) in
        [(Key::ArrowRight, 0, 1.0), (Key::ArrowLeft, 0, -1.0), (Key::ArrowUp, 1, 1.0), (Key::ArrowDown, 1, -1.0)]
    {
        let turned = held(&mut window, key, Modifiers::NONE);
        let angle = turned.axes()[2].dot(start.axes()[axis]) * sign;
        assert!(turned.eye == start.eye && (angle - 0.1f64.sin()).abs() < 1e-3, "{key:?} {angle}");
    }
    let angle = held(&mut window, Key::ArrowRight, Modifiers::SHIFT).axes()[2].dot(start.axes()[0]);
    assert!((angle - 0.2f64.sin()).abs() < 1e-3, "Shift turns twice as far: {angle}");
}

#[test]
fn pixels_of_a_comparison_are_those_of_the_side_that_they_lie_on() {
    let mut window = window("cornell_spheres");
    let other = noisefall_scene::scene::RenderSettings { max_bounces: Some(0), ..window.state().settings() };
    window.state_mut().start_comparison(other);
    wait(&mut window, "both", |app| app.results.textures[1].is_some() && app.second_frame().is_some());
    let over = |window: &mut Window, x: f32| {
        window.hover_at(Pos2::new(x, 400.0));
        window.run_steps(2);
        (window.state().window.over_second, window.state().hovered())
    };
    let [left, right] = [372.0, 572.0].map(|x| over(&mut window, x));
    assert!(!left.0 && right.0 && left.1 != right.1);
    // All is black there under a cap of 0.
    assert!(window.query_all_by_label_contains("RGB 0.000 0.000 0.000").count() == 1);
    let letters = |window: &Window| {
        let texts = painted(window);
        // In the upper corners of the images, and not in the panels.
        let is_letter = |letter: &str, text: &str, at: Pos2| text == letter && at.x < 944.0 && at.y < 100.0;
        let x = |letter: &str| texts.iter().find(|(text, at)| is_letter(letter, text, *at)).expect("it is painted").1.x;
        (x("A"), x("B"))
    };
    let (a, b) = letters(&window);
    assert!(a < 100.0 && b > 400.0, "{a} {b}");
    if let Some(compare) = &mut window.state_mut().compared_with_mut() {
        compare.layout = CompareLayout::SideBySide;
    }
    window.run_steps(3);
    let (a, b) = letters(&window);
    assert!(a < 100.0 && b > 472.0, "{a} {b}");
    let [left, right] = [242.0, 707.0].map(|x| over(&mut window, x));
    assert!(!left.0 && right.0 && left.1 == right.1, "the same pixel of both: {left:?} {right:?}");
}

#[test]
fn a_bar_of_the_bounces_is_clicked_and_says_its_share() {
    let mut window = window("furnace");
    window.key_press(Key::F4);
    wait(&mut window, "the series", |app| app.second_frame().as_ref().is_some_and(|frame| frame.series.is_some()));
    window.run_steps(3);
    for k in [3usize, 0, 2] {
        let bar = window
            .get_all_by_role(Role::Button)
            .find(|bar| bar.accesskit_node().label().is_some_and(|label| label.starts_with(&format!("{k} bounces: "))));
        bar.expect("it has a bar").click();
        window.run_steps(3);
        assert_eq!(window.state().session.bounces.k, k);
    }
    let names: Vec<String> = painted(&window).into_iter().map(|(text, _)| text).collect();
    assert!(names.contains(&"≥ 16".to_owned()) && names.contains(&"50 %".to_owned()), "half of the light is emitted: {names:?}");
    click(&mut window, "Bounces up to k");
    assert!(window.state().session.bounces.up_to);
    window.state_mut().camera_mut().resolution = [2100, 2001];
    window.run_steps(2);
    assert!(window.state().second_view().is_none() && window.query_all_by_label_contains("too many").count() == 1);
    window.state_mut().camera_mut().resolution = [2100, 2000];
    assert!(window.state().second_view().is_some());
}

#[test]
fn a_quick_drag_that_begins_beside_the_image_does_not_pan_it() {
    let mut window = window("furnace");
    let before = window.state().picture_view().offset;
    let label = window.get_by_label("Seed").rect().center();
    window.hover_at(label);
    window.run_steps(2);
    let button =
        |pos, pressed| egui::Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE };
    window.input_mut().events = vec![button(label, true), egui::Event::PointerMoved(MIDDLE.into())];
    window.step();
    for step in 1..5 {
        window.hover_at(beside(MIDDLE, 20.0 * step as f32, 0.0).into());
        window.step();
    }
    window.event(button(beside(MIDDLE, 80.0, 0.0).into(), false));
    window.run_steps(2);
    assert_eq!(window.state().picture_view().offset, before);
}
