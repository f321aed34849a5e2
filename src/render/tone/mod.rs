//! Tone maps: how radiance, which has no upper bound, becomes display light in [0, 1]; the same for screen and file.
//!
//! A tone map is one file and one line of the catalogue below.
mod aces;
mod clip;
mod false_colour;
mod reinhard;

use serde::Serialize;

use super::display::encode;
use crate::declare::Word;

/// Display settings, which do not affect the render.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Display {
    /// In stops: radiance is multiplied by 2 to this power.
    pub exposure: f32,
    /// The tone map.
    pub tone_map: ToneMap,
}

crate::declare::word_kinds! {
    /// The tone maps.
    #[derive(Serialize)]
    pub enum ToneMap: Tone, default None {
        clip::None,
        reinhard::Reinhard,
        aces::Aces,
        false_colour::FalseColour,
    }
    in_tone_map
}

/// Converts an image to 8-bit sRGB with an opaque fourth channel, row by row from the top left, and replaces the contents of `pixels`.
/// (Reusing its memory halves the time.)
pub fn to_srgb(radiance: &[[f32; 3]], display: Display, pixels: &mut Vec<[u8; 4]>) {
    pixels.clear();
    in_tone_map!(display.tone_map, T => T::show(radiance, display.exposure.exp2(), pixels));
}

/// A tone map.
trait Tone {
    const WORD: Word;

    /// Linear display light of linear radiance, clipped at 1 afterwards.
    fn map(radiance: [f32; 3]) -> [f32; 3];

    /// Appends the sRGB codes of radiance times `scale`.
    fn show(radiance: &[[f32; 3]], scale: f32, pixels: &mut Vec<[u8; 4]>) {
        encode(radiance, pixels, |radiance| Self::map(radiance.map(|c| c * scale)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::colour::srgb_from_linear;

    #[test]
    fn exposure_doubles_and_tone_maps_do_as_their_formulas_say() {
        let radiance = [[0.25, 0.0, 2.0]];
        let code = |x: f64| (srgb_from_linear(x.min(1.0)) * 255.0).round() as u8;
        let show = |exposure, tone_map| {
            let mut pixels = Vec::new();
            to_srgb(&radiance, Display { exposure, tone_map }, &mut pixels);
            pixels[0]
        };
        assert_eq!(show(1.0, ToneMap::None), [code(0.5), 0, 255, 255]);
        let y = 0.25 * 0.2126 + 2.0 * 0.0722;
        assert_eq!(show(0.0, ToneMap::Reinhard), [code(0.25 / (1.0 + y)), 0, 255, 255]);
        let aces = |c: f64| c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14);
        assert_eq!(show(0.0, ToneMap::Aces), [code(aces(0.25)), 0, code(aces(2.0)), 255]);
        assert_eq!(show(1.0, ToneMap::Aces), [code(aces(0.5)), 0, code(aces(4.0)), 255]);
    }
}
