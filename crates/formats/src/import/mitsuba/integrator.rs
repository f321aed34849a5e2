//! Settings of the estimate.
use super::{context::Import, media, tree::Element, unread};
use noisefall_scene::scene::{Estimator, Roulette, SceneError};

/// Our estimator of what an integrator computes, and whether it merges vertices; `None` if the integrator computes something else.
fn estimator(kind: &str) -> Option<(Estimator, bool)> {
    Some(match kind {
        "direct" | "direct_projective" | "path" | "ptracer" | "volpath" | "volpath_simple" | "volpathmis" | "prb"
        | "prb_basic" | "prbvolpath" | "prb_projective" => (Estimator::Mis, false),
        // Bidirectional paths, Metropolis's among them, and virtual lights.
        "bdpt" | "mlt" | "pssmlt" | "erpt" | "vpl" => (Estimator::Bidirectional, false),
        // Density estimation.
        "photonmapper" | "ppm" | "sppm" | "vcm" | "upm" => (Estimator::Bidirectional, true),
        _ => return None,
    })
}

impl Import {
    /// Takes over the depth of paths.
    pub fn integrator(&mut self, element: Element) -> Result<(), SceneError> {
        element.ignore(&[
            "emitter_samples",
            "bsdf_samples",
            "shading_samples",
            "samples_per_pass",
            "sample_count",
            "block_size",
            "timeout",
            "strict_normals",
            "aovs",
        ]);
        if let Some((_, inner)) = element.objects(&["integrator"])?.first() {
            return self.nested(element, |import| import.integrator(*inner));
        }
        if element.flag("hide_emitters", false)? {
            self.remark_value(element, "hide_emitters", "visible lights", "the camera sees emitters and the environment")?;
        }
        let known = estimator(element.kind());
        if known.is_none() {
            self.remark(element, "path tracing", "the image shows radiance, not what this integrator computes");
        }
        let (estimator, merging) = known.unwrap_or((Estimator::Mis, false));
        let depth = match element.kind() {
            // One reflection: Mitsuba counts the edges of a path and we count its bounces.
            "direct" | "direct_projective" => Some(2),
            _ => self.depth(element)?,
        };
        self.media.are_unseen = !media::are_seen_by(element.kind());
        if depth == Some(0) {
            self.remark_value(element, "max_depth", "1", "emitters are visible")?;
        }
        self.description.render.settings.max_bounces = depth.map(|depth| depth.saturating_sub(1));
        let bidirectional = estimator.connects();
        // The volumetric ones do not count the passage through masks, and our bidirectional paths cannot.
        let counts = depth.is_some() && !bidirectional && !element.kind().contains("vol");
        self.description.render.settings.count_crossings = counts;
        self.description.render.settings.estimator = estimator;
        self.description.render.settings.merging = merging;
        if let Some(start) = element.integer("rr_depth")? {
            let start = u32::try_from(start).unwrap_or(0).min(1 << 16);
            self.description.render.settings.roulette = Roulette::by_throughput_from(start);
        }
        if bidirectional {
            // Numbers of photons, radii and mutations: how, not what.
            unread::skip(element);
        }
        Ok(())
    }

    /// Edges of the longest path; `None` is no limit.
    fn depth(&mut self, element: Element) -> Result<Option<u32>, SceneError> {
        let depth = element.integer("max_depth")?.unwrap_or(-1);
        Ok(u32::try_from(depth).ok())
    }
}
