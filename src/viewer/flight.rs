//! Moving the camera by mouse and keys.
use egui::{Key, Modifiers, PointerButton, Rect, Response};
use glam::DVec3;
use noisefall::scene::Camera;

use super::navigation;

const RADIANS_PER_POINT: f64 = 0.006;
/// The part of the scene's size that flight covers in a second.
const FLIGHT_SPEED: f64 = 0.25;

/// The camera, if it was moved: by the mouse where that has the camera, by keys in a scene of a size in metres. `rect` is where the
/// picture lies.
pub fn moved(
    ui: &egui::Ui,
    response: &Response,
    by_mouse: bool,
    camera: &Camera,
    rect: Rect,
    flies: Option<f64>,
) -> Option<Camera> {
    let mut moved = *camera;
    if by_mouse {
        let delta = response.drag_delta();
        let (x, y) = (f64::from(delta.x), f64::from(delta.y));
        let shift = ui.input(|input| input.modifiers.shift);
        if response.dragged_by(PointerButton::Secondary) || (shift && response.dragged_by(PointerButton::Primary)) {
            moved = navigation::pan(&moved, x / f64::from(rect.width()), -y / f64::from(rect.width()));
        } else if response.dragged_by(PointerButton::Primary) {
            moved = navigation::orbit(&moved, -x * RADIANS_PER_POINT, y * RADIANS_PER_POINT);
        }
        if response.hovered() {
            moved = navigation::dolly(&moved, 1.0 / f64::from(wheel_factor(ui)));
        }
    }
    if let Some(size) = flies {
        moved = flight(ui, &moved, size);
    }
    (moved != *camera).then_some(moved)
}

pub fn wheel_factor(ui: &egui::Ui) -> f32 {
    const PER_POINT: f32 = 0.004;
    (ui.input(|input| input.smooth_scroll_delta().y) * PER_POINT).exp()
}

/// W A S D fly forwards, left, back and right, Q and E down and up; arrows turn. Shift is four times as fast.
fn flight(ui: &egui::Ui, camera: &Camera, size: f64) -> Camera {
    if ui.ctx().egui_wants_keyboard_input() {
        return *camera;
    }
    let (along, turn, dt, fast) = ui.input(|input| {
        let free = input.modifiers.matches_logically(Modifiers::NONE) || input.modifiers == Modifiers::SHIFT;
        let held = |key| f64::from(u8::from(free && input.key_down(key)));
        let along = DVec3::new(held(Key::D) - held(Key::A), held(Key::E) - held(Key::Q), held(Key::W) - held(Key::S));
        let turn = [held(Key::ArrowRight) - held(Key::ArrowLeft), held(Key::ArrowUp) - held(Key::ArrowDown)];
        (along, turn, f64::from(input.stable_dt.min(0.1)), input.modifiers.shift)
    });
    if along == DVec3::ZERO && turn == [0.0; 2] {
        return *camera;
    }
    ui.ctx().request_repaint();
    let speed = if fast { 4.0 } else { 1.0 };
    let moved = navigation::fly(camera, along * (FLIGHT_SPEED * size * speed * dt));
    navigation::look(&moved, turn[0] * speed.sqrt() * dt, turn[1] * speed.sqrt() * dt)
}
