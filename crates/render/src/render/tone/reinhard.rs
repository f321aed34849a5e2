//! c / (1 + Y), Y the luminance: Reinhard et al., "Photographic Tone Reproduction", SIGGRAPH 2002, equation 3.
use super::Tone;
use noisefall_base::{declare::Word, math::colour::luminance};

pub(super) struct Reinhard;

impl Tone for Reinhard {
    const WORD: Word = Word {
        name: "reinhard",
        title: "Reinhard",
        doc: "Divides by one plus the luminance. Only saturated colours are clipped; highlights are pale.",
    };

    #[inline(always)]
    fn map(radiance: [f32; 3]) -> [f32; 3] {
        let scale = 1.0 / (1.0 + luminance(radiance));
        radiance.map(|c| c * scale)
    }
}
