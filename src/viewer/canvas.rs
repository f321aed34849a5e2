//! The picture: zoomed, panned, moved through, pointed at. Two pictures lie side by side, or share one place with a line between.
use egui::{Color32, CursorIcon, Painter, PointerButton, Pos2, Rect, Response, Sense, TextureId, Vec2};
use noisefall::{
    render::Region,
    scene::{Camera, Scene},
};

use super::{
    flight::{self, wheel_factor},
    picture_view::View,
};

/// What a drag and the wheel do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Move and magnify the picture. Never restarts the render.
    #[default]
    Picture,
    /// Move the camera: orbit, pan, dolly.
    Camera,
    /// Mark what is rendered before the rest.
    Region,
    /// Point at pixels to see their samples.
    Inspect,
}

/// How two pictures are seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Split {
    /// Only the first.
    #[default]
    None,
    Wipe,
    SideBySide,
}

/// What there is to draw.
#[derive(Clone, Copy)]
pub struct Pictures {
    pub first: TextureId,
    pub second: Option<TextureId>,
    /// In picture pixels, of both; their textures may be coarser.
    pub resolution: [u32; 2],
    pub split: Split,
}

/// What the user did to the canvas.
#[derive(Default)]
pub struct CanvasOutput {
    /// The picture's pixel under the pointer.
    pub hovered: Option<[u32; 2]>,
    /// It is one of the second picture.
    pub over_second: bool,
    /// The pixel that was clicked.
    pub clicked: Option<[u32; 2]>,
    /// The corner where a drag began and the one where it is, and whether it has ended.
    pub marked: Option<(Region, bool)>,
    /// The camera, if it was moved.
    pub camera: Option<Camera>,
    /// Where the picture lies, for what is drawn over it; of two side by side, the first.
    pub place: Option<Place>,
}

/// Where a picture lies on the screen.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// What may be drawn upon.
    pub clip: Rect,
    /// All of the picture, in points.
    pub rect: Rect,
    pub resolution: Vec2,
}

/// How near to the line between two pictures it can be taken, in points.
const GRIP: f32 = 7.0;

impl Place {
    /// The point of the screen at a place in picture pixels.
    pub fn screen(&self, x: f32, y: f32) -> Pos2 {
        self.rect.min + Vec2::new(x, y) / self.resolution * self.rect.size()
    }

    /// The rectangle of the screen that pixels take.
    pub fn of_region(&self, region: &Region) -> Rect {
        let corner = |[x, y]: [u32; 2]| self.screen(x as f32, y as f32);
        Rect::from_min_max(corner(region.from), corner(region.to))
    }

    /// The pixel under a point of the screen.
    fn pixel(&self, at: Pos2) -> Option<[u32; 2]> {
        let at = (at - self.rect.min) / self.rect.size() * self.resolution;
        let inside = at.x >= 0.0 && at.y >= 0.0 && at.x < self.resolution.x && at.y < self.resolution.y;
        inside.then_some([at.x as u32, at.y as u32])
    }

    /// The pixel that is nearest to a point of the screen.
    fn nearest_pixel(&self, at: Pos2) -> [u32; 2] {
        let at = (at - self.rect.min) / self.rect.size() * self.resolution;
        let most = self.resolution - Vec2::splat(1.0);
        [at.x.clamp(0.0, most.x) as u32, at.y.clamp(0.0, most.y) as u32]
    }
}

/// Draws the pictures into all the room there is and reads what the user does to them. `scene` is what the camera moves through;
/// `keys` says whether keys move it.
pub fn show(
    ui: &mut egui::Ui,
    pictures: Option<Pictures>,
    tool: Tool,
    view: &mut View,
    camera: &Camera,
    scene: Option<&Scene>,
    keys: bool,
) -> CanvasOutput {
    let area = ui.available_rect_before_wrap();
    let response = ui.allocate_rect(area, Sense::click_and_drag());
    // Not white: a bright picture would have no edge.
    let ground = if ui.visuals().dark_mode { ui.visuals().extreme_bg_color } else { Color32::from_gray(190) };
    ui.painter_at(area).rect_filled(area, 0.0, ground);
    let Some(pictures) = pictures else { return CanvasOutput::default() };

    let places = place(ui, area, &pictures, view);
    let wiped = draw(ui, &response, &pictures, &places, view);
    if response.double_clicked() {
        view.fit();
    }
    // A drag may leave the picture that it began in.
    let distance = |place: &&Place, at: Pos2| place.clip.distance_sq_to_pos(at);
    let pointer = response.interact_pointer_pos().or(response.hover_pos());
    let under = pointer.and_then(|at| places.iter().min_by(|a, b| distance(a, at).total_cmp(&distance(b, at))));
    let under = *under.unwrap_or(&places[0]);
    if !wiped {
        move_picture(ui, &response, tool, view, under.clip);
    }
    let hovered = response.hover_pos().and_then(|at| under.pixel(at));
    let over_second = response.hover_pos().is_some_and(|at| is_second(at, &pictures, &places, view));
    let moves = [tool == Tool::Camera && !wiped, keys];
    CanvasOutput {
        hovered,
        over_second,
        clicked: hovered.filter(|_| response.clicked()),
        marked: if tool == Tool::Region && !wiped { marked(ui, &response, &under, view) } else { None },
        camera: scene.and_then(|scene| flight::moved(ui, &response, moves, camera, under.rect, scene)),
        place: Some(places[0]),
    }
}

/// Where the pictures lie.
fn place(ui: &egui::Ui, area: Rect, pictures: &Pictures, view: &mut View) -> Vec<Place> {
    const GAP: f32 = 2.0;
    let resolution = Vec2::from(pictures.resolution.map(|side| side as f32));
    let pixels_per_point = ui.ctx().pixels_per_point();
    let mut place = |clip: Rect| Place { clip, rect: view.rect(clip, resolution, pixels_per_point), resolution };
    if pictures.split == Split::SideBySide && pictures.second.is_some() {
        let middle = area.center().x;
        let left = area.with_max_x(middle - GAP / 2.0);
        return vec![place(left), place(area.with_min_x(middle + GAP / 2.0))];
    }
    vec![place(area)]
}

/// Draws the pictures. Whether the line between them was dragged.
fn draw(ui: &egui::Ui, response: &Response, pictures: &Pictures, places: &[Place], view: &mut View) -> bool {
    let paint = |painter: &Painter, texture: TextureId, rect: Rect| {
        painter.image(texture, rect, Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0)), Color32::WHITE);
    };
    let Place { clip, rect, .. } = places[0];
    paint(&ui.painter_at(clip), pictures.first, rect);
    let Some(second) = pictures.second else { return false };
    match (pictures.split, places.get(1)) {
        (Split::None, _) => false,
        (Split::SideBySide, other) => {
            if let Some(other) = other {
                paint(&ui.painter_at(other.clip), second, other.rect);
                letter(ui, other.clip, "B");
            }
            letter(ui, clip, "A");
            false
        }
        (Split::Wipe, _) => {
            let seen = rect.intersect(clip);
            let dragged = drag_line(ui, response, seen, view);
            let line = seen.left() + view.wipe * seen.width();
            paint(&ui.painter_at(clip.with_min_x(line)), second, rect);
            let stroke = egui::Stroke::new(2.0, Color32::from_white_alpha(220));
            ui.painter_at(clip).vline(line, seen.y_range(), egui::Stroke::new(4.0, Color32::from_black_alpha(140)));
            ui.painter_at(clip).vline(line, seen.y_range(), stroke);
            ui.painter_at(clip).circle_filled(egui::pos2(line, seen.center().y), 5.0, Color32::WHITE);
            letter(ui, clip.with_max_x(line), "A");
            letter(ui, clip.with_min_x(line), "B");
            dragged
        }
    }
}

/// Lets the user drag the line between two pictures.
fn drag_line(ui: &egui::Ui, response: &Response, seen: Rect, view: &mut View) -> bool {
    let line = seen.left() + view.wipe * seen.width();
    let near = |at: Pos2| (at.x - line).abs() <= GRIP && seen.contains(at);
    if response.hover_pos().is_some_and(near) {
        ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal);
    }
    let origin = ui.input(|input| input.pointer.press_origin());
    view.wiping |= response.drag_started_by(PointerButton::Primary) && origin.is_some_and(near);
    if !response.dragged_by(PointerButton::Primary) {
        view.wiping = false;
    }
    if let Some(at) = response.interact_pointer_pos().filter(|_| view.wiping) {
        view.wipe = ((at.x - seen.left()) / seen.width().max(1.0)).clamp(0.0, 1.0);
    }
    view.wiping
}

/// Whether a point of the screen shows the second picture.
fn is_second(at: Pos2, pictures: &Pictures, places: &[Place], view: &View) -> bool {
    let seen = places[0].rect.intersect(places[0].clip);
    match pictures.split {
        _ if pictures.second.is_none() => false,
        Split::None => false,
        Split::Wipe => at.x > seen.left() + view.wipe * seen.width(),
        Split::SideBySide => places.get(1).is_some_and(|place| place.clip.contains(at)),
    }
}

/// Says which picture this is, in its upper left corner.
fn letter(ui: &egui::Ui, clip: Rect, letter: &str) {
    let at = clip.left_top() + Vec2::splat(8.0);
    let painter = ui.painter_at(clip);
    let back = Rect::from_min_size(at, Vec2::new(22.0, 22.0));
    painter.rect_filled(back, 4.0, Color32::from_black_alpha(170));
    painter.text(back.center(), egui::Align2::CENTER_CENTER, letter, egui::FontId::proportional(15.0), Color32::WHITE);
}

/// The rectangle that is being drawn.
fn marked(ui: &egui::Ui, response: &Response, place: &Place, view: &mut View) -> Option<(Region, bool)> {
    if response.hovered() {
        ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
    }
    if response.drag_started_by(PointerButton::Primary) {
        view.marks_from = ui.input(|input| input.pointer.press_origin()).map(|at| place.nearest_pixel(at));
    }
    let ended = response.drag_stopped_by(PointerButton::Primary);
    if !ended && !response.dragged_by(PointerButton::Primary) {
        return None;
    }
    // By the time a drag has ended nobody else knows where it began.
    let from = if ended { view.marks_from.take() } else { view.marks_from };
    let to = response.interact_pointer_pos()?;
    Some((Region::between(from?, place.nearest_pixel(to)), ended))
}

fn move_picture(ui: &egui::Ui, response: &Response, tool: Tool, view: &mut View, area: Rect) {
    let pixels_per_point = ui.ctx().pixels_per_point();
    let moves = matches!(tool, Tool::Picture | Tool::Inspect);
    if (moves && response.dragged_by(PointerButton::Primary)) || response.dragged_by(PointerButton::Middle) {
        view.pan(response.drag_delta(), pixels_per_point);
    }
    if let Some(pointer) = response.hover_pos() {
        let wheel = if tool == Tool::Camera { 1.0 } else { wheel_factor(ui) };
        let factor = ui.input(egui::InputState::zoom_delta) * wheel;
        if factor != 1.0 {
            view.magnify(factor, pointer - area.center(), pixels_per_point);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place() -> Place {
        let rect = Rect::from_min_size(Pos2::new(100.0, 50.0), Vec2::new(300.0, 200.0));
        Place { clip: rect.shrink(20.0), rect, resolution: Vec2::new(30.0, 10.0) }
    }

    #[test]
    fn pixels_and_places_of_the_screen_are_the_same() {
        let place = place();
        assert_eq!(place.screen(3.0, 7.0), Pos2::new(130.0, 190.0));
        assert_eq!(place.pixel(Pos2::new(139.0, 191.0)), Some([3, 7]));
        for beyond in [[99.0, 60.0], [401.0, 60.0], [110.0, 49.0], [110.0, 251.0]] {
            assert_eq!(place.pixel(beyond.into()), None);
        }
        assert_eq!(place.nearest_pixel(Pos2::new(0.0, 900.0)), [0, 9]);
        assert_eq!(place.nearest_pixel(Pos2::new(900.0, 0.0)), [29, 0]);
        let region = Region { from: [3, 1], to: [6, 5] };
        let rect = Rect::from_min_max(Pos2::new(130.0, 70.0), Pos2::new(160.0, 150.0));
        assert_eq!(place.of_region(&region), rect);
    }

    #[test]
    fn what_lies_right_of_the_line_is_the_second_picture() {
        let view = View { wipe: 0.25, ..View::default() };
        let (left, right) = (place(), Place { clip: Rect::from_min_size(Pos2::new(500.0, 50.0), Vec2::splat(200.0)), ..place() });
        let is_second = |x: f32, split: Split, has_second: bool| {
            let second = has_second.then_some(TextureId::default());
            let pictures = Pictures { first: TextureId::default(), second, resolution: [30, 10], split };
            is_second(Pos2::new(x, 100.0), &pictures, &[left, right], &view)
        };
        // What is seen of the first reaches from 120 to 380.
        assert!(!is_second(184.0, Split::Wipe, true) && is_second(186.0, Split::Wipe, true));
        assert!(!is_second(186.0, Split::Wipe, false) && !is_second(186.0, Split::None, true));
        assert!(is_second(510.0, Split::SideBySide, true) && !is_second(186.0, Split::SideBySide, true));
    }

    /// What is seen of each of two pictures of 200 × 100 pixels, in points.
    fn seen(split: Split, wipe: f32) -> [Option<Rect>; 2] {
        let camera = noisefall::scene::built_in().camera;
        let mut view = View { wipe, ..View::default() };
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
