//! Path reuse between neighbouring pixels: the setting, and the path reuse in force.
use serde::{Deserialize, Serialize};

noisefall_base::declare::words! {
    /// The path reuse that is asked for.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
    #[serde(rename_all = "lowercase")]
    pub enum Reuse {
        /// The integrator itself treats it as [`Reuse::Off`].
        #[default]
        Auto: "auto", "Auto", "Chooses the most efficient kind of path reuse in a short trial, once per scene.";
        /// Bekaert, Sbert and Halton 2002.
        Suffixes: "suffixes", "Suffixes", "Reuses each path in a 4 × 4 block of pixels, weighted by multiple importance sampling.";
        Outliers: "outliers", "Outliers", "Replays outliers, such as the samples of caustics, in a 4 × 4 block of pixels, weighted by multiple importance sampling.";
        Both: "both", "Both", "Reuses each path, and replays the outliers that remain.";
        Off: "off", "Off", "Every pixel uses only its own paths, so the noise of neighbouring pixels is independent.";
    }
}

/// Path reuse between neighbouring pixels in a render. Written as a word in tables, and as a number in checkpoints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PathReuse {
    /// None: the noise of each pixel is independent.
    #[default]
    Off = 0,
    /// Path suffixes.
    Suffixes = 1,
    /// Outliers.
    Outliers = 2,
    /// Path suffixes, and the outliers that remain.
    Both = 3,
    /// Vertices of light paths are merged with those of camera paths.
    Merged = 4,
}

impl PathReuse {
    /// All kinds of path reuse.
    pub const ALL: [PathReuse; 5] =
        [PathReuse::Off, PathReuse::Suffixes, PathReuse::Outliers, PathReuse::Both, PathReuse::Merged];

    /// Its name in tables and JSON, as serialised.
    pub fn name(self) -> &'static str {
        if self == PathReuse::Merged { "merged" } else { self.reuse().name() }
    }

    /// Its name in legends.
    pub fn words(self) -> &'static str {
        match self {
            PathReuse::Off => "no path reuse",
            PathReuse::Suffixes => "reused suffixes",
            PathReuse::Outliers => "reused outliers",
            PathReuse::Both => "reused suffixes and outliers",
            PathReuse::Merged => "merged vertices",
        }
    }

    /// The path reuse that a setting asks for; none if that is undecided.
    pub fn asked(reuse: Reuse) -> PathReuse {
        match reuse {
            Reuse::Suffixes => PathReuse::Suffixes,
            Reuse::Outliers => PathReuse::Outliers,
            Reuse::Both => PathReuse::Both,
            Reuse::Auto | Reuse::Off => PathReuse::Off,
        }
    }

    /// The setting of path reuse with it.
    pub fn reuse(self) -> Reuse {
        match self {
            PathReuse::Off | PathReuse::Merged => Reuse::Off,
            PathReuse::Suffixes => Reuse::Suffixes,
            PathReuse::Outliers => Reuse::Outliers,
            PathReuse::Both => Reuse::Both,
        }
    }

    /// Whether path suffixes are shared.
    pub fn has_suffixes(self) -> bool {
        matches!(self, PathReuse::Suffixes | PathReuse::Both)
    }

    /// Whether outliers are shared.
    pub fn has_outliers(self) -> bool {
        matches!(self, PathReuse::Outliers | PathReuse::Both)
    }

    /// Whether the noise of neighbouring pixels is correlated.
    pub fn correlates(self) -> bool {
        self != PathReuse::Off
    }
}
