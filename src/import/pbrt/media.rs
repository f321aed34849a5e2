//! Participating media, which are not rendered.
use super::{import::Import, parameters::Entity, source::TextSpan, spectra::Role};
use crate::scene::SceneError;

impl Import {
    /// An error if a medium is not empty space.
    pub fn refuse_medium(&mut self, name: &str, place: &TextSpan) -> Result<(), SceneError> {
        if name.is_empty() {
            return Ok(());
        }
        if let Some(medium) = self.media.get(name).cloned()
            && self.is_clear(&medium)?
        {
            return Ok(());
        }
        let message = format!("the participating medium `{name}` is not rendered");
        Err(place.error(message, "it lies in the medium").with_help("remove its MediumInterface to render the scene without it"))
    }

    /// Whether a medium neither absorbs, scatters nor emits light.
    fn is_clear(&mut self, medium: &Entity) -> Result<bool, SceneError> {
        if medium.find(&[super::parameters::Type::String], "type").and_then(|t| t.text()) != Some("homogeneous")
            || medium.has("Le")
        {
            return Ok(false);
        }
        if medium.float("scale", 1.0)? == 0.0 {
            return Ok(true);
        }
        let [absorbs, scatters] = [
            self.constant_colour(medium, "sigma_a", Role::Unbounded)?,
            self.constant_colour(medium, "sigma_s", Role::Unbounded)?,
        ];
        Ok(absorbs == Some([0.0; 3]) && scatters == Some([0.0; 3]))
    }
}
