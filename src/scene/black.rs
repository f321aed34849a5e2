//! Why a picture may be black.
use super::{Camera, Object, RenderSettings, Scene};

impl Scene {
    /// The innermost object that shuts the camera in: opaque, and with its front outwards, so that only its inside is seen.
    pub fn around(&self, camera: &Camera) -> Option<&Object> {
        let shuts_in = |object: &&Object| !object.flip && !object.is_dielectric() && object.shape.contains(camera.eye);
        let size = |object: &Object| object.shape.bounding_sphere().1;
        self.objects.iter().filter(shuts_in).min_by(|a, b| size(a).total_cmp(&size(b)))
    }

    /// The likeliest reason for a picture that is black so far.
    pub fn why_black(&self, camera: &Camera, settings: &RenderSettings) -> String {
        if self.lights.is_empty() {
            return "nothing in this scene emits light".to_owned();
        }
        if let Some(object) = self.around(camera) {
            let emits = object.emits_outwards_only();
            return format!(
                "the camera is inside {}",
                if emits { self.emitter_from_inside(object) } else { self.name_of(object) }
            );
        }
        match settings.max_bounces {
            Some(0) => "the cap of 0 bounces leaves only what emits, and the camera sees none of it".to_owned(),
            _ => "no path found light: it may be shut in, behind the camera, or too small to be found soon".to_owned(),
        }
    }
}
