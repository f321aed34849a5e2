//! Draws a path over the image.
use egui::{Align2, Color32, FontId, Painter, Pos2, Shape, Stroke, Ui, vec2};
use glam::Vec3;
use noisefall_kernel::integrator::{BidirectionalSample, LightOutcome, PathPoint};
use noisefall_scene::scene::Camera;

use super::{inspector::PathInspector, table::MOST_VERTICES};
use crate::viewer::canvas::{picture_area::PictureArea, projection::clip, projection::project};

const PATH: Color32 = Color32::from_rgb(255, 214, 90);
/// Within the ring of a vertex that the camera does not see.
const HOLLOW: Color32 = Color32::from_black_alpha(90);
const LIGHT: Color32 = Color32::from_rgb(86, 200, 255);
/// The light path.
const FROM_LIGHT: Color32 = Color32::from_rgb(255, 140, 60);

/// Draws the inspected pixel and the vertices of its path. `size` is that of the scene.
pub fn draw(ui: &Ui, area: &PictureArea, inspector: &PathInspector, camera: &Camera, size: f32) {
    let Some(pixel) = inspector.pixel else { return };
    let painter = ui.painter_at(area.clip);
    let square = area.of_region(&noisefall_render::render::Region::between(pixel, pixel)).expand(1.0);
    painter.rect_stroke(square, 0.0, Stroke::new(1.5, PATH), egui::StrokeKind::Outside);
    let Some((_, replay)) = inspector.replay() else { return };
    let screen = |p: [f32; 3]| -> Option<Pos2> {
        let [x, y] = project(camera, Vec3::from(p).as_dvec3())?;
        Some(area.screen(x, y))
    };
    // A line that ends behind the camera is shortened until its end projects into the image plane.
    let towards = |[o, d]: [[f32; 3]; 2], length: f32| {
        let end = |part: i32| (Vec3::from(o) + Vec3::from(d) * (length * 0.75f32.powi(part))).to_array();
        (0..12).find_map(|part| screen(end(part)))
    };
    let dashed = |ends: [Pos2; 2], stroke: Stroke, dash: f32| {
        let ends = clip(area.clip, ends);
        ends.into_iter().for_each(|ends| painter.extend(Shape::dashed_line(&ends, stroke, dash, 0.8 * dash)));
    };
    let mut before = square.center();
    for (number, vertex) in replay.vertices.iter().take(MOST_VERTICES).enumerate() {
        let Some(at) = vertex.surface.as_ref().and_then(|surface| screen(surface.position)) else {
            let away = towards([vertex.origin, vertex.direction], 0.06 * size);
            if let Some(away) = away.filter(|_| vertex.bounce > 0) {
                dashed([before, away], Stroke::new(1.2, PATH), 5.0);
            }
            break;
        };
        if vertex.bounce > 0 {
            painter.line_segment([before, at], Stroke::new(3.0, Color32::from_black_alpha(120)));
            painter.line_segment([before, at], Stroke::new(1.6, PATH));
        }
        if let (Some(light), Some(surface)) = (&vertex.light, &vertex.surface) {
            let seen = light.outcome == LightOutcome::Seen;
            let to = towards([surface.position, light.direction], light.distance.unwrap_or(size));
            if let Some(to) = to.filter(|_| light.outcome != LightOutcome::Void) {
                let stroke = Stroke::new(1.2, if seen { LIGHT } else { LIGHT.gamma_multiply(0.4) });
                dashed([at, to], stroke, 3.5);
            }
        }
        let (fill, edge) =
            if inspector.is_seen(number) { (PATH, Stroke::new(1.0, Color32::BLACK)) } else { (HOLLOW, Stroke::new(1.6, PATH)) };
        painter.circle(at, 4.0, fill, edge);
        let number = vertex.bounce.to_string();
        painter.text(at + vec2(8.0, -6.0), Align2::LEFT_BOTTOM, &number, FontId::proportional(13.0), Color32::BLACK);
        painter.text(at + vec2(7.0, -7.0), Align2::LEFT_BOTTOM, number, FontId::proportional(13.0), Color32::WHITE);
        before = at;
    }
    if let Some(both) = &replay.bidirectional {
        draw_light_path(&painter, both, &screen, &dashed);
    }
}

/// Draws the light path, and its connections with the camera path.
fn draw_light_path(
    painter: &Painter,
    BidirectionalSample { light, camera, strategies }: &BidirectionalSample,
    screen: &dyn Fn([f32; 3]) -> Option<Pos2>,
    dashed: &dyn Fn([Pos2; 2], Stroke, f32),
) {
    let points = |path: &[PathPoint]| -> Vec<Option<Pos2>> {
        path.iter().take(MOST_VERTICES).map(|point| screen(point.position)).collect()
    };
    let (light, camera) = (points(light), points(camera));
    for term in strategies.iter().filter(|term| term.visible && term.s >= 2 && term.t >= 2) {
        let ends = (light.get(term.s as usize - 1), camera.get(term.t as usize - 2));
        if let (Some(Some(y)), Some(Some(z))) = ends {
            dashed([*y, *z], Stroke::new(1.2, FROM_LIGHT.gamma_multiply(0.7)), 3.5);
        }
    }
    for ends in light.windows(2) {
        if let [Some(from), Some(to)] = ends {
            painter.line_segment([*from, *to], Stroke::new(3.0, Color32::from_black_alpha(120)));
            painter.line_segment([*from, *to], Stroke::new(1.6, FROM_LIGHT));
        }
    }
    for (index, at) in light.into_iter().enumerate() {
        let Some(at) = at else { continue };
        painter.circle(at, 4.0, FROM_LIGHT, Stroke::new(1.0, Color32::BLACK));
        painter.text(at + vec2(7.0, 7.0), Align2::LEFT_TOP, format!("y{index}"), FontId::proportional(13.0), FROM_LIGHT);
    }
}
