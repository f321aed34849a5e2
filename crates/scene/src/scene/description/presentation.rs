//! The parameters of a scene besides its camera and its contents.
use super::{ReferenceDescription, RenderDescription, SceneDescription};
use noisefall_base::declare::{Declare, Parameter, Parameters, Value};

/// Title, notes, settings and reference of a scene. Their paths are those in the whole description.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Presentation {
    /// Title in the window and in reports.
    pub title: String,
    /// Notes about the scene.
    pub notes: String,
    /// The settings that the scene opens with.
    pub render: RenderDescription,
    /// The reference that the image must converge to, if it is known.
    pub reference: Option<ReferenceDescription>,
}

impl Presentation {
    /// Copies it from a description.
    pub fn of(description: &SceneDescription) -> Presentation {
        let SceneDescription { title, notes, render, reference, .. } = description;
        Presentation { title: title.clone(), notes: notes.clone(), render: render.clone(), reference: reference.clone() }
    }
}

impl Declare for Presentation {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        texts(p, &mut self.title, &mut self.notes);
        settings_and_reference(p, &mut self.render, &mut self.reference);
    }
}

pub(super) fn texts(p: &mut dyn Parameters, title: &mut String, notes: &mut String) {
    const TITLE: Parameter = Parameter::new("title", "Name of the scene in the window and in reports.").aliases("name");
    const NOTES: Parameter = Parameter::new("notes", "Notes about the scene.").aliases("description comment");
    p.value(&TITLE, Value::Text(title));
    p.value(&NOTES, Value::Text(notes));
}

pub(super) fn settings_and_reference(
    p: &mut dyn Parameters,
    render: &mut RenderDescription,
    reference: &mut Option<ReferenceDescription>,
) {
    const RENDER: Parameter = Parameter::new("render", "The settings that the scene opens with.").aliases("integrator settings");
    const REFERENCE: Parameter =
        Parameter::new("reference", "Image or radiance that the render must converge to, if it is known.")
            .title("Reference")
            .aliases("reference");
    p.optional_part(&RENDER, render);
    p.optional_table(&REFERENCE, reference);
}
