//! Emitters: one file per family.
pub mod area;
mod dark;
mod distorted;
mod environment;
mod punctual_lights;
mod sun;

use super::{context::Import, tree::Element};
use noisefall_scene::scene::SceneError;

/// Whether an emitter belongs to the shapes that hold it or refer to it.
pub fn is_of_shapes(element: Element) -> bool {
    matches!(element.kind(), "area" | "directionalarea")
}

impl Import {
    /// Adds an emitter that belongs to no shape.
    pub fn emitter(&mut self, element: Element) -> Result<(), SceneError> {
        element.ignore(&["sampling_weight"]);
        match element.kind() {
            "point" => punctual_lights::point(self, element),
            "spot" => punctual_lights::spot(self, element),
            "directional" => punctual_lights::directional(self, element),
            "projector" => punctual_lights::projector(self, element),
            "constant" => environment::constant(self, element),
            "envmap" => environment::image(self, element),
            "sunsky" | "sun" | "sky" => environment::sky(self, element),
            _ => {
                self.remark(element, "nothing", "its light is missing");
                element.children().for_each(|child| {
                    child.see();
                });
                Ok(())
            }
        }
    }
}
