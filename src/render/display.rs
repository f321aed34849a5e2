//! The display transform: from a frame to 8-bit sRGB, the same for screen and file.
use std::sync::LazyLock;

use super::{
    frame::Frame,
    tone::{Display, ToneMap},
};
use crate::math::colour::{linear_from_srgb, luminance, srgb_from_linear};

/// The picture as 8-bit sRGB with an opaque fourth channel, row by row from the top left.
pub fn to_srgb(frame: &Frame, display: Display) -> Vec<u8> {
    let scale = display.exposure.exp2();
    let mut bytes = vec![255; frame.radiance.len() * 4];
    let pixels = bytes.as_chunks_mut::<4>().0.iter_mut().zip(&frame.radiance);
    if display.tone_map == ToneMap::FalseColour {
        let colours = &*FALSE_COLOURS;
        for (pixel, radiance) in pixels {
            pixel[..3].copy_from_slice(&colours.of(luminance(*radiance) * scale));
        }
    } else {
        let encode = &*SRGB;
        for (pixel, radiance) in pixels {
            let light = display.tone_map.apply(radiance.map(|c| c * scale));
            pixel[..3].copy_from_slice(&light.map(|c| encode.of(c)));
        }
    }
    bytes
}

static SRGB: LazyLock<SrgbTable> = LazyLock::new(SrgbTable::new);
static FALSE_COLOURS: LazyLock<FalseColours> = LazyLock::new(FalseColours::new);

/// The sRGB code of a linear value by table, exactly as rounding the formula gives it.
///
/// The upper bits of a float name a bucket so narrow that at most one code begins within it; the entry holds the bucket's first
/// code and the value from which the next one holds.
struct SrgbTable {
    buckets: Vec<(f32, u8)>,
}

impl SrgbTable {
    /// Buckets of 256 to the octave.
    const SHIFT: u32 = 15;
    /// Below this everything is code 0: half a code is 1.5e-4.
    const LOWEST: f32 = 1.0 / 8192.0;

    fn new() -> SrgbTable {
        let code = |x: f32| (srgb_from_linear(f64::from(x)) * 255.0).round() as u8;
        let first = Self::LOWEST.to_bits() >> Self::SHIFT;
        let last = 1f32.to_bits() >> Self::SHIFT;
        let bucket = |b: u32| {
            let base = code(f32::from_bits(b << Self::SHIFT));
            (next_code_from(base), base)
        };
        SrgbTable { buckets: (first..last).map(bucket).collect() }
    }

    #[inline(always)]
    fn of(&self, x: f32) -> u8 {
        // Written so that NaN becomes black.
        if x >= 1.0 {
            return 255;
        }
        let x = if x > Self::LOWEST { x } else { Self::LOWEST };
        let bucket = (x.to_bits() - Self::LOWEST.to_bits()) >> Self::SHIFT;
        let (next, base) = self.buckets[bucket as usize];
        base + u8::from(x >= next)
    }
}

/// The smallest float whose code is above `code`.
fn next_code_from(code: u8) -> f32 {
    let edge = linear_from_srgb((f64::from(code) + 0.5) / 255.0) as f32;
    let above = |x: f32| (srgb_from_linear(f64::from(x)) * 255.0).round() > f64::from(code);
    let mut x = edge.next_down().next_down();
    while !above(x) {
        x = x.next_up();
    }
    x
}

/// Luminance from 10⁻³ to 10³ on a logarithmic scale through the colours of viridis (S. van der Walt and N. Smith, 2015).
struct FalseColours {
    colours: Vec<[u8; 3]>,
}

impl FalseColours {
    /// Buckets of 32 to the octave.
    const SHIFT: u32 = 18;
    const LOWEST: f32 = 1e-3;
    const HIGHEST: f32 = 1e3;

    fn new() -> FalseColours {
        let buckets = Self::bucket(Self::HIGHEST) + 1;
        let colour = |b: usize| viridis(b as f32 / (buckets - 1) as f32);
        FalseColours { colours: (0..buckets).map(colour).collect() }
    }

    #[inline(always)]
    fn bucket(x: f32) -> usize {
        ((x.to_bits() - Self::LOWEST.to_bits()) >> Self::SHIFT) as usize
    }

    #[inline(always)]
    fn of(&self, x: f32) -> [u8; 3] {
        let x = if x > Self::LOWEST { x.min(Self::HIGHEST) } else { Self::LOWEST };
        self.colours[Self::bucket(x)]
    }
}

/// Viridis at nine equidistant points, linear between them; 8-bit sRGB.
pub fn viridis(at: f32) -> [u8; 3] {
    const POINTS: [[f32; 3]; 9] = [
        [68.0, 1.0, 84.0],
        [72.0, 40.0, 120.0],
        [62.0, 74.0, 137.0],
        [49.0, 104.0, 142.0],
        [38.0, 130.0, 142.0],
        [31.0, 158.0, 137.0],
        [53.0, 183.0, 121.0],
        [143.0, 215.0, 68.0],
        [253.0, 231.0, 37.0],
    ];
    let place = at.clamp(0.0, 1.0) * (POINTS.len() - 1) as f32;
    let i = (place as usize).min(POINTS.len() - 2);
    let t = place - i as f32;
    std::array::from_fn(|c| (POINTS[i][c] + (POINTS[i + 1][c] - POINTS[i][c]) * t).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_rounds_exactly_as_the_formula() {
        let mut bits = 0f32.to_bits();
        while bits < 1.1f32.to_bits() {
            let x = f32::from_bits(bits);
            let exact = (srgb_from_linear(f64::from(x.min(1.0))) * 255.0).round() as u8;
            assert_eq!(SRGB.of(x), exact, "at {x:e}");
            bits += 257;
        }
        for code in 0..255 {
            let edge = next_code_from(code);
            assert_eq!((SRGB.of(edge.next_down()), SRGB.of(edge)), (code, code + 1));
        }
    }

    #[test]
    fn what_is_no_number_is_black_and_what_is_too_bright_is_white() {
        assert_eq!([f32::NAN, -1.0, f32::NEG_INFINITY, f32::INFINITY, 7.0].map(|x| SRGB.of(x)), [0, 0, 0, 255, 255]);
        assert_eq!(FALSE_COLOURS.of(f32::NAN), viridis(0.0));
        assert_eq!(FALSE_COLOURS.of(f32::INFINITY), viridis(1.0));
    }

    #[test]
    fn exposure_doubles_and_tone_maps_do_as_their_formulas_say() {
        let frame = Frame { radiance: vec![[0.25, 0.0, 2.0]], ..Frame::default() };
        let code = |x: f64| (srgb_from_linear(x.min(1.0)) * 255.0).round() as u8;
        let show = |exposure, tone_map| to_srgb(&frame, Display { exposure, tone_map });
        assert_eq!(show(1.0, ToneMap::None), [code(0.5), 0, 255, 255]);
        let y = 0.25 * 0.2126 + 2.0 * 0.0722;
        assert_eq!(show(0.0, ToneMap::Reinhard), [code(0.25 / (1.0 + y)), 0, 255, 255]);
        let aces = |c: f64| c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14);
        assert_eq!(show(0.0, ToneMap::Aces), [code(aces(0.25)), 0, code(aces(2.0)), 255]);
    }
}
