//! The colours of curves.
use egui::Color32;

/// Distinct for colour-blind readers too, and on dark and light ground (M. Okabe and K. Ito, "Color Universal Design", 2008).
pub const COLOURS: [Color32; 6] = [
    Color32::from_rgb(86, 180, 233),
    Color32::from_rgb(230, 130, 20),
    Color32::from_rgb(0, 158, 115),
    Color32::from_rgb(204, 121, 167),
    Color32::from_rgb(0, 114, 178),
    Color32::from_rgb(150, 150, 150),
];
