//! Draws one or two images: side by side, or in the same place with a wipe line between them.
use egui::{Color32, CursorIcon, Painter, PointerButton, Pos2, Rect, Response, TextureId, Vec2};

use super::{picture_area::PictureArea, picture_view::PictureView};

/// How two images are arranged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Split {
    /// Only the first.
    #[default]
    None,
    Wipe,
    SideBySide,
}

/// The images to draw.
#[derive(Clone, Copy)]
pub struct Pictures {
    pub first: TextureId,
    pub second: Option<TextureId>,
    /// Size of both images in pixels; their textures may be coarser.
    pub resolution: [u32; 2],
    pub split: Split,
}

/// Distance from which the wipe line can be dragged, in points.
const GRIP: f32 = 7.0;

/// Finds where the images lie.
pub fn areas(ui: &egui::Ui, room: Rect, pictures: &Pictures, view: &mut PictureView) -> Vec<PictureArea> {
    const GAP: f32 = 2.0;
    let resolution = Vec2::from(pictures.resolution.map(|side| side as f32));
    let pixels_per_point = ui.ctx().pixels_per_point();
    let mut area = |clip: Rect| PictureArea { clip, rect: view.rect(clip, resolution, pixels_per_point), resolution };
    if pictures.split == Split::SideBySide && pictures.second.is_some() {
        let middle = room.center().x;
        let left = room.with_max_x(middle - GAP / 2.0);
        return vec![area(left), area(room.with_min_x(middle + GAP / 2.0))];
    }
    vec![area(room)]
}

/// Draws the images. Returns whether the line between them was dragged.
pub fn draw(ui: &egui::Ui, response: &Response, pictures: &Pictures, areas: &[PictureArea], view: &mut PictureView) -> bool {
    let paint = |painter: &Painter, texture: TextureId, rect: Rect| {
        painter.image(texture, rect, Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0)), Color32::WHITE);
    };
    let PictureArea { clip, rect, .. } = areas[0];
    paint(&ui.painter_at(clip), pictures.first, rect);
    let Some(second) = pictures.second else { return false };
    match (pictures.split, areas.get(1)) {
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

/// Lets the user drag the wipe line.
fn drag_line(ui: &egui::Ui, response: &Response, seen: Rect, view: &mut PictureView) -> bool {
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

/// Whether a point of the screen shows the second image.
pub fn is_second(at: Pos2, pictures: &Pictures, areas: &[PictureArea], view: &PictureView) -> bool {
    let seen = areas[0].rect.intersect(areas[0].clip);
    match pictures.split {
        _ if pictures.second.is_none() => false,
        Split::None => false,
        Split::Wipe => at.x > seen.left() + view.wipe * seen.width(),
        Split::SideBySide => areas.get(1).is_some_and(|area| area.clip.contains(at)),
    }
}

/// Labels an image in its upper left corner.
fn letter(ui: &egui::Ui, clip: Rect, letter: &str) {
    let at = clip.left_top() + Vec2::splat(8.0);
    let painter = ui.painter_at(clip);
    let back = Rect::from_min_size(at, Vec2::new(22.0, 22.0));
    painter.rect_filled(back, 4.0, Color32::from_black_alpha(170));
    painter.text(back.center(), egui::Align2::CENTER_CENTER, letter, egui::FontId::proportional(15.0), Color32::WHITE);
}

#[cfg(test)]
mod tests {
    use super::{super::picture_area::tests::area, *};

    #[test]
    fn pixels_right_of_the_line_belong_to_the_second_image() {
        let view = PictureView { wipe: 0.25, ..PictureView::default() };
        let (left, right) =
            (area(), PictureArea { clip: Rect::from_min_size(Pos2::new(500.0, 50.0), Vec2::splat(200.0)), ..area() });
        let is_second = |x: f32, split: Split, has_second: bool| {
            let second = has_second.then_some(TextureId::default());
            let pictures = Pictures { first: TextureId::default(), second, resolution: [30, 10], split };
            is_second(Pos2::new(x, 100.0), &pictures, &[left, right], &view)
        };
        // The visible part of the first reaches from 120 to 380.
        assert!(!is_second(184.0, Split::Wipe, true) && is_second(186.0, Split::Wipe, true));
        assert!(!is_second(186.0, Split::Wipe, false) && !is_second(186.0, Split::None, true));
        assert!(is_second(510.0, Split::SideBySide, true) && !is_second(186.0, Split::SideBySide, true));
    }
}
