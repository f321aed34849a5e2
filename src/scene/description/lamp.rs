//! Lamps of a scene file.
use crate::{
    declare::{Declare, Parameter, Parameters, Value},
    light::lamp::{LampKind, kinds::Projector},
    shape::{Transform, product},
};

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
    /// The lamp with white in place of the image that it casts, so that it can be checked without reading files.
    pub fn without_files(&self) -> LampDescription {
        let kind = match &self.kind {
            LampKind::Projector(projector) => Projector { image: String::new(), ..projector.clone() }.into(),
            other => other.clone(),
        };
        LampDescription { kind, ..self.clone() }
    }
}

impl LampDescription {
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
