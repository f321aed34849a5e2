//! Draws the handles of a gizmo and the status of an operation.
use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, vec2};

use noisefall_scene::shape::Transform;

use super::{
    handles::{Handle, HandleShape},
    operation::{Lock, Mode, Operation},
};
use crate::viewer::widgets::decimals::three;

/// Of the axes x, y and z.
const COLOURS: [Color32; 3] = [Color32::from_rgb(238, 84, 84), Color32::from_rgb(122, 200, 66), Color32::from_rgb(82, 146, 255)];
const FREE: Color32 = Color32::from_rgb(235, 235, 235);
const HOVERED: Color32 = Color32::from_rgb(255, 214, 90);
const SHADOW: Color32 = Color32::from_black_alpha(130);

/// Draws handles and highlights the one with the hovered lock.
pub fn handles(painter: &Painter, handles: &[Handle], mode: Mode, hovered: Option<Lock>) {
    for handle in handles.iter().rev() {
        let is_hovered = hovered == Some(handle.lock);
        let colour = if is_hovered { HOVERED } else { colour(handle.lock) };
        for (stroke, colour) in [(4.0, SHADOW), (if is_hovered { 3.0 } else { 2.0 }, colour)] {
            draw(painter, &handle.shape, mode, Stroke::new(stroke, colour));
        }
    }
}

fn colour(lock: Lock) -> Color32 {
    match lock {
        Lock::Free => FREE,
        Lock::Axis(axis) | Lock::Plane(axis) => COLOURS[axis],
    }
}

fn draw(painter: &Painter, shape: &HandleShape, mode: Mode, stroke: Stroke) {
    match shape {
        HandleShape::Axis([from, to]) => {
            painter.line_segment([*from, *to], stroke);
            if mode == Mode::Scale {
                let end = Rect::from_center_size(*to, vec2(9.0, 9.0));
                painter.rect_filled(end.expand(0.3 * stroke.width), 1.0, stroke.color);
            } else {
                arrow_head(painter, [*from, *to], stroke);
            }
        }
        HandleShape::Square(corners) => {
            let fill = stroke.color.gamma_multiply(0.35);
            painter.add(Shape::convex_polygon(corners.to_vec(), fill, Stroke::new(0.5 * stroke.width, stroke.color)));
        }
        HandleShape::Ring(sides) => sides.iter().for_each(|side| _ = painter.line_segment(*side, stroke)),
        HandleShape::Circle(center, radius) => _ = painter.circle_stroke(*center, *radius, stroke),
    }
}

fn arrow_head(painter: &Painter, [from, to]: [Pos2; 2], stroke: Stroke) {
    let along = (to - from).normalized();
    let size = 5.0 + 0.5 * stroke.width;
    let corners = vec![to + along * size, to + along.rot90() * 0.6 * size, to - along.rot90() * 0.6 * size];
    painter.add(Shape::convex_polygon(corners, stroke.color, Stroke::NONE));
}

/// Draws the change so far and the keys at the lower edge of the image.
pub fn status(painter: &Painter, operation: &Operation, change: &Transform) {
    let text = format!(
        "{}\nX Y Z lock an axis, with Shift a plane · Ctrl snaps · digits set the value · Enter keeps · Esc discards",
        title(operation, change)
    );
    let galley = painter.layout(text, FontId::proportional(13.0), Color32::WHITE, f32::INFINITY);
    let clip = painter.clip_rect();
    let size = galley.size();
    let rect = Align2::CENTER_BOTTOM.anchor_size(clip.center_bottom() - vec2(0.0, 12.0), size);
    painter.rect_filled(rect.expand2(vec2(10.0, 6.0)), 6.0, Color32::from_black_alpha(190));
    painter.galley(rect.min, galley, Color32::WHITE);
}

/// Name and amount of the operation.
pub fn title(operation: &Operation, change: &Transform) -> String {
    let name = ["x", "y", "z"];
    let lock = match operation.lock {
        Lock::Free => String::new(),
        Lock::Axis(axis) => format!(" along {}", name[axis]),
        Lock::Plane(normal) => format!(" across {}", name[normal]),
    };
    let typed = if operation.typed.is_empty() { String::new() } else { format!("  [{}]", operation.typed) };
    match change {
        Transform::Translate(by) => format!("Move{lock}: {} m{typed}", three(by.to_array(), 3)),
        Transform::Rotate(turn) => format!("Rotate{}: {:.1}°{typed}", lock.replace("along", "about"), turn.degrees),
        Transform::Scale(by) => format!("Scale{lock}: {:.3} {:.3} {:.3}{typed}", by.x, by.y, by.z),
        Transform::Matrix(_) => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use noisefall_scene::shape::Rotation;

    use super::*;

    #[test]
    fn the_title_has_the_amount_along_each_axis() {
        let by = DVec3::new(1.0, -2.5, 0.125);
        let titled = |mode, lock, change| title(&Operation::new(mode, lock, DVec3::ZERO, [0.0; 2]), &change);
        assert_eq!(titled(Mode::Move, Lock::Free, Transform::Translate(by)), "Move: 1.000 -2.500 0.125 m");
        assert_eq!(titled(Mode::Scale, Lock::Plane(1), Transform::Scale(by)), "Scale across y: 1.000 -2.500 0.125");
        let turn = Transform::Rotate(Rotation { axis: DVec3::Z, degrees: 22.5 });
        assert_eq!(titled(Mode::Rotate, Lock::Axis(2), turn), "Rotate about z: 22.5°");
    }
}
