//! Objects of a scene file.
use super::EmissionDescription;
use crate::shape::{ShapeKind, Transform};
use noisefall_base::declare::{Declare, Family, Form, Parameter, Parameters, Value};

/// An object of a scene file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObjectDescription {
    /// Name in the window; may be empty.
    pub name: String,
    /// The surface.
    pub shape: ShapeKind,
    /// The name of the material; `None` is black.
    pub material: Option<String>,
    /// The emission, if the object emits.
    pub emission: Option<EmissionDescription>,
    /// Whether the normal is reversed.
    pub flip: bool,
    /// Transforms of the shape, from the first to the last.
    pub transform: Vec<Transform>,
    /// Transforms that move the object from time 0 to 1.
    pub motion: Vec<Transform>,
}

impl Declare for ObjectDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const NAME: Parameter = Parameter::new("name", "Name in the window.").aliases("id label");
        const SHAPE: Parameter = Parameter::new("shape", "Shape of the object.").required().aliases("geometry");
        const MATERIAL: Parameter = Parameter::new("material", "Name of the material. Default: black.").aliases("bsdf");
        const EMISSION: Parameter =
            Parameter::new("emission", "Light that the surface emits.").aliases("light emitter emissive area_light");
        const FLIP: Parameter = Parameter::new("flip", "Whether to reverse the normal.").aliases("flip_normals invert");
        const TRANSFORM: Parameter =
            Parameter::new("transform", "Transforms, applied from the first to the last.").aliases("to_world transforms");
        const MOTION: Parameter = Parameter::new("motion", "Transforms that move the object from time 0 to 1.");
        p.value(&NAME, Value::Text(&mut self.name));
        p.choice(&SHAPE, Form::Table, &mut self.shape);
        p.optional(&MATERIAL, &mut self.material, String::new, |p, name| {
            p.value(&MATERIAL, Value::Name(name, Family::Material));
        });
        p.optional_table(&EMISSION, &mut self.emission);
        p.flag(&FLIP, &mut self.flip);
        p.list(&TRANSFORM, &mut self.transform);
        p.list(&MOTION, &mut self.motion);
    }
}
