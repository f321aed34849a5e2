//! The display transform: from a frame to 8-bit sRGB, the same for screen and file.
use std::sync::LazyLock;

use fearless_simd_macros::simd;

use super::{
    colour_map::ColourMap,
    tone::{Display, ToneMap, aces, reinhard},
};
use crate::{
    in_lanes,
    math::{
        Lanes, SimdLevel,
        colour::{linear_from_srgb, luminance, srgb_from_linear},
    },
};

/// Converts an image to 8-bit sRGB with an opaque fourth channel, row by row from the top left, and replaces the contents of
/// `pixels`. (Reusing its memory halves the time.)
pub fn to_srgb(radiance: &[[f32; 3]], display: Display, pixels: &mut Vec<[u8; 4]>) {
    let scale = display.exposure.exp2();
    pixels.clear();
    match display.tone_map {
        ToneMap::None => encode(radiance, pixels, |radiance| radiance.map(|c| c * scale)),
        ToneMap::Reinhard => encode(radiance, pixels, |radiance| reinhard(radiance.map(|c| c * scale))),
        ToneMap::Aces => encode(radiance, pixels, |radiance| aces(radiance.map(|c| c * scale))),
        ToneMap::FalseColour => {
            let colours = &*FALSE_COLOURS;
            pixels.extend(radiance.iter().map(|radiance| colours.of(luminance(*radiance) * scale)));
        }
    }
}

/// Applies `tone` to the radiance and appends sRGB codes. Light and codes of a block are computed in separate short loops, which
/// the compiler can vectorise; it cannot vectorise a loop over pixels.
#[inline(always)]
fn encode(radiance: &[[f32; 3]], pixels: &mut Vec<[u8; 4]>, tone: impl Fn([f32; 3]) -> [f32; 3]) {
    const BLOCK: usize = 512;
    let (table, level) = (&*SRGB, SimdLevel::best());
    let (mut light, mut codes) = ([[0.0; 3]; BLOCK], [[0; 3]; BLOCK]);
    for block in radiance.chunks(BLOCK) {
        for (light, radiance) in light.iter_mut().zip(block) {
            *light = tone(*radiance);
        }
        in_lanes!(level, l => encode_block(l, table, light.as_flattened(), codes.as_flattened_mut()));
        pixels.extend(codes[..block.len()].iter().map(|[r, g, b]| [*r, *g, *b, 255]));
    }
}

/// A loop for the compiler to vectorise with the instructions of the level.
#[simd]
fn encode_block<L: Lanes>(_: L, table: &SrgbTable, light: &[f32], codes: &mut [u8]) {
    for (code, light) in codes.iter_mut().zip(light) {
        *code = table.of(*light);
    }
}

static SRGB: LazyLock<SrgbTable> = LazyLock::new(SrgbTable::new);
static FALSE_COLOURS: LazyLock<FalseColours> = LazyLock::new(FalseColours::new);

/// A table for the sRGB code of a linear value, exactly as the rounded formula.
///
/// The upper bits of a float select a bucket in which at most one code begins. The bucket's entry is its first code times 2¹⁵,
/// plus the complement of the lower 15 bits at which the next code begins, so that adding the lower bits carries over exactly
/// there.
struct SrgbTable {
    entries: Box<[u32; ENTRIES]>,
}

/// More than the number of buckets, because a power of two needs no bounds check.
const ENTRIES: usize = 4096;

impl SrgbTable {
    /// Selects 256 buckets per octave.
    const SHIFT: u32 = 15;
    /// Below this everything is code 0: half a code is 1.5e-4.
    const LOWEST: f32 = 1.0 / 8192.0;
    const HIGHEST: f32 = 1.0 - f32::EPSILON / 2.0;

    fn new() -> SrgbTable {
        let code = |bits: u32| (srgb_from_linear(f64::from(f32::from_bits(bits))) * 255.0).round() as u8;
        let first = Self::LOWEST.to_bits() >> Self::SHIFT;
        let last = 1f32.to_bits() >> Self::SHIFT;
        let mut entries = Box::new([0; ENTRIES]);
        for (entry, bucket) in entries.iter_mut().zip(first..last) {
            let base = code(bucket << Self::SHIFT);
            let next = next_code_from(base).to_bits().min((bucket + 1) << Self::SHIFT);
            *entry = (u32::from(base) << Self::SHIFT) + ((bucket + 1) << Self::SHIFT) - next;
        }
        SrgbTable { entries }
    }

    #[inline(always)]
    fn of(&self, x: f32) -> u8 {
        // Written so that NaN becomes black; the code of what is just below 1 is that of 1.
        let x = if x > Self::LOWEST { x } else { Self::LOWEST };
        let x = if x < Self::HIGHEST { x } else { Self::HIGHEST };
        let offset = x.to_bits() - Self::LOWEST.to_bits();
        let entry = self.entries[(offset >> Self::SHIFT) as usize % ENTRIES];
        ((entry + offset % (1 << Self::SHIFT)) >> Self::SHIFT) as u8
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

/// Luminance from 10⁻³ to 10³ on a logarithmic scale through the colours of viridis.
struct FalseColours {
    /// More than the number of buckets, because a power of two needs no bounds check.
    colours: Box<[[u8; 4]; 1024]>,
}

impl FalseColours {
    /// Selects 32 buckets per octave.
    const SHIFT: u32 = 18;
    const LOWEST: f32 = 1e-3;
    const HIGHEST: f32 = 1e3;

    fn new() -> FalseColours {
        let mut colours = Box::new([[0; 4]; 1024]);
        let last = Self::bucket(Self::HIGHEST);
        for (b, colour) in colours.iter_mut().enumerate() {
            let [r, g, b] = ColourMap::Viridis.of((b as f32 / last as f32).min(1.0));
            *colour = [r, g, b, 255];
        }
        FalseColours { colours }
    }

    #[inline(always)]
    fn bucket(x: f32) -> usize {
        ((x.to_bits() - Self::LOWEST.to_bits()) >> Self::SHIFT) as usize
    }

    #[inline(always)]
    #[expect(clippy::manual_clamp, reason = "what is no number must become dark, and clamp keeps it")]
    fn of(&self, x: f32) -> [u8; 4] {
        self.colours[Self::bucket(x.max(Self::LOWEST).min(Self::HIGHEST)) % 1024]
    }
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
        assert_eq!(FALSE_COLOURS.of(f32::NAN)[..3], ColourMap::Viridis.of(0.0));
        assert_eq!(FALSE_COLOURS.of(f32::INFINITY)[..3], ColourMap::Viridis.of(1.0));
    }

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
