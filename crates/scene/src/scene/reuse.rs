//! Sharing between neighbouring pixels: the setting, and the sharing in force.
use serde::{Deserialize, Serialize};

noisefall_base::declare::words! {
    /// The sharing that is asked for.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
    #[serde(rename_all = "lowercase")]
    pub enum Reuse {
        /// The integrator itself treats it as [`Reuse::Off`].
        #[default]
        Auto: "auto", "Auto", "Shares what a short trial of the scene finds most efficient. The trial runs once per scene.";
        /// Bekaert, Sbert and Halton 2002.
        On: "on", "Paths", "Reuses each path in a 4 × 4 block of pixels, weighted by multiple importance sampling.";
        Bright: "bright", "Bright samples", "Replays bright samples, such as those of caustics, in a 4 × 4 block of pixels, weighted by multiple importance sampling.";
        Both: "both", "Both", "Reuses each path, and replays samples that are bright without the reused light.";
        Off: "off", "Nothing", "Every pixel uses only its own paths, so the noise of neighbouring pixels is independent.";
    }
}

/// Sharing between neighbouring pixels in a render. Written as `false`, `true`, `bright`, `both` and `merged` in tables, and as a number
/// in files of renders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Sharing {
    /// Nothing: the noise of each pixel is independent.
    #[default]
    #[serde(rename = "false")]
    Nothing = 0,
    /// Path suffixes.
    #[serde(rename = "true")]
    Suffixes = 1,
    /// Bright samples.
    #[serde(rename = "bright")]
    BrightSamples = 2,
    /// Path suffixes, and what is bright in the rest of a sample.
    #[serde(rename = "both")]
    Both = 3,
    /// Paths from lights: their vertices are merged with those of the paths of the pixels.
    #[serde(rename = "merged")]
    Merged = 4,
}

impl Sharing {
    /// All kinds of sharing.
    pub const ALL: [Sharing; 5] = [Sharing::Nothing, Sharing::Suffixes, Sharing::BrightSamples, Sharing::Both, Sharing::Merged];

    /// Its name in legends and tables.
    pub fn name(self) -> &'static str {
        match self {
            Sharing::Nothing => "no sharing",
            Sharing::Suffixes => "shared paths",
            Sharing::BrightSamples => "shared bright samples",
            Sharing::Both => "shared paths and bright samples",
            Sharing::Merged => "merged vertices",
        }
    }

    /// The sharing that a setting asks for; nothing if that is undecided.
    pub fn asked(reuse: Reuse) -> Sharing {
        match reuse {
            Reuse::On => Sharing::Suffixes,
            Reuse::Bright => Sharing::BrightSamples,
            Reuse::Both => Sharing::Both,
            Reuse::Auto | Reuse::Off => Sharing::Nothing,
        }
    }

    /// The setting of path reuse with it.
    pub fn reuse(self) -> Reuse {
        match self {
            Sharing::Nothing | Sharing::Merged => Reuse::Off,
            Sharing::Suffixes => Reuse::On,
            Sharing::BrightSamples => Reuse::Bright,
            Sharing::Both => Reuse::Both,
        }
    }

    /// Whether path suffixes are shared.
    pub fn has_suffixes(self) -> bool {
        matches!(self, Sharing::Suffixes | Sharing::Both)
    }

    /// Whether bright samples are shared.
    pub fn has_bright_samples(self) -> bool {
        matches!(self, Sharing::BrightSamples | Sharing::Both)
    }

    /// Whether the noise of neighbouring pixels is correlated.
    pub fn correlates(self) -> bool {
        self != Sharing::Nothing
    }
}
