//! Cells of the tables of terms.
use egui::{Response, RichText, Ui};
use noisefall_scene::scene::Object;

/// Size of text, points.
pub const TEXT: f32 = 12.0;
/// Width of the name of a vertex, so that the tables fit beside the samples in a window of 1280 points.
pub const VERTEX_WIDTH: f32 = 96.0;

/// A colour channel; the table shows one, so that factors multiply and terms add up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Channel {
    #[default]
    Red,
    Green,
    Blue,
}

/// Shows a number.
pub fn cell(ui: &mut Ui, text: String, is_strong: bool) -> Response {
    let text = RichText::new(text).monospace().size(TEXT);
    ui.label(if is_strong { text.strong() } else { text })
}

/// The name of an object.
pub fn name(objects: &[Object], id: u32) -> String {
    let name = objects.get(id as usize).map_or("", |object| object.name.as_str());
    if name.is_empty() { format!("object {}", id + 1) } else { name.to_owned() }
}

/// A colour in three numbers, or in one where they are the same.
pub fn colour([r, g, b]: [f32; 3]) -> String {
    if r == g && g == b { short(r) } else { format!("{} {} {}", short(r), short(g), short(b)) }
}

/// Four digits that count, as short as they can be.
pub fn short(x: f32) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        0.001..10.0 => format!("{x:.3}"),
        10.0..1000.0 => format!("{x:.1}"),
        _ => format!("{x:.1e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_colours_one_number_where_they_are_grey() {
        assert_eq!([0.0, 0.5, 12.34, 4321.0, 0.000_12].map(short), ["0", "0.500", "12.3", "4.3e3", "1.2e-4"]);
        assert_eq!((colour([0.5; 3]), colour([0.5, 1.0, 2.0])), ("0.500".to_owned(), "0.500 1.000 2.000".to_owned()));
    }
}
