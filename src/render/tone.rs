//! Tone maps, from radiance, which has no upper bound, to display light in [0, 1].
use serde::Serialize;

use crate::math::colour::luminance;

/// Display settings, which do not affect the render.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Display {
    /// Exposure in stops: radiance is multiplied by 2 to this power.
    pub exposure: f32,
    pub tone_map: ToneMap,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum ToneMap {
    /// Clips at 1.
    #[default]
    None,
    /// c / (1 + Y), where Y is the luminance: Reinhard et al., "Photographic Tone Reproduction", SIGGRAPH 2002, equation 3.
    Reinhard,
    /// A filmic curve: the rational fit to the ACES reference transform of K. Narkowicz (2015).
    Aces,
    /// Luminance on a logarithmic scale of colours, six decades around 1.
    FalseColour,
}

impl ToneMap {
    /// The catalogue: tone map, name, and one sentence for the window.
    pub const ALL: [(ToneMap, &'static str, &'static str); 4] = [
        (ToneMap::None, "None (sRGB)", "Radiance as it is; what is brighter than the screen is cut off."),
        (
            ToneMap::Reinhard,
            "Reinhard",
            "Divides by one plus the luminance: no grey is cut off, only the strongest colours are; highlights are pale.",
        ),
        (ToneMap::Aces, "ACES-like", "A filmic curve: contrast in the middle, a soft shoulder."),
        (ToneMap::FalseColour, "False colour", "Luminance in colours, from 0.001 (violet) to 1000 (yellow), logarithmic."),
    ];

    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(map, _, _)| *map == self).map_or("", |(_, name, _)| name)
    }
}

/// Linear display light of linear radiance.
#[inline(always)]
pub(super) fn reinhard(rgb: [f32; 3]) -> [f32; 3] {
    let scale = 1.0 / (1.0 + luminance(rgb));
    rgb.map(|c| c * scale)
}

/// Linear display light of linear radiance, clipped at 1.
#[inline(always)]
pub(super) fn aces(rgb: [f32; 3]) -> [f32; 3] {
    rgb.map(|c| c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14))
}
