//! Moves the camera by mouse and keys. It stops where it would see nothing.
use egui::{Key, Modifiers, PointerButton, Rect, Response};
use glam::DVec3;
use noisefall_kernel::integrator::clear_fraction;
use noisefall_scene::scene::{Camera, Scene};

use super::navigation;

const RADIANS_PER_POINT: f64 = 0.006;
/// Speed of flight in sizes of the scene per second.
const FLIGHT_SPEED: f64 = 0.25;
/// Largest chord of an orbit that is tested for collisions, radians. Such chords are closer to the arc than a camera gets to a
/// surface.
const CHORD: f64 = 0.05;

/// The camera, if it was moved: by the mouse if `by_mouse` is set, by keys if `by_keys` is. `rect` is where the image lies.
pub fn moved(
    ui: &egui::Ui,
    response: &Response,
    [by_mouse, by_keys]: [bool; 2],
    camera: &Camera,
    rect: Rect,
    scene: &Scene,
) -> Option<Camera> {
    let mut moved = *camera;
    if by_mouse {
        let delta = response.drag_delta();
        let (x, y) = (f64::from(delta.x), f64::from(delta.y));
        let shift = ui.input(|input| input.modifiers.shift);
        let turns = response.dragged_by(PointerButton::Primary) || response.dragged_by(PointerButton::Middle);
        if response.dragged_by(PointerButton::Secondary) || (shift && turns) {
            let width = f64::from(rect.width());
            moved = pan(scene, &moved, [x / width, -y / width]);
        } else if turns {
            moved = orbit(scene, &moved, [-x * RADIANS_PER_POINT, y * RADIANS_PER_POINT]);
        }
        // Over a handle of the gizmo too.
        if response.contains_pointer() {
            moved = dolly(scene, &moved, 1.0 / f64::from(wheel_factor(ui)));
        }
    }
    if by_keys {
        moved = flight(ui, &moved, scene);
    }
    (moved != *camera).then_some(moved)
}

/// The part of a move that keeps the camera where it can see. `at(1.0)` is the whole move, which is tested in `chords` straight
/// parts.
fn stopped(scene: &Scene, camera: &Camera, chords: u32, at: impl Fn(f64) -> Camera) -> Camera {
    let mut eye = camera.eye;
    for chord in 0..chords {
        let place = |part: f64| (f64::from(chord) + part) / f64::from(chords);
        let next = at(place(1.0)).eye;
        let clear = clear_fraction(scene, eye, next);
        if clear < 1.0 {
            return if chord == 0 && clear == 0.0 { *camera } else { at(place(clear)) };
        }
        eye = next;
    }
    at(1.0)
}

// Each axis stops by itself, so the camera slides along walls.

fn orbit(scene: &Scene, camera: &Camera, [right, up]: [f64; 2]) -> Camera {
    let chords = |angle: f64| (angle.abs() / CHORD).ceil().clamp(1.0, 200.0) as u32;
    let moved = stopped(scene, camera, chords(right), |part| navigation::orbit(camera, right * part, 0.0));
    stopped(scene, &moved, chords(up), |part| navigation::orbit(&moved, 0.0, up * part))
}

fn pan(scene: &Scene, camera: &Camera, [right, up]: [f64; 2]) -> Camera {
    let moved = stopped(scene, camera, 1, |part| navigation::pan(camera, right * part, 0.0));
    stopped(scene, &moved, 1, |part| navigation::pan(&moved, 0.0, up * part))
}

fn dolly(scene: &Scene, camera: &Camera, factor: f64) -> Camera {
    stopped(scene, camera, 1, |part| navigation::dolly(camera, 1.0 + (factor - 1.0) * part))
}

fn fly(scene: &Scene, camera: &Camera, by: DVec3) -> Camera {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| axis * by);
    axes.iter().fold(*camera, |camera, by| stopped(scene, &camera, 1, |part| navigation::fly(&camera, *by * part)))
}

pub fn wheel_factor(ui: &egui::Ui) -> f32 {
    const PER_POINT: f32 = 0.004;
    (ui.input(|input| input.smooth_scroll_delta().y) * PER_POINT).exp()
}

/// W A S D fly forwards, left, back and right, Q and E down and up; arrows turn. Shift is four times as fast.
fn flight(ui: &egui::Ui, camera: &Camera, scene: &Scene) -> Camera {
    if ui.ctx().text_edit_focused() {
        return *camera;
    }
    // Arrows belong to what Tab has reached.
    let has_focus = ui.ctx().egui_wants_keyboard_input();
    let (along, turn, dt, fast) = ui.input(|input| {
        let free = input.modifiers.matches_logically(Modifiers::NONE) || input.modifiers == Modifiers::SHIFT;
        let held = |key| f64::from(u8::from(free && input.key_down(key)));
        let along = DVec3::new(held(Key::D) - held(Key::A), held(Key::E) - held(Key::Q), held(Key::W) - held(Key::S));
        let turn = [held(Key::ArrowRight) - held(Key::ArrowLeft), held(Key::ArrowUp) - held(Key::ArrowDown)];
        let turn = if has_focus { [0.0; 2] } else { turn };
        (along, turn, f64::from(input.stable_dt.min(0.1)), input.modifiers.shift)
    });
    if along == DVec3::ZERO && turn == [0.0; 2] {
        return *camera;
    }
    ui.ctx().request_repaint();
    let speed = if fast { 4.0 } else { 1.0 };
    let moved = fly(scene, camera, along * (FLIGHT_SPEED * scene.size * speed * dt));
    navigation::look(&moved, turn[0] * speed.sqrt() * dt, turn[1] * speed.sqrt() * dt)
}
