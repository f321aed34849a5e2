//! The camera stops before it would see nothing. If it sees nothing, the image says why and offers a way back.
use noisefall_base::math::colour::luminance;
use noisefall_scene::scene::Camera;

use super::*;

const WALL: &str = "The camera is inside “left wall”.";
const BACK: &str = "Back to the last view with light";

/// Waits for the full image of what the controls say, and returns its mean luminance.
fn brightness(window: &mut Window) -> f32 {
    window.run_steps(2);
    wait(window, "the image", |app| {
        let asked = app.worker().request().is_some_and(|request| request.camera == app.camera());
        asked && app.can_save()
    });
    let frame = window.state().shown_frame().clone().expect("it is shown");
    frame.radiance.iter().map(|radiance| luminance(*radiance)).sum::<f32>() / frame.radiance.len() as f32
}

fn with_camera_tool() -> (Window, f32) {
    let mut window = window("cornell_spheres");
    window.key_press(Key::C);
    let bright = brightness(&mut window);
    (window, bright)
}

/// Returns the distance from the eye to the nearer side wall.
fn room(camera: &Camera) -> f64 {
    1.01 - camera.eye.x.abs()
}

#[test]
fn an_orbit_stops_at_the_walls_and_keeps_its_pivot() {
    for by in [60.0, -60.0, 300.0] {
        let (mut window, bright) = with_camera_tool();
        let start = window.state().camera();
        drag(&mut window, PointerButton::Primary, [400.0, 400.0], [400.0 + by, 400.0]);
        let camera = window.state().camera();
        assert!(camera.eye.x * f64::from(by) < 0.0, "a drag to the right turns the eye to the left");
        assert!(room(&camera) > 0.0 && room(&camera) < 0.03, "it comes up to the wall, and not into it: {}", camera.eye);
        assert_eq!(camera.look_at, start.look_at);
        assert!((camera.eye.distance(camera.look_at) - start.eye.distance(start.look_at)).abs() < 1e-9);
        let now = brightness(&mut window);
        assert!(now > 0.3 * bright, "{by}: {bright} before, {now} after");
        // The wall stops the eye in one direction and not in the other.
        drag(&mut window, PointerButton::Primary, [400.0, 400.0], [400.0 + by, 420.0]);
        assert!(window.state().camera().eye.y > camera.eye.y + 0.1, "it slides along the wall");
    }
}

#[test]
fn a_pan_and_a_dolly_stop_at_the_walls() {
    let (mut window, bright) = with_camera_tool();
    let start = window.state().camera();
    drag(&mut window, PointerButton::Secondary, [400.0, 400.0], [900.0, 400.0]);
    let camera = window.state().camera();
    assert!(camera.eye.x < -0.97 && room(&camera) > 0.0, "{}", camera.eye);
    assert!((camera.look_at - camera.eye).distance(start.look_at - start.eye) < 1e-9, "eye and pivot move together");
    assert!(brightness(&mut window) > 0.3 * bright);

    // Towards a point behind the back wall.
    *window.state_mut().camera_mut() = Camera { look_at: DVec3::new(0.0, 1.0, -20.0), ..start };
    for _ in 0..12 {
        scroll(&mut window, [400.0, 400.0], 60.0);
    }
    let camera = window.state().camera();
    assert!(camera.eye.z > -1.0 && camera.eye.z < -0.97, "{}", camera.eye);
    assert_eq!(camera.look_at.z, -20.0);
    assert!(brightness(&mut window) > 0.0);
}

#[test]
fn flight_stops_at_the_back_wall_and_turns_freely_there() {
    let (mut window, bright) = with_camera_tool();
    let start = window.state().camera();
    for key in [Key::W, Key::A] {
        window.key_down(key);
        for _ in 0..70 {
            window.step();
        }
        window.key_up(key);
        window.run_steps(1);
    }
    let camera = window.state().camera();
    assert!(camera.eye.z > -1.01 && camera.eye.z < -0.95 && camera.eye.x < -0.95 && camera.eye.x > -1.01, "{}", camera.eye);
    assert!((camera.look_at - camera.eye).distance(start.look_at - start.eye) < 1e-9);
    window.key_down(Key::ArrowRight);
    wait(&mut window, "a turn", |app| app.camera().axes()[2].x > 0.9);
    window.key_up(Key::ArrowRight);
    assert!(brightness(&mut window) > 0.1 * bright);
}

#[test]
fn flight_enters_a_closed_furnace_from_the_dark_outside() {
    let mut window = window("furnace");
    *window.state_mut().camera_mut() = Camera { eye: DVec3::new(2.0, 0.0, 0.0), look_at: DVec3::ZERO, ..window.state().camera() };
    assert_eq!(brightness(&mut window), 0.0);
    window.key_down(Key::W);
    wait(&mut window, "the inside", |app| app.camera().eye.length() < 0.5);
    window.key_up(Key::W);
    let mean = brightness(&mut window);
    assert!((mean - 2.0).abs() < 0.1, "{mean}");
}

#[test]
fn a_black_picture_says_why_and_leads_back() {
    let (mut window, bright) = with_camera_tool();
    let start = window.state().camera();
    assert!(window.query_by_label("No light found yet").is_none() && window.query_by_label(BACK).is_none());
    // Numbers may put the camera anywhere.
    window.state_mut().camera_mut().eye.x = -1.5;
    window.state_mut().camera_mut().resolution = [48, 64];
    assert_eq!(brightness(&mut window), 0.0);
    window.run_steps(2);
    let [title, reason, back] = ["No light found yet", WALL, BACK].map(|label| window.get_by_label(label).rect());
    let middle = Pos2::new((1280.0 - 336.0) / 2.0, 640.0);
    assert!((title.left() - back.left()).abs() < 1.0 && title.bottom() <= reason.top() && reason.bottom() <= back.top());
    assert!((back.center().x - middle.x).abs() < 60.0 && (back.center().y - middle.y).abs() < 120.0, "on the image: {back:?}");
    // Not where numbers of another kind are seen.
    choose(&mut window, "View", "Normals");
    assert!(window.query_by_label(WALL).is_none());
    choose(&mut window, "View", "Radiance");
    window.get_by_label(BACK).click();
    assert!(brightness(&mut window) > 0.3 * bright);
    assert_eq!(window.state().camera(), Camera { resolution: [48, 64], ..start }, "the resolution is no part of a view");
    window.run_steps(2);
    assert!(window.query_by_label(WALL).is_none() && window.query_by_label(BACK).is_none());
}

#[test]
fn a_few_stray_pixels_in_a_wall_are_nothing_to_see() {
    let (mut window, _) = with_camera_tool();
    let shows_nothing = |window: &Window| [0.0, 0.005, 0.02].map(|lit| window.state().shows_nothing(lit));
    assert_eq!(shows_nothing(&window), [true, false, false], "in the open a few pixels may be all there is");
    window.state_mut().camera_mut().eye.x = -1.5;
    window.run_steps(2);
    assert_eq!(shows_nothing(&window), [true, true, false]);
}

#[test]
fn there_is_no_way_back_where_nothing_was_ever_seen() {
    let mut window = window("inside_lit_outside");
    assert_eq!(brightness(&mut window), 0.0);
    window.run_steps(2);
    assert!(window.query_by_label("The camera is inside “wall”.").is_some() && window.query_by_label(BACK).is_none());
    // A view of another scene is not a view of this one.
    let path = shipped("furnace");
    window.state_mut().loader_mut().open(Some(path));
    wait(&mut window, "light", |app| {
        app.opened().as_ref().is_some_and(|opened| opened.name == "Furnace") && app.results.last_seeing.is_some()
    });
    window.state_mut().loader_mut().open(Some(shipped("inside_lit_outside")));
    wait(&mut window, "the dark", |app| app.results.why_black().is_some_and(|why| why.contains("`wall`")));
    window.state_mut().camera_mut().resolution = [96, 64];
    assert_eq!(brightness(&mut window), 0.0);
    window.run_steps(2);
    assert!(window.query_by_label(BACK).is_none());
}

#[test]
fn a_picture_of_the_scene_before_is_no_view_of_the_one_that_was_opened() {
    let (mut window, _) = with_camera_tool();
    let (old, generation) =
        (window.state().opened().as_ref().map(|opened| opened.scene.clone()), window.state().worker().generation());
    assert!(old.is_some() && window.state().results.last_seeing.is_some());
    let app = window.state_mut();
    app.background.loader.open(Some(shipped("inside_lit_outside")));
    let start = Instant::now();
    // As in a frame in which a scene is opened, and an image of the one before arrives.
    while app.opened().as_ref().map(|opened| std::sync::Arc::as_ptr(&opened.scene)) == old.as_ref().map(std::sync::Arc::as_ptr) {
        assert!(start.elapsed() < Duration::from_secs(60), "the scene never came");
        app.receive();
    }
    app.note_blackness(generation);
    assert!(app.worker().generation() == generation && app.results.last_seeing.is_none());
}

#[test]
fn a_cap_that_leaves_nothing_is_named_without_a_way_back() {
    let mut window = window("cornell_box");
    brightness(&mut window);
    // Beside the light, which is all that a cap of 0 shows.
    window.state_mut().camera_mut().fov = 2.0;
    assert!(brightness(&mut window) > 0.0);
    window.state_mut().settings_mut().max_bounces = Some(0);
    wait(&mut window, "the reason", |app| app.results.why_black().is_some());
    brightness(&mut window);
    window.run_steps(2);
    assert!(window.query_by_label_contains("A cap of 0 bounces").is_some() && window.query_by_label(BACK).is_none());
}

#[test]
fn home_leads_back_from_everywhere_by_button_and_by_key() {
    let mut window = window("cornell_spheres");
    let home = window.state().opened().as_ref().expect("it is open").scene.camera;
    let away = Camera { eye: DVec3::new(-1.5, 1.0, 2.0), ..home };
    *window.state_mut().camera_mut() = away;
    window.run_steps(2);
    restarts(&mut window, "the scene's camera", |w| click(w, "Home"));
    assert_eq!(window.state().camera(), home);
    // With the keyboard on a control that has no use for it, and with a camera that can take no image.
    for camera in [away, Camera { up: DVec3::ZERO, ..away }] {
        *window.state_mut().camera_mut() = camera;
        window.get_by_role_and_label(Role::Slider, "Exposure").focus();
        window.run_steps(3);
        assert!(window.ctx.egui_wants_keyboard_input());
        window.key_press(Key::Home);
        window.run_steps(2);
        assert_eq!(window.state().camera(), home);
    }
    // In text the key is the cursor's.
    *window.state_mut().camera_mut() = away;
    click(&mut window, "Open…");
    window.get_by_role(Role::TextInput).focus();
    window.run_steps(2);
    window.key_press(Key::Home);
    window.run_steps(2);
    assert_eq!(window.state().camera(), away);
}

#[test]
fn the_toolbar_is_one_line_in_a_window_of_1280_with_a_region_too() {
    let mut window = window("cornell_spheres");
    window.state_mut().budget_mut().region = Some(noisefall_render::render::Region::between([10, 10], [40, 40]));
    window.run_steps(4);
    let labels = ["Pause", "Step", "Restart", "Image", "Clear", "Home", "Fit", "1:1", "Compare with…", "Save…", "Help"];
    let rects = labels.map(|label| window.get_all_by_label(label).next().expect("it is there").rect());
    for (pair, name) in rects.windows(2).zip(labels) {
        assert!((pair[0].center().y - pair[1].center().y).abs() < 3.0, "{name}: {pair:?}");
        assert!(pair[0].right() < pair[1].left(), "{name}: {pair:?}");
    }
    assert!(rects[10].right() <= 1280.0 - 336.0, "{:?}", rects[10]);
}
