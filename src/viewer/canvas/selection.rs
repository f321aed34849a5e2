//! Draws the outline of the selected object over the image.
use egui::{Color32, Mesh, Pos2, Rect, Shape, Ui};

use super::picture_area::PictureArea;
use crate::viewer::background::outline::Outline;

const INK: Color32 = Color32::from_rgb(255, 160, 40);
const GROUND: Color32 = Color32::from_black_alpha(150);

/// Draws an outline of an image of the resolution of the area.
pub fn draw(ui: &Ui, area: &PictureArea, outline: &Outline) {
    let mut mesh = Mesh::default();
    for (colour, half_width) in [(GROUND, 1.75), (INK, 0.75)] {
        for [from, to] in &outline.0 {
            let [from, to] = [from, to].map(|[x, y]| area.screen(*x as f32, *y as f32));
            if let Some(line) = line(area.clip, from, to, half_width) {
                mesh.add_colored_rect(line, colour);
            }
        }
    }
    ui.painter_at(area.clip).add(Shape::mesh(mesh));
}

/// The part of an upright or level line that can be seen, as a rectangle.
fn line(clip: Rect, from: Pos2, to: Pos2, half_width: f32) -> Option<Rect> {
    let line = Rect::from_two_pos(from, to).expand(half_width);
    line.intersects(clip).then(|| line.intersect(clip))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_outline_is_drawn_at_its_pixels() {
        let outline = Outline(vec![[[3, 2], [6, 2]], [[6, 2], [6, 5]]]);
        let area = super::super::picture_area::tests::area();
        let draw = |ui: &mut Ui| draw(ui, &area, &outline);
        let harness = egui_kittest::Harness::builder().with_size(egui::vec2(500.0, 300.0)).build_ui(draw);
        let meshes = harness.output().shapes.iter().filter(|clipped| matches!(clipped.shape, Shape::Mesh(_)));
        let [drawn] = meshes.collect::<Vec<_>>()[..] else { panic!("there is one mesh") };
        let rect = drawn.shape.visual_bounding_rect();
        assert_eq!(rect, Rect::from_min_max(area.screen(3.0, 2.0), area.screen(6.0, 5.0)).expand(1.75));
    }

    #[test]
    fn lines_are_cut_at_the_edge_and_those_outside_are_left_out() {
        let clip = Rect::from_min_max(Pos2::ZERO, Pos2::new(10.0, 10.0));
        let inside = line(clip, Pos2::new(2.0, 5.0), Pos2::new(20.0, 5.0), 1.0).expect("a part is seen");
        assert_eq!(inside, Rect::from_min_max(Pos2::new(1.0, 4.0), Pos2::new(10.0, 6.0)));
        assert_eq!(line(clip, Pos2::new(20.0, 5.0), Pos2::new(30.0, 5.0), 1.0), None);
    }
}
