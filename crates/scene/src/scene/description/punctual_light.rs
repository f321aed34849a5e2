//! Lights of a scene file.
use crate::{
    light::punctual_light::PunctualLightKind,
    shape::{Transform, product},
};
use noisefall_base::declare::{Declare, Parameter, Parameters, Value};

/// A punctual light of a scene file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PunctualLightDescription {
    /// Name in the window; may be empty.
    pub name: String,
    /// The light.
    pub kind: PunctualLightKind,
    /// Transforms of the light, from the first to the last.
    pub transform: Vec<Transform>,
}

impl PunctualLightDescription {
    /// The light without its files, so that it can be checked without reading files.
    pub fn without_files(&self) -> PunctualLightDescription {
        let kind = self.kind.kind().without_files().unwrap_or_else(|| self.kind.clone());
        PunctualLightDescription { kind, ..self.clone() }
    }

    /// Where the light stands after its transforms, metres; `None` if it is infinitely far away.
    pub fn position(&self) -> Option<glam::DVec3> {
        Some(product(&self.transform).ok()?.transform_point3(self.kind.kind().position()?))
    }
}

impl Declare for PunctualLightDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const NAME: Parameter = Parameter::new("name", "Name in the window.").aliases("id label");
        const TRANSFORM: Parameter =
            Parameter::new("transform", "Transforms, applied from the first to the last.").aliases("to_world transforms");
        p.value(&NAME, Value::Text(&mut self.name));
        p.one_of(&mut self.kind);
        p.list(&TRANSFORM, &mut self.transform);
    }
}
