//! The gizmo, driven as a user would: without a window around it.
use egui::{Event, Key, Modifiers, Vec2};
use egui_kittest::Harness;
use noisefall_scene::{
    scene::{Projection, built_in},
    shape::Rotation,
};

use super::*;
use crate::viewer::canvas::projection::project;

struct State {
    gizmo: Gizmo,
    outputs: Vec<GizmoOutput>,
    /// The image under the gizmo was dragged.
    panned: bool,
}

type Canvas = Harness<'static, State>;

const SIZE: Vec2 = vec2(600.0, 400.0);

/// Along −z, an image pixel a point.
fn camera() -> Camera {
    let (eye, look_at) = (DVec3::new(0.0, 0.0, 10.0), DVec3::ZERO);
    let projection = Projection::orthographic(6.0);
    Camera { eye, look_at, up: DVec3::Y, projection, lens: None, resolution: [600, 400], ..built_in().camera }
}

/// From above and from the side.
pub(super) fn oblique_camera() -> Camera {
    let (eye, look_at) = (DVec3::new(3.0, 2.0, 5.0), DVec3::ZERO);
    let (projection, resolution) = (Projection::Perspective, [300, 200]);
    Camera { eye, look_at, up: DVec3::Y, fov: 40.0, projection, resolution, ..built_in().camera }
}

fn canvas() -> Canvas {
    let draw = |ui: &mut Ui, state: &mut State| {
        let rect = Rect::from_min_size(Pos2::ZERO, SIZE);
        let area = PictureArea { clip: rect, rect, resolution: SIZE };
        state.gizmo.take_keys(ui.ctx());
        let picture = ui.allocate_rect(rect, Sense::click_and_drag());
        state.panned |= picture.dragged();
        state.outputs.extend(state.gizmo.show(ui, &area, &camera(), DVec3::ZERO, 5.0));
    };
    let state = State { gizmo: Gizmo::default(), outputs: Vec::new(), panned: false };
    Harness::builder().with_size(SIZE).build_ui_state(draw, state)
}

/// Where a point of the scene is seen.
fn seen(p: DVec3) -> Pos2 {
    project(&camera(), p).expect("it is in front").into()
}

fn point_at(canvas: &mut Canvas, at: Pos2) {
    canvas.hover_at(at);
    canvas.run_steps(2);
}

fn button(canvas: &mut Canvas, pos: Pos2, pressed: bool, button: PointerButton) {
    canvas.event(Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE });
    canvas.run_steps(2);
}

fn press(canvas: &mut Canvas, key: Key) {
    canvas.key_press(key);
    canvas.run_steps(2);
}

fn last(canvas: &Canvas) -> (Phase, Transform) {
    let last = canvas.state().outputs.last().expect("there is an operation");
    (last.phase, last.change.clone())
}

fn is_near(change: &Transform, expected: DVec3) -> bool {
    matches!(change, Transform::Translate(by) if by.distance(expected) < 1e-3)
}

#[test]
fn a_handle_is_dragged_along_its_axis_and_the_picture_stays() {
    let mut canvas = canvas();
    let from = seen(DVec3::new(0.6, 0.0, 0.0));
    point_at(&mut canvas, from);
    button(&mut canvas, from, true, PointerButton::Primary);
    for step in 1..=6 {
        point_at(&mut canvas, from + vec2(20.0, 10.0) * step as f32);
    }
    let (phase, change) = last(&canvas);
    let Transform::Translate(by) = change else { panic!("it is no move: {change:?}") };
    assert!(phase == Phase::Going && by.y == 0.0 && by.z == 0.0 && (by.x - 1.2).abs() < 1e-3, "{by}");
    button(&mut canvas, from + vec2(120.0, 60.0), false, PointerButton::Primary);
    assert_eq!(last(&canvas).0, Phase::Done);
    assert!(!canvas.state().gizmo.is_active() && !canvas.state().panned);
}

#[test]
fn another_selection_ends_an_operation_without_a_change() {
    let mut canvas = canvas();
    point_at(&mut canvas, Pos2::new(400.0, 100.0));
    press(&mut canvas, Key::S);
    assert!(canvas.state().gizmo.is_active());
    canvas.state_mut().gizmo.reset();
    canvas.state_mut().outputs.clear();
    canvas.run_steps(3);
    assert!(canvas.state().outputs.is_empty() && canvas.state().gizmo.mode == Mode::Scale);
}

#[test]
fn beside_the_handles_the_mouse_is_the_pictures() {
    let mut canvas = canvas();
    let from = Pos2::new(500.0, 380.0);
    point_at(&mut canvas, from);
    button(&mut canvas, from, true, PointerButton::Primary);
    point_at(&mut canvas, from - vec2(40.0, 40.0));
    button(&mut canvas, from - vec2(40.0, 40.0), false, PointerButton::Primary);
    assert!(canvas.state().panned && canvas.state().outputs.is_empty());
}

#[test]
fn g_moves_with_the_pointer_until_a_click() {
    let mut canvas = canvas();
    point_at(&mut canvas, Pos2::new(400.0, 100.0));
    press(&mut canvas, Key::G);
    point_at(&mut canvas, Pos2::new(500.0, 150.0));
    assert!(is_near(&last(&canvas).1, DVec3::new(1.0, -0.5, 0.0)), "{:?}", last(&canvas));
    press(&mut canvas, Key::Y);
    assert!(is_near(&last(&canvas).1, DVec3::new(0.0, -0.5, 0.0)), "{:?}", last(&canvas));
    for pressed in [true, false] {
        button(&mut canvas, Pos2::new(500.0, 150.0), pressed, PointerButton::Primary);
    }
    assert!(last(&canvas).0 == Phase::Done && is_near(&last(&canvas).1, DVec3::new(0.0, -0.5, 0.0)));
    let count = canvas.state().outputs.len();
    canvas.run_steps(3);
    assert_eq!(canvas.state().outputs.len(), count, "it is over");
}

#[test]
fn numbers_are_typed_and_entered() {
    let mut canvas = canvas();
    point_at(&mut canvas, Pos2::new(400.0, 100.0));
    for key in [Key::R, Key::Z, Key::Num4, Key::Num5, Key::Num7, Key::Backspace, Key::Minus, Key::Enter] {
        press(&mut canvas, key);
    }
    assert_eq!(last(&canvas), (Phase::Done, Transform::Rotate(Rotation { axis: DVec3::Z, degrees: -45.0 })));
    for key in [Key::S, Key::Num2, Key::Period, Key::Num5, Key::Enter] {
        press(&mut canvas, key);
    }
    assert_eq!(last(&canvas), (Phase::Done, Transform::Scale(DVec3::splat(2.5))));
    assert_eq!(canvas.state().gizmo.mode, Mode::Scale);
}

#[test]
fn escape_and_the_right_button_cancel() {
    let mut canvas = canvas();
    point_at(&mut canvas, Pos2::new(400.0, 100.0));
    press(&mut canvas, Key::G);
    press(&mut canvas, Key::Escape);
    assert!(last(&canvas).0 == Phase::Cancelled && !canvas.state().gizmo.is_active());
    press(&mut canvas, Key::G);
    for pressed in [true, false] {
        button(&mut canvas, Pos2::new(400.0, 100.0), pressed, PointerButton::Secondary);
    }
    assert!(last(&canvas).0 == Phase::Cancelled && !canvas.state().gizmo.is_active());
}

/// The middles of the circles that are drawn.
fn circles(canvas: &Canvas) -> Vec<Pos2> {
    let circle = |shape: &egui::epaint::ClippedShape| match &shape.shape {
        egui::Shape::Circle(circle) => Some(circle.center),
        _ => None,
    };
    canvas.output().shapes.iter().filter_map(circle).collect()
}

#[test]
fn the_handles_go_with_the_object_that_is_moved() {
    let mut canvas = canvas();
    point_at(&mut canvas, seen(DVec3::ZERO));
    assert!(circles(&canvas).contains(&seen(DVec3::ZERO)));
    for key in [Key::G, Key::X, Key::Num2] {
        press(&mut canvas, key);
    }
    let drawn = circles(&canvas);
    let to = seen(DVec3::new(2.0, 0.0, 0.0));
    assert!(!drawn.is_empty() && drawn.iter().all(|at| at.distance(to) < 0.1), "{drawn:?}");
}
