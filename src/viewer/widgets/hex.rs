//! Colours as hexadecimal sRGB, and the brightness that these digits cannot express.
use noisefall_base::math::colour::{linear_from_srgb, srgb_from_linear};

/// The factor that brings the largest channel to 1: 1 if no channel is larger.
pub fn brightness(rgb: [f64; 3]) -> f64 {
    rgb.into_iter().fold(1.0, f64::max)
}

/// `#rrggbb` of a linear Rec. 709 colour, divided by its [brightness].
pub fn hex(rgb: [f64; 3]) -> String {
    let [r, g, b] = bytes(rgb);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The sRGB bytes of a linear Rec. 709 colour, divided by its [brightness].
pub fn bytes(rgb: [f64; 3]) -> [u8; 3] {
    let most = brightness(rgb);
    rgb.map(|x| (255.0 * srgb_from_linear((x / most).clamp(0.0, 1.0))).round() as u8)
}

/// The linear Rec. 709 colour of sRGB bytes.
pub fn linear(bytes: [u8; 3]) -> [f64; 3] {
    bytes.map(|byte| linear_from_srgb(f64::from(byte) / 255.0))
}

/// Reads `#rrggbb`, `rrggbb` or `#rgb`.
pub fn from_hex(text: &str) -> Result<[u8; 3], String> {
    let digits: Option<Vec<u8>> = text.trim().trim_start_matches('#').chars().map(|c| Some(c.to_digit(16)? as u8)).collect();
    match digits.as_deref() {
        Some(&[r, g, b]) => Ok([r, g, b].map(|digit| 17 * digit)),
        Some(&[a, b, c, d, e, f]) => Ok([16 * a + b, 16 * c + d, 16 * e + f]),
        _ => {
            Err(format!("expected six hexadecimal digits such as #ff8000, found “{}”", noisefall_base::quote::piece(text.trim())))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_reads_as_it_is_written() {
        for byte in 0..=255 {
            let bytes = [byte, 255 - byte, 7];
            assert_eq!(from_hex(&hex(linear(bytes))), Ok(bytes));
        }
    }

    #[test]
    fn bright_colours_keep_their_hue() {
        assert_eq!(hex([50.0, 25.0, 0.0]), hex([1.0, 0.5, 0.0]));
        assert_eq!((brightness([50.0, 25.0, 0.0]), brightness([0.5, 0.25, 0.0])), (50.0, 1.0));
    }

    #[test]
    fn short_and_plain_forms_are_read_and_others_are_refused() {
        assert_eq!([from_hex("#f80"), from_hex(" ff8800 ")], [Ok([255, 136, 0]), Ok([255, 136, 0])]);
        let refused = from_hex("#12345g").expect_err("g is no digit");
        assert_eq!(refused, "expected six hexadecimal digits such as #ff8000, found “#12345g”");
        assert!(from_hex("#12345").is_err() && from_hex("").is_err());
    }
}
