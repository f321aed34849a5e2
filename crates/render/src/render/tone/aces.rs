//! A filmic curve: the rational fit to the ACES reference transform of K. Narkowicz (2015).
use super::Tone;
use noisefall_base::declare::Word;

pub(super) struct Aces;

impl Tone for Aces {
    const WORD: Word =
        Word { name: "aces", title: "ACES-like", doc: "A filmic curve with contrast in the mid-tones and soft highlights." };

    #[inline(always)]
    fn map(radiance: [f32; 3]) -> [f32; 3] {
        radiance.map(|c| c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14))
    }
}
