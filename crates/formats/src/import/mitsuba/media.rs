//! Participating media. Those that absorb without scattering can fill glass.
use super::{colours::Role, context::Import, tree::Element, unread};
use crate::import::absorbing::{Filling, INTERFACE};
use noisefall_scene::scene::SceneError;

/// Integrators that render surfaces alone, as if there were no media.
const BLIND: [&str; 9] =
    ["path", "direct", "direct_projective", "ptracer", "prb", "prb_basic", "prb_projective", "irrcache", "ao"];

/// Whether an integrator renders media.
pub fn are_seen_by(integrator: &str) -> bool {
    !BLIND.contains(&integrator)
}

impl Import {
    /// Adds the remarks about media that lie outside of shapes and inside of none.
    pub fn remark_open_media(&mut self) {
        self.remarks.extend(self.media.absorbers.remarks_of_open());
    }

    /// The material of a shape, with the medium that the shape holds.
    pub fn holding(&mut self, shape: Element, mut surface: String) -> Result<String, SceneError> {
        for (role, medium) in shape.objects(&["medium"])? {
            let Some(absorption) = self.absorption(medium)? else { continue };
            let key = medium.index.to_string();
            if role != "interior" {
                if absorption != [0.0; 3] {
                    self.media.absorbers.note_outside(&key, medium.place(), medium.shown());
                }
                continue;
            }
            let scene = (&mut self.description, &mut self.materials);
            let (filled, filling) = self.media.absorbers.hold(scene, surface, (&key, absorption));
            match filling {
                Filling::Exact => {}
                Filling::Interface => self.remark(shape, "an interface of index 1 around its medium", INTERFACE),
                Filling::Refused => {
                    let message = format!("a medium within the material `{filled}`, which holds none");
                    return Err(shape.error(message, "use a `dielectric`, or remove the medium"));
                }
            }
            surface = filled;
        }
        Ok(surface)
    }

    /// Refuses the media of an element that are not empty, such as those around a camera.
    pub fn refuse_media(&mut self, element: Element) -> Result<(), SceneError> {
        for (_, medium) in element.objects(&["medium"])? {
            if self.absorption(medium)?.is_some_and(|absorption| absorption != [0.0; 3]) {
                return Err(medium.error("a medium around the camera, which Noisefall does not render", "remove the medium"));
            }
        }
        Ok(())
    }

    /// The fraction of light that a medium absorbs per metre, per channel; `None` if the integrator does not render media. A medium
    /// that scatters is an error.
    fn absorption(&mut self, medium: Element) -> Result<Option<[f64; 3]>, SceneError> {
        if self.media.are_unseen {
            self.remark(medium, "empty space", "none: the integrator of the scene does not render media");
            unread::skip(medium);
            return Ok(None);
        }
        let refused = || {
            medium.error(
                "the scene contains a participating medium, which Noisefall does not render",
                "remove the medium; one that only absorbs can fill glass",
            )
        };
        if !matches!(medium.kind(), "homogeneous" | "heterogeneous") || medium.has("material") || medium.has("emission") {
            return Err(refused());
        }
        medium.objects(&["phase"])?.iter().for_each(|(_, phase)| unread::skip(*phase));
        medium.ignore(&["sample_emitters", "has_spectral_extinction", "majorant_grid", "method"]);
        let scale = medium.number("scale", 1.0)?;
        let mut number = |name: &str, default: f64| -> Result<[f64; 3], SceneError> {
            let Some(mut value) = medium.property(name)? else { return Ok([default; 3]) };
            if value.kind() == "constvolume" {
                value = value.property("value")?.ok_or_else(refused)?;
            }
            self.constant(value, Role::Index)?.ok_or_else(refused)
        };
        // Version 0.6 also knows the two parts of extinction.
        let parts = medium.has("sigma_a") || medium.has("sigma_s");
        let [absorbed, scattered] = if parts {
            [number("sigma_a", 0.0)?, number("sigma_s", 0.0)?]
        } else {
            let [extinction, albedo] = [number("sigma_t", 1.0)?, number("albedo", 0.75)?];
            let part = |share: fn(f64) -> f64| [0, 1, 2].map(|channel| extinction[channel] * share(albedo[channel]));
            [part(|albedo| 1.0 - albedo), part(|albedo| albedo)]
        };
        if scattered.iter().any(|scattered| scattered * scale != 0.0) {
            return Err(refused());
        }
        Ok(Some(absorbed.map(|x| (x * scale).clamp(0.0, 1e6))))
    }
}
