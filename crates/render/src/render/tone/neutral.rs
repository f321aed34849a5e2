//! Khronos PBR Neutral (Khronos Group 2024, "PBR Neutral Tone Mapper"): base colours under grey light keep their values.
use super::Tone;
use noisefall_base::declare::Word;

pub(super) struct Neutral;

/// The reflectance of a dielectric at normal incidence, which is subtracted; `F90` in the source.
const F0: f32 = 0.04;
/// The offset x − x²/(4 F0) of a small channel x reaches F0 at 2 F0, with slope 0.
const CURVATURE: f32 = 1.0 / (4.0 * F0);
/// Peak of the channels, after the subtraction, above which they are compressed.
const START: f32 = 0.8 - F0;
/// How fast compressed colours fade to white.
const DESATURATION: f32 = 0.15;

impl Tone for Neutral {
    const WORD: Word = Word {
        name: "neutral",
        title: "Khronos PBR Neutral",
        doc: "Keeps colours below 0.8 and compresses only highlights. Made for product images.",
    };

    #[inline(always)]
    fn map(radiance: [f32; 3]) -> [f32; 3] {
        let least = radiance[0].min(radiance[1]).min(radiance[2]);
        let offset = if least < 2.0 * F0 { least - CURVATURE * least * least } else { F0 };
        let colour = radiance.map(|c| c - offset);
        let peak = colour[0].max(colour[1]).max(colour[2]);
        if peak < START {
            return colour;
        }
        let room = 1.0 - START;
        let compressed = 1.0 - room * room / (peak + room - START);
        let white = 1.0 - 1.0 / (DESATURATION * (peak - compressed) + 1.0);
        colour.map(|c| {
            let c = c * (compressed / peak);
            c + (compressed - c) * white
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn below_the_compression_only_the_offset_is_subtracted() {
        for colour in [[0.1, 0.5, 0.7], [0.79, 0.08, 0.3], [0.4, 0.4, 0.4]] {
            assert_eq!(Neutral::map(colour), colour.map(|c| c - 0.04));
        }
        // The offset vanishes with the smallest channel.
        assert_eq!(Neutral::map([0.0, 0.5, 0.7]), [0.0, 0.5, 0.7]);
        let [r, g, _] = Neutral::map([0.02, 0.5, 0.7]);
        assert!((r - 6.25 * 0.02 * 0.02).abs() < 1e-6 && (g - 0.4825).abs() < 1e-6, "{r} {g}");
    }

    #[test]
    fn above_it_the_peak_follows_the_formula_and_colours_fade() {
        let [grey, ..] = Neutral::map([2.0; 3]);
        assert!((grey - (1.0 - 0.24 * 0.24 / (1.96 + 0.24 - 0.76))).abs() < 1e-6, "{grey}");
        let [r, g, b] = Neutral::map([100.0, 1.0, 1.0]);
        assert!(r < 1.0 && g == b && g > 0.9, "{r} {g}");
    }

    #[test]
    fn the_curve_is_continuous_where_the_compression_starts() {
        let (below, above) = (Neutral::map([0.799_99; 3])[0], Neutral::map([0.800_01; 3])[0]);
        assert!((above - below).abs() < 1e-4 && above > below, "{below} {above}");
    }
}
