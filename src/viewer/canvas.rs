//! The picture: zoomed, panned, and moved through.
use egui::{Color32, Key, Modifiers, PointerButton, Pos2, Rect, Response, Sense, TextureId, Vec2};
use glam::DVec3;
use noisefall::scene::Camera;

use super::navigation;

/// What a drag and the wheel do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Move and magnify the picture. Never restarts the render.
    #[default]
    Picture,
    /// Move the camera: orbit, pan, dolly.
    Camera,
}

/// Which part of the picture is seen, and how large.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct View {
    /// Screen pixels a picture pixel; `None` fits the picture into the window.
    pub zoom: Option<f32>,
    /// From the centre of the picture to what is seen in the middle, in picture pixels.
    pub offset: Vec2,
    /// Screen pixels a picture pixel as last drawn.
    pub drawn_zoom: f32,
}

/// What the user did to the canvas.
#[derive(Default)]
pub struct CanvasOutput {
    /// The picture's pixel under the pointer.
    pub hovered: Option<[u32; 2]>,
    /// The camera, if it was moved.
    pub camera: Option<Camera>,
}

const ZOOM_RANGE: std::ops::RangeInclusive<f32> = 0.05..=64.0;
const RADIANS_PER_POINT: f64 = 0.006;
/// The part of the scene's size that flight covers in a second.
const FLIGHT_SPEED: f64 = 0.25;

impl View {
    pub fn fit(&mut self) {
        *self = View::default();
    }

    /// One picture pixel to one screen pixel.
    pub fn actual_size(&mut self) {
        *self = View { zoom: Some(1.0), ..View::default() };
    }

    /// Where the picture lies, in points.
    fn rect(&mut self, area: Rect, resolution: Vec2, pixels_per_point: f32) -> Rect {
        let fit = (area.size() * pixels_per_point / resolution).min_elem();
        self.drawn_zoom = self.zoom.unwrap_or(fit);
        let scale = self.drawn_zoom / pixels_per_point;
        let rect = Rect::from_center_size(area.center() - self.offset * scale, resolution * scale);
        // On whole screen pixels every picture pixel is as wide as its neighbour, or one pixel off at most.
        let snap = |p: Pos2| (p.to_vec2() * pixels_per_point).round().to_pos2() / pixels_per_point;
        Rect::from_min_size(snap(rect.min), rect.size())
    }

    fn pan(&mut self, points: Vec2, pixels_per_point: f32) {
        self.zoom = Some(self.drawn_zoom);
        self.offset -= points * pixels_per_point / self.drawn_zoom;
    }

    /// Magnifies about a point of the screen, which stays where it is.
    fn magnify(&mut self, factor: f32, about: Vec2, pixels_per_point: f32) {
        let zoom = (self.drawn_zoom * factor).clamp(*ZOOM_RANGE.start(), *ZOOM_RANGE.end());
        self.offset += about * pixels_per_point * (1.0 / self.drawn_zoom - 1.0 / zoom);
        self.zoom = Some(zoom);
    }
}

/// Draws the picture, of a resolution of its own, into all the room there is and reads what the user does to it. `size` is the
/// scene's, in metres; `keys` says whether keys move the camera.
pub fn show(
    ui: &mut egui::Ui,
    picture: Option<(TextureId, [u32; 2])>,
    tool: Tool,
    view: &mut View,
    camera: &Camera,
    size: f64,
    keys: bool,
) -> CanvasOutput {
    let area = ui.available_rect_before_wrap();
    let response = ui.allocate_rect(area, Sense::click_and_drag());
    let painter = ui.painter_at(area);
    painter.rect_filled(area, 0.0, ui.visuals().extreme_bg_color);
    let Some((texture, [width, height])) = picture else { return CanvasOutput::default() };

    let resolution = Vec2::new(width as f32, height as f32);
    let pixels_per_point = ui.ctx().pixels_per_point();
    let rect = view.rect(area, resolution, pixels_per_point);
    painter.image(texture, rect, Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0)), Color32::WHITE);

    if response.double_clicked() {
        view.fit();
    }
    move_picture(ui, &response, tool, view, area);
    CanvasOutput {
        hovered: pixel_under(&response, rect, resolution),
        camera: move_camera(ui, &response, tool, camera, rect, keys.then_some(size)),
    }
}

fn pixel_under(response: &Response, rect: Rect, resolution: Vec2) -> Option<[u32; 2]> {
    let at = (response.hover_pos()? - rect.min) / rect.size() * resolution;
    let inside = at.x >= 0.0 && at.y >= 0.0 && at.x < resolution.x && at.y < resolution.y;
    inside.then_some([at.x as u32, at.y as u32])
}

fn move_picture(ui: &egui::Ui, response: &Response, tool: Tool, view: &mut View, area: Rect) {
    let pixels_per_point = ui.ctx().pixels_per_point();
    let by_main_button = tool == Tool::Picture && response.dragged_by(PointerButton::Primary);
    if by_main_button || response.dragged_by(PointerButton::Middle) {
        view.pan(response.drag_delta(), pixels_per_point);
    }
    if let Some(pointer) = response.hover_pos() {
        let wheel = if tool == Tool::Picture { wheel_factor(ui) } else { 1.0 };
        let factor = ui.input(egui::InputState::zoom_delta) * wheel;
        if factor != 1.0 {
            view.magnify(factor, pointer - area.center(), pixels_per_point);
        }
    }
}

fn move_camera(
    ui: &egui::Ui,
    response: &Response,
    tool: Tool,
    camera: &Camera,
    rect: Rect,
    flies: Option<f64>,
) -> Option<Camera> {
    let mut moved = *camera;
    if tool == Tool::Camera {
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

fn wheel_factor(ui: &egui::Ui) -> f32 {
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
