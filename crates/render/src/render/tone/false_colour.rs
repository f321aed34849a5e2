//! Luminance on a logarithmic scale of colours, six decades around 1.
use std::sync::LazyLock;

use super::{FALSE_COLOUR_RANGE as RANGE, Gain, Tone};
use crate::render::colour_map::ColourMap;
use noisefall_base::{declare::Word, math::colour::luminance};

pub(super) struct FalseColour;

impl Tone for FalseColour {
    const WORD: Word = Word {
        name: "false-colour",
        title: "False colour",
        doc: "Luminance on a logarithmic colour scale, from 0.001 (violet) to 1000 (yellow).",
    };

    fn map(radiance: [f32; 3]) -> [f32; 3] {
        radiance
    }

    /// Without white balance: the scale is of the light in the scene.
    fn show(radiance: &[[f32; 3]], gain: &Gain, pixels: &mut Vec<[u8; 4]>) {
        let (colours, scale) = (&*FALSE_COLOURS, gain.scale);
        pixels.extend(radiance.iter().map(|radiance| colours.of(luminance(*radiance) * scale)));
    }
}

static FALSE_COLOURS: LazyLock<FalseColours> = LazyLock::new(FalseColours::new);

/// Luminance from 10⁻³ to 10³ on a logarithmic scale through the colours of viridis.
struct FalseColours {
    /// More than the number of buckets, because a power of two needs no bounds check.
    colours: Box<[[u8; 4]; 1024]>,
}

impl FalseColours {
    /// Selects 32 buckets per octave.
    const SHIFT: u32 = 18;
    const LOWEST: f32 = RANGE[0];
    const HIGHEST: f32 = RANGE[1];

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
    fn nan_is_dark_and_too_bright_values_have_the_last_colour() {
        assert_eq!(FALSE_COLOURS.of(f32::NAN)[..3], ColourMap::Viridis.of(0.0));
        assert_eq!(FALSE_COLOURS.of(f32::INFINITY)[..3], ColourMap::Viridis.of(1.0));
    }
}
