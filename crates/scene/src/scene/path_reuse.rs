//! Decides which path reuse between pixels a scene allows.
use super::{CameraRays, PathReuse, RenderSettings, Reuse, Scene};

impl RenderSettings {
    /// [`RenderSettings::bias`] where it is known what pixels share: settings may ask for merging where a scene does not allow it.
    pub fn bias_with(&self, path_reuse: PathReuse) -> Option<String> {
        RenderSettings { merging: path_reuse == PathReuse::Merged, ..*self }.bias()
    }
}

impl Scene {
    /// The path reuse with these settings. [`Reuse::Auto`] is still undecided and counts as none.
    pub fn path_reuse(&self, rays: &CameraRays, settings: &RenderSettings) -> PathReuse {
        if self.merges(settings) {
            return PathReuse::Merged;
        }
        let asked = PathReuse::asked(settings.reuse);
        let [suffixes, bright] =
            [asked.has_suffixes() && self.can_share(rays, settings), asked.has_outliers() && self.can_share_bright(settings)];
        match (suffixes, bright) {
            (false, false) => PathReuse::Off,
            (true, false) => PathReuse::Suffixes,
            (false, true) => PathReuse::Outliers,
            (true, true) => PathReuse::Both,
        }
    }

    /// All that pixels could share with these settings. Nothing is the first, unless vertices are merged.
    pub fn possible_path_reuse(&self, rays: &CameraRays, settings: &RenderSettings) -> Vec<PathReuse> {
        let possible = |reuse| self.path_reuse(rays, &RenderSettings { reuse, ..*settings });
        let mut all: Vec<PathReuse> = [Reuse::Off, Reuse::Suffixes, Reuse::Outliers, Reuse::Both].map(possible).into();
        all.dedup();
        all
    }

    /// Whether pixels can reuse outliers: not with light paths, which bring light to any pixel.
    fn can_share_bright(&self, settings: &RenderSettings) -> bool {
        !self.traces_light_paths(settings)
    }
}
