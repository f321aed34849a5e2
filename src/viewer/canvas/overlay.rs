//! Overlays on the image: the legend of a view, the marked region, the histogram of z-scores.
use egui::{Align2, Color32, FontId, Pos2, Rect, Stroke, StrokeKind, Ui, Vec2, pos2, vec2};
use noisefall_render::render::{
    Region,
    view::{Legend, Scale, ZScoreHistogram},
};

use super::picture_area::PictureArea;

const INK: Color32 = Color32::WHITE;
const MARGIN: f32 = 12.0;

/// Draws the marked region, the histogram of z-scores and the legend.
pub fn show(ui: &Ui, area: &PictureArea, region: Option<Region>, scores: Option<&ZScoreHistogram>, legend: Option<&Legend>) {
    if let Some(region) = region {
        show_region(ui, area, region);
    }
    let mut bottom = area.clip.bottom() - MARGIN;
    if let Some(scores) = scores {
        bottom -= histogram(ui, area.clip.left() + MARGIN, bottom, scores) + 8.0;
    }
    if let Some(legend) = legend {
        draw_legend(ui, area.clip.left() + MARGIN, bottom, legend);
    }
}

/// Draws the region as it was marked, and the tiles that it covers.
fn show_region(ui: &Ui, area: &PictureArea, region: Region) {
    let painter = ui.painter_at(area.clip);
    let resolution = [area.resolution.x as u32, area.resolution.y as u32];
    let tiles = area.of_region(&region.in_tiles(resolution));
    painter.rect_stroke(tiles, 0.0, Stroke::new(1.0, Color32::from_white_alpha(90)), StrokeKind::Outside);
    let rect = area.of_region(&region);
    painter.rect_stroke(rect, 0.0, Stroke::new(2.5, Color32::from_black_alpha(160)), StrokeKind::Outside);
    painter.rect_stroke(rect, 0.0, Stroke::new(1.5, Color32::from_rgb(255, 214, 90)), StrokeKind::Outside);
}

/// Draws a dark background for text over the image. Returns its upper left corner.
fn ground(ui: &Ui, left: f32, bottom: f32, size: Vec2) -> Pos2 {
    let rect = Rect::from_min_size(pos2(left, bottom - size.y), size);
    ui.painter().rect_filled(rect, 6.0, Color32::from_black_alpha(190));
    rect.min + vec2(10.0, 8.0)
}

fn draw_legend(ui: &Ui, left: f32, bottom: f32, legend: &Legend) {
    const LINE: f32 = 17.0;
    const WIDTH: f32 = 250.0;
    let unit = legend.scale.as_ref().filter(|scale| !scale.unit.is_empty());
    let unit = unit.map_or_else(String::new, |scale| format!(", {}", scale.unit));
    let title = format!("{}{unit}", legend.title);
    let title = ui.painter().layout(title, FontId::proportional(13.0), INK, WIDTH);
    let scale = if legend.scale.is_some() { 36.0 } else { 0.0 };
    let height = 14.0 + title.size().y + scale + LINE * legend.entries.len() as f32;
    let corner = ground(ui, left, bottom, vec2(WIDTH + 20.0, height));
    let mut y = corner.y + title.size().y + 5.0;
    ui.painter().galley(corner, title, INK);
    if let Some(scale) = &legend.scale {
        bar(ui, Rect::from_min_size(pos2(corner.x, y), vec2(WIDTH, 12.0)), scale);
        y += 36.0;
    }
    for ([r, g, b], name) in &legend.entries {
        let square = Rect::from_min_size(pos2(corner.x, y + 2.0), vec2(11.0, 11.0));
        ui.painter().rect_filled(square, 2.0, Color32::from_rgb(*r, *g, *b));
        ui.painter().text(pos2(corner.x + 18.0, y), Align2::LEFT_TOP, name, FontId::proportional(12.5), INK);
        y += LINE;
    }
}

/// Draws a colour scale with numbers below it.
fn bar(ui: &Ui, rect: Rect, scale: &Scale) {
    const STRIPS: usize = 125;
    for i in 0..STRIPS {
        let [r, g, b] = scale.map.of((i as f32 + 0.5) / STRIPS as f32);
        let edge = |i: usize| egui::lerp(rect.x_range(), i as f32 / STRIPS as f32);
        let strip = Rect::from_x_y_ranges(edge(i)..=edge(i + 1) + 0.5, rect.y_range());
        ui.painter().rect_filled(strip, 0.0, Color32::from_rgb(r, g, b));
    }
    for (place, align) in [(0.0, Align2::LEFT_TOP), (0.5, Align2::CENTER_TOP), (1.0, Align2::RIGHT_TOP)] {
        let (x, is_signed) = (scale.number(place), scale.ends[0] < 0.0);
        let text = if is_signed && x > 0.0 { format!("+{}", number(x)) } else { number(x) };
        let at = pos2(egui::lerp(rect.x_range(), place), rect.bottom() + 3.0);
        ui.painter().text(at, align, text, FontId::proportional(12.0), INK);
    }
}

/// Draws the histogram of z-scores with the unit normal distribution. Returns its height.
fn histogram(ui: &Ui, left: f32, bottom: f32, scores: &ZScoreHistogram) -> f32 {
    const SIZE: Vec2 = Vec2 { x: 250.0, y: 96.0 };
    const AROUND: Vec2 = Vec2 { x: 20.0, y: 54.0 };
    let corner = ground(ui, left, bottom, SIZE + AROUND);
    let plot = Rect::from_min_size(corner, SIZE);
    let most = scores.density.iter().copied().fold(ZScoreHistogram::normal(0.0), f64::max) * 1.05;
    let at = |z: f64, density: f64| {
        let x = (z + ZScoreHistogram::END) / (2.0 * ZScoreHistogram::END);
        pos2(plot.left() + plot.width() * x as f32, plot.bottom() - plot.height() * (density / most) as f32)
    };
    for (bin, density) in scores.density.iter().enumerate() {
        let middle = ZScoreHistogram::middle(bin);
        let bar = Rect::from_two_pos(
            at(middle - 0.5 * ZScoreHistogram::WIDTH, *density),
            at(middle + 0.5 * ZScoreHistogram::WIDTH, 0.0),
        );
        ui.painter().rect_filled(bar, 0.0, Color32::from_rgb(86, 180, 233));
    }
    let curve: Vec<Pos2> = (-50..=50).map(|i| f64::from(i) * 0.1).map(|z| at(z, ZScoreHistogram::normal(z))).collect();
    ui.painter().line(curve, Stroke::new(1.8, Color32::from_rgb(255, 190, 70)));
    for z in [-4, -2, 0, 2, 4] {
        let place = at(f64::from(z), 0.0) + vec2(0.0, 2.0);
        ui.painter().text(place, Align2::CENTER_TOP, z, FontId::proportional(11.0), INK);
    }
    let beyond = if scores.beyond > 0.0 { format!("; {:.1} % beyond", 100.0 * scores.beyond) } else { String::new() };
    let text = format!("mean {:+.2} (0), deviation {:.2} (1 or less){beyond}", scores.mean, scores.deviation);
    let below = plot.left_bottom() + vec2(0.0, 18.0);
    ui.painter().text(below, Align2::LEFT_TOP, text, FontId::proportional(12.0), INK);
    SIZE.y + AROUND.y
}

/// Formats a number with as many digits as fit into a legend.
fn number(x: f32) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        0.01..10_000.0 => format!("{}", (f64::from(x) * 1000.0).round() / 1000.0),
        _ => format!("{x:.0e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn numbers_of_a_legend_are_short() {
        assert_eq!([0.0, 0.25, -12.3456, 0.0104, 9999.0].map(number), ["0", "0.25", "-12.346", "0.01", "9999"]);
        assert_eq!([0.0003, 123_456.0].map(number), ["3e-4", "1e5"]);
    }
}
