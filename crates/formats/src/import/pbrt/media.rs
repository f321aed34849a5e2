//! Participating media. Those that absorb without scattering can fill glass; others are not rendered.
use std::rc::Rc;

use super::{
    import::Import,
    parameters::{Entity, Type},
    records::Absorber,
    source::TextSpan,
    spectra::Role,
};
use crate::import::absorbing::{Filling, INTERFACE};
use noisefall_scene::scene::SceneError;

/// The absorption of a homogeneous medium that states none.
const ABSORPTION: [f64; 3] = [0.0011, 0.0024, 0.014];
/// The help of errors about media.
const HELP: &str = "remove its MediumInterface to render the scene without it";

impl Import {
    /// `MakeNamedMedium`.
    pub fn declare_medium(&mut self, medium: Rc<Entity>) -> Result<(), SceneError> {
        if self.absorption(&medium)?.is_none() {
            self.remark(&medium, "nothing", "surfaces in a medium that scatters or emits light are refused");
        }
        self.media.insert(medium.kind.clone(), medium);
        Ok(())
    }

    /// The medium of a name; `None` is empty space. One that scatters or emits light is an error.
    pub fn absorber(&mut self, name: &Rc<str>, place: &TextSpan) -> Result<Option<Absorber>, SceneError> {
        if name.is_empty() {
            return Ok(None);
        }
        if let Some(medium) = self.media.get(&**name).cloned()
            && let Some(absorption) = self.absorption(&medium)?
        {
            return Ok((absorption != [0.0; 3]).then(|| Absorber { name: name.clone(), absorption }));
        }
        Err(place.error(format!("the participating medium `{name}` is not rendered"), "it lies in the medium").with_help(HELP))
    }

    /// An error if the medium around the camera is not empty space.
    pub fn refuse_medium(&mut self, name: &Rc<str>, place: &TextSpan) -> Result<(), SceneError> {
        match self.absorber(name, place)? {
            Some(_) => {
                let message = format!("the medium `{name}` is rendered within surfaces only");
                Err(place.error(message, "the camera lies in it").with_help(HELP))
            }
            None => Ok(()),
        }
    }

    /// The absorption of a medium; `None` if it also scatters or emits light.
    fn absorption(&mut self, medium: &Entity) -> Result<Option<[f64; 3]>, SceneError> {
        let is_homogeneous = medium.find(&[Type::String], "type").and_then(|t| t.text()) == Some("homogeneous");
        if !is_homogeneous || medium.has("Le") {
            return Ok(None);
        }
        let scale = medium.float("scale", 1.0)?;
        if scale == 0.0 {
            return Ok(Some([0.0; 3]));
        }
        let scatters = self.constant_colour(medium, "sigma_s", Role::Unbounded)?;
        if medium.has("preset") || scatters != Some([0.0; 3]) {
            return Ok(None);
        }
        let absorbs = self.constant_colour(medium, "sigma_a", Role::Unbounded)?.unwrap_or(ABSORPTION);
        Ok(Some(absorbs.map(|x| (x * scale).clamp(0.0, 1e6))))
    }

    /// The material with a medium inside of its surface.
    pub fn holding(&mut self, surface: String, medium: &Option<Absorber>, place: &TextSpan) -> Result<String, SceneError> {
        let Some(Absorber { name, absorption }) = medium else { return Ok(surface) };
        let scene = (&mut self.description, &mut self.material_names);
        let (filled, filling) = self.absorbers.hold(scene, surface, (name, *absorption));
        match filling {
            Filling::Exact => {}
            Filling::Interface => {
                self.remarks.add(place.to_string(), "an interface around a medium", "a dielectric of index 1", INTERFACE);
            }
            Filling::Refused => {
                let message = format!("a medium within the material `{filled}`, which holds none");
                return Err(place.error(message, "use a dielectric, or remove the medium").with_help(HELP));
            }
        }
        Ok(filled)
    }

    /// Notes the medium outside of a shape, which is right if a surface around the shape holds it.
    pub fn note_outside(&mut self, medium: &Option<Absorber>, place: &TextSpan) {
        if let Some(Absorber { name, .. }) = medium {
            self.absorbers.note_outside(name, place.to_string(), format!("the medium `{name}`"));
        }
    }
}
