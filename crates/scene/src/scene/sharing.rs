//! Decides which sharing between pixels a scene allows.
use super::{CameraRays, RenderSettings, Reuse, Scene, Sharing};

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
