//! The canvas: zooms and pans the image, moves the camera, marks regions, and reports the pixel under the pointer.
use egui::{Color32, CursorIcon, PointerButton, Pos2, Rect, Response, Sense};
use noisefall_render::render::Region;
use noisefall_scene::scene::{Camera, Scene};

use super::{
    drawing::Pictures, drawing::areas, drawing::draw, drawing::is_second, flight, flight::wheel_factor,
    picture_area::PictureArea, picture_view::PictureView,
};

/// The tool: the action of a drag and the wheel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Move and magnify the image. Never restarts the render.
    #[default]
    Picture,
    /// Move the camera: orbit, pan, dolly.
    Camera,
    /// Mark a region that is rendered before the rest.
    Region,
    /// Point at pixels to see their samples.
    Inspect,
}

/// Input on the canvas.
#[derive(Default)]
pub struct CanvasOutput {
    /// The image's pixel under the pointer.
    pub hovered: Option<[u32; 2]>,
    /// Whether that pixel is in the second image.
    pub over_second: bool,
    /// The pixel that was clicked.
    pub clicked: Option<[u32; 2]>,
    /// The corner where a drag began and the one where it is, and whether it has ended.
    pub marked: Option<(Region, bool)>,
    /// The camera, if it was moved.
    pub camera: Option<Camera>,
    /// The area of the canvas, for its menu.
    pub response: Option<Response>,
    /// Where the first image lies, for overlays.
    pub area: Option<PictureArea>,
    /// Where the second one lies, if that is elsewhere.
    pub second_area: Option<PictureArea>,
}

/// Draws the images into the available space and reads the mouse and the keys. The camera moves through `scene`, by keys only
/// if `keys` is set.
pub fn show(
    ui: &mut egui::Ui,
    pictures: Option<Pictures>,
    tool: Tool,
    view: &mut PictureView,
    camera: &Camera,
    scene: Option<&Scene>,
    keys: bool,
) -> CanvasOutput {
    let room = ui.available_rect_before_wrap();
    let response = ui.allocate_rect(room, Sense::click_and_drag());
    // Not white: a bright image would have no edge.
    let ground = if ui.visuals().dark_mode { ui.visuals().extreme_bg_color } else { Color32::from_gray(190) };
    ui.painter_at(room).rect_filled(room, 0.0, ground);
    let Some(pictures) = pictures else { return CanvasOutput::default() };

    let areas = areas(ui, room, &pictures, view);
    let wiped = draw(ui, &response, &pictures, &areas, view);
    if response.double_clicked() {
        view.fit();
    }
    // A drag may leave the image that it began in.
    let distance = |area: &&PictureArea, at: Pos2| area.clip.distance_sq_to_pos(at);
    // A handle of the gizmo takes clicks and drags, not the pixel under the pointer or the wheel.
    let over = response.contains_pointer().then(|| ui.input(|input| input.pointer.hover_pos())).flatten();
    let pointer = response.interact_pointer_pos().or(over);
    let under = pointer.and_then(|at| areas.iter().min_by(|a, b| distance(a, at).total_cmp(&distance(b, at))));
    let under = *under.unwrap_or(&areas[0]);
    // A quick drag reaches the image in the frame in which it begins elsewhere.
    let pressed = ui.input(|input| input.pointer.press_origin());
    let is_foreign = pressed.is_some_and(|at| {
        let layer = ui.ctx().layer_id_at(at);
        !room.contains(at) || layer.is_some_and(|layer| layer != ui.layer_id())
    });
    let is_free = !wiped && !is_foreign;
    if is_free {
        move_picture(ui, &response, over, tool, view, under.clip);
    }
    let hovered = over.and_then(|at| under.pixel(at));
    let over_second = over.is_some_and(|at| is_second(at, &pictures, &areas, view));
    let moves = [tool == Tool::Camera && is_free, keys];
    CanvasOutput {
        hovered,
        over_second,
        clicked: hovered.filter(|_| response.clicked()),
        marked: if tool == Tool::Region && is_free { marked(ui, &response, &under, view) } else { None },
        camera: scene.and_then(|scene| flight::moved(ui, &response, moves, camera, under.rect, scene)),
        response: Some(response),
        area: Some(areas[0]),
        second_area: areas.get(1).copied(),
    }
}

/// The rectangle that is being drawn.
fn marked(ui: &egui::Ui, response: &Response, area: &PictureArea, view: &mut PictureView) -> Option<(Region, bool)> {
    if response.hovered() {
        ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
    }
    if response.drag_started_by(PointerButton::Primary) {
        view.marks_from = ui.input(|input| input.pointer.press_origin()).map(|at| area.nearest_pixel(at));
    }
    let ended = response.drag_stopped_by(PointerButton::Primary);
    if !ended && !response.dragged_by(PointerButton::Primary) {
        return None;
    }
    // egui forgets the start of a drag when it ends.
    let from = if ended { view.marks_from.take() } else { view.marks_from };
    let to = response.interact_pointer_pos()?;
    Some((Region::between(from?, area.nearest_pixel(to)), ended))
}

fn move_picture(ui: &egui::Ui, response: &Response, over: Option<Pos2>, tool: Tool, view: &mut PictureView, area: Rect) {
    let pixels_per_point = ui.ctx().pixels_per_point();
    let moves = matches!(tool, Tool::Picture | Tool::Inspect);
    // With the tool Camera the middle button orbits, as in other programs.
    let is_middle = tool != Tool::Camera && response.dragged_by(PointerButton::Middle);
    if (moves && response.dragged_by(PointerButton::Primary)) || is_middle {
        view.pan(response.drag_delta(), pixels_per_point);
    }
    if let Some(pointer) = over {
        let wheel = if tool == Tool::Camera { 1.0 } else { wheel_factor(ui) };
        let factor = ui.input(egui::InputState::zoom_delta) * wheel;
        if factor != 1.0 {
            view.magnify(factor, pointer - area.center(), pixels_per_point);
        }
    }
}

#[cfg(test)]
mod tests {
    use egui::{TextureId, Vec2};

    use super::{
        super::{drawing::Split, picture_view::PictureView},
        *,
    };

    /// The visible parts of two images of 200 × 100 pixels, in points.
    fn seen(split: Split, wipe: f32) -> [Option<Rect>; 2] {
        let camera = noisefall_scene::scene::built_in().camera;
        let mut view = PictureView { wipe, ..PictureView::default() };
        let second = Some(TextureId::User(2));
        let pictures = Pictures { first: TextureId::User(1), second, resolution: [200, 100], split };
        let draw = |ui: &mut egui::Ui| {
            show(ui, Some(pictures), Tool::Picture, &mut view, &camera, None, false);
        };
        let harness = egui_kittest::Harness::builder().with_size(Vec2::new(800.0, 400.0)).build_ui(draw);
        [1, 2].map(|id| {
            let of = harness.output().shapes.iter().find(|clipped| clipped.shape.texture_id() == TextureId::User(id))?;
            Some(of.clip_rect.intersect(of.shape.visual_bounding_rect()))
        })
    }

    #[test]
    fn two_pictures_lie_left_and_right_of_the_line_or_side_by_side() {
        let [Some(whole), None] = seen(Split::None, 0.25) else { panic!("only the first is seen") };
        assert!((whole.width() - 2.0 * whole.height()).abs() < 2.0 && whole.width() > 700.0, "{whole:?}");
        for wipe in [0.25, 0.75] {
            let [Some(first), Some(second)] = seen(Split::Wipe, wipe) else { panic!("both are seen") };
            assert_eq!((first, second.right(), second.y_range()), (whole, whole.right(), whole.y_range()));
            assert!((second.left() - whole.left() - wipe * whole.width()).abs() < 1.5, "{wipe}: {second:?}");
        }
        let [Some(first), Some(second)] = seen(Split::SideBySide, 0.25) else { panic!("both are seen") };
        assert!(
            (first.width() - second.width()).abs() < 1.5 && first.right() < second.left() && first.width() < 0.52 * whole.width()
        );
    }
}
