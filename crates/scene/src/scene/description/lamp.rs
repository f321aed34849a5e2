//! Lamps of a scene file.
use crate::{
    light::lamp::LampKind,
    shape::{Transform, product},
};
use noisefall_base::declare::{Declare, Parameter, Parameters, Value};

/// A lamp without surface of a scene file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LampDescription {
    /// Name in the window; may be empty.
    pub name: String,
    /// The lamp.
    pub kind: LampKind,
    /// Transforms of the lamp, from the first to the last.
    pub transform: Vec<Transform>,
}

impl LampDescription {
    /// The lamp without its files, so that it can be checked without reading files.
    pub fn without_files(&self) -> LampDescription {
        let kind = self.kind.kind().without_files().unwrap_or_else(|| self.kind.clone());
        LampDescription { kind, ..self.clone() }
    }

    /// Where the lamp stands after its transforms, metres; `None` if it is infinitely far away.
    pub fn position(&self) -> Option<glam::DVec3> {
        Some(product(&self.transform).ok()?.transform_point3(self.kind.kind().position()?))
    }
}

impl Declare for LampDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const NAME: Parameter = Parameter::new("name", "Name in the window.").aliases("id label");
        const TRANSFORM: Parameter =
            Parameter::new("transform", "Transforms, applied from the first to the last.").aliases("to_world transforms");
        p.value(&NAME, Value::Text(&mut self.name));
        p.one_of(&mut self.kind);
        p.list(&TRANSFORM, &mut self.transform);
    }
}
