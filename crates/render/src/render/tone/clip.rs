//! No tone map: radiance as it is.
use super::Tone;
use noisefall_base::declare::Word;

pub(super) struct None;

impl Tone for None {
    const WORD: Word = Word { name: "none", title: "None (sRGB)", doc: "No tone mapping; values above 1 are clipped." };

    #[inline(always)]
    fn map(radiance: [f32; 3]) -> [f32; 3] {
        radiance
    }
}
