//! Display light as 8-bit sRGB.
use std::sync::LazyLock;

use fearless_simd_macros::simd;

use noisefall_base::math::{
    Lanes, SimdLevel,
    colour::{linear_from_srgb, srgb_from_linear},
    in_lanes,
};

/// Applies `tone` to the radiance and appends sRGB codes. Light and codes of a block are computed in separate short loops, which
/// the compiler can vectorise; it cannot vectorise a loop over pixels.
#[inline(always)]
pub(super) fn encode(radiance: &[[f32; 3]], pixels: &mut Vec<[u8; 4]>, tone: impl Fn([f32; 3]) -> [f32; 3]) {
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
    fn nan_is_black_and_too_bright_values_are_white() {
        assert_eq!([f32::NAN, -1.0, f32::NEG_INFINITY, f32::INFINITY, 7.0].map(|x| SRGB.of(x)), [0, 0, 0, 255, 255]);
    }
}
