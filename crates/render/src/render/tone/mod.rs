//! Tone maps: how radiance, which has no upper bound, becomes display light in [0, 1]; the same for screen and file.
//!
//! A tone map is one file and one line of the catalogue below.
mod aces;
mod agx;
mod clip;
mod false_colour;
mod neutral;
mod reinhard;

use serde::Serialize;

use super::{display::encode, white_balance::WhiteBalance};
use noisefall_base::declare::Word;

/// Display settings, which do not affect the render.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Display {
    /// In stops: radiance is multiplied by 2 to this power.
    pub exposure: f32,
    /// The light that appears white.
    pub white_balance: WhiteBalance,
    /// The tone map.
    pub tone_map: ToneMap,
}

noisefall_base::declare::word_kinds! {
    /// The tone maps.
    #[derive(Serialize)]
    pub enum ToneMap: Tone, default None {
        clip::None,
        reinhard::Reinhard,
        aces::Aces,
        agx::Agx,
        neutral::Neutral,
        false_colour::FalseColour,
    }
    in_tone_map
}

/// Converts an image to 8-bit sRGB with an opaque fourth channel, row by row from the top left, and replaces the contents of `pixels`.
/// (Reusing its memory halves the time.)
pub fn to_srgb(radiance: &[[f32; 3]], display: Display, pixels: &mut Vec<[u8; 4]>) {
    pixels.clear();
    let scale = display.exposure.exp2();
    let balance = display.white_balance.matrix().map(|rows| rows.map(|row| row.map(|factor| factor * scale)));
    in_tone_map!(display.tone_map, T => T::show(radiance, &Gain { scale, balance }, pixels));
}

/// The luminances of the first and the last false colour, after exposure.
const FALSE_COLOUR_RANGE: [f32; 2] = [1e-3, 1e3];

/// The luminances at the ends of the colour scale, if the tone map is one.
pub fn false_colour_range(display: Display) -> Option<[f32; 2]> {
    let range = || FALSE_COLOUR_RANGE.map(|end| end / display.exposure.exp2());
    (display.tone_map == ToneMap::FalseColour).then(range)
}

/// Factors of radiance before a tone map.
struct Gain {
    /// The factor of the exposure.
    scale: f32,
    /// The matrix of exposure and white balance, if there is one.
    balance: Option<Rows>,
}

/// A matrix, row by row.
type Rows = [[f32; 3]; 3];

fn times(rows: &Rows, [r, g, b]: [f32; 3]) -> [f32; 3] {
    rows.map(|row| row[0] * r + row[1] * g + row[2] * b)
}

/// A tone map.
trait Tone {
    const WORD: Word;

    /// Linear display light of linear radiance, clipped at 0 and 1 afterwards.
    fn map(radiance: [f32; 3]) -> [f32; 3];

    /// Appends the sRGB codes of radiance times `gain`.
    fn show(radiance: &[[f32; 3]], gain: &Gain, pixels: &mut Vec<[u8; 4]>) {
        let scale = gain.scale;
        match &gain.balance {
            None => encode(radiance, pixels, |radiance| Self::map(radiance.map(|c| c * scale))),
            // Saturated colours can leave the gamut.
            Some(rows) => encode(radiance, pixels, |radiance| Self::map(times(rows, radiance).map(|c| c.max(0.0)))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_base::math::colour::srgb_from_linear;

    #[test]
    fn exposure_doubles_and_tone_maps_do_as_their_formulas_say() {
        let radiance = [[0.25, 0.0, 2.0]];
        let code = |x: f64| (srgb_from_linear(x.min(1.0)) * 255.0).round() as u8;
        let show = |exposure, tone_map| {
            let mut pixels = Vec::new();
            to_srgb(&radiance, Display { exposure, tone_map, ..Display::default() }, &mut pixels);
            pixels[0]
        };
        assert_eq!(show(1.0, ToneMap::None), [code(0.5), 0, 255, 255]);
        let y = 0.25 * 0.2126 + 2.0 * 0.0722;
        assert_eq!(show(0.0, ToneMap::Reinhard), [code(0.25 / (1.0 + y)), 0, 255, 255]);
        let aces = |c: f64| c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14);
        assert_eq!(show(0.0, ToneMap::Aces), [code(aces(0.25)), 0, code(aces(2.0)), 255]);
        assert_eq!(show(1.0, ToneMap::Aces), [code(aces(0.5)), 0, code(aces(4.0)), 255]);
    }

    /// All that map light to light and have a shoulder.
    const CURVES: [ToneMap; 4] = [ToneMap::Reinhard, ToneMap::Aces, ToneMap::Agx, ToneMap::Neutral];

    #[test]
    fn greys_stay_grey_and_brighter_ones_are_brighter() {
        for tone_map in CURVES {
            let greys: Vec<[f32; 3]> = (0..2000).map(|i| [0.01 * 1.005f32.powi(i) - 0.01; 3]).collect();
            let mut pixels = Vec::new();
            to_srgb(&greys, Display { tone_map, ..Display::default() }, &mut pixels);
            assert!(pixels.iter().all(|[r, g, b, _]| r == g && g == b), "{tone_map:?}");
            assert!(pixels.is_sorted() && pixels[0][0] == 0 && pixels[1999][0] >= 250, "{tone_map:?}: {:?}", pixels[1999]);
        }
    }

    #[test]
    fn light_of_a_curve_is_between_black_and_white() {
        let light = |tone_map, grey: f32| in_tone_map!(tone_map, T => T::map([grey; 3]))[1];
        for tone_map in [ToneMap::Reinhard, ToneMap::Agx, ToneMap::Neutral] {
            let lights: Vec<f32> = (-200..200).map(|i| light(tone_map, (0.1 * i as f32).exp2())).collect();
            assert!(lights.is_sorted() && lights.iter().all(|x| (0.0..=1.0).contains(x)), "{tone_map:?}: {lights:?}");
        }
    }

    #[test]
    fn white_balance_comes_before_the_tone_map_and_a_neutral_one_changes_no_bit() {
        let radiance: Vec<[f32; 3]> = (0..600).map(|i| [0.002 * i as f32, 0.3, 1.2 - 0.002 * i as f32]).collect();
        let show = |display| {
            let mut pixels = Vec::new();
            to_srgb(&radiance, display, &mut pixels);
            pixels
        };
        for tone_map in ToneMap::ALL {
            let plain = Display { exposure: 0.5, tone_map, ..Display::default() };
            let warm = Display { white_balance: WhiteBalance { kelvin: 3000.0, tint: 5.0 }, ..plain };
            let rows = warm.white_balance.matrix().expect("it is not neutral");
            let scaled = |pixel: &[f32; 3]| times(&rows.map(|row| row.map(|x| x * 0.5f32.exp2())), *pixel).map(|c| c.max(0.0));
            let balanced: Vec<[f32; 3]> = radiance.iter().map(scaled).collect();
            let mut exact = Vec::new();
            to_srgb(&balanced, Display { exposure: 0.0, ..plain }, &mut exact);
            if tone_map == ToneMap::FalseColour {
                assert_eq!(show(warm), show(plain), "it measures the light of the scene");
            } else {
                assert_eq!(show(warm), exact, "{tone_map:?}");
                assert_ne!(show(warm), show(plain), "{tone_map:?}");
            }
        }
    }
}
