//! Linear Rec. 709 colour and the sRGB transfer function.

/// Weights of red, green and blue in the luminance of linear Rec. 709 light (ITU-R BT.709-6, item 3.2).
pub const LUMINANCE: [f32; 3] = [0.2126, 0.7152, 0.0722];

/// Relative luminance of a linear Rec. 709 colour.
pub fn luminance(rgb: [f32; 3]) -> f32 {
    LUMINANCE[0] * rgb[0] + LUMINANCE[1] * rgb[1] + LUMINANCE[2] * rgb[2]
}

/// The display value in [0, 1] of a linear value in [0, 1] (IEC 61966-2-1).
pub fn srgb_from_linear(x: f64) -> f64 {
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

/// The linear value in [0, 1] of a display value in [0, 1] (IEC 61966-2-1).
pub fn linear_from_srgb(x: f64) -> f64 {
    if x <= 0.040_45 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}
