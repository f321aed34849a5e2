//! What neighbouring pixels share.
use serde::{Deserialize, Serialize};

use super::{CameraRays, RenderSettings, Reuse, Scene};

/// What neighbouring pixels share in a render. Written as `false`, `true`, `bright`, `both` and `merged` in tables, and as a number
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

    /// What a setting asks for; nothing if that is undecided.
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

impl RenderSettings {
    /// [`RenderSettings::bias`] where it is known what pixels share: settings may ask for merging where a scene does not allow it.
    pub fn bias_with(&self, sharing: Sharing) -> Option<String> {
        RenderSettings { merging: sharing == Sharing::Merged, ..*self }.bias()
    }
}

impl Scene {
    /// What pixels share with these settings. [`Reuse::Auto`] is still undecided and counts as nothing.
    pub fn sharing(&self, rays: &CameraRays, settings: &RenderSettings) -> Sharing {
        if self.merges(settings) {
            return Sharing::Merged;
        }
        let asked = Sharing::asked(settings.reuse);
        let [suffixes, bright] = [
            asked.has_suffixes() && self.can_share(rays, settings),
            asked.has_bright_samples() && self.can_share_bright(settings),
        ];
        match (suffixes, bright) {
            (false, false) => Sharing::Nothing,
            (true, false) => Sharing::Suffixes,
            (false, true) => Sharing::BrightSamples,
            (true, true) => Sharing::Both,
        }
    }

    /// All that pixels could share with these settings. Nothing is the first, unless vertices are merged.
    pub fn possible_sharing(&self, rays: &CameraRays, settings: &RenderSettings) -> Vec<Sharing> {
        let possible = |reuse| self.sharing(rays, &RenderSettings { reuse, ..*settings });
        let mut all: Vec<Sharing> = [Reuse::Off, Reuse::On, Reuse::Bright, Reuse::Both].map(possible).into();
        all.dedup();
        all
    }

    /// Whether pixels can share bright samples: not with paths from lights, which bring light to any pixel.
    fn can_share_bright(&self, settings: &RenderSettings) -> bool {
        !self.traces_light_paths(settings)
    }
}
