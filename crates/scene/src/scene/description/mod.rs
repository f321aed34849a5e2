//! Scene descriptions: every table of the scene format with its parameters.
//!
//! A description is read from a scene file or built in code. [`SceneDescription::build`] checks it as the reader does, and compiles it.
//!
//! The kinds of materials, shapes and textures are in [`crate::material`], [`crate::shape`] and [`crate::texture`]. The other types of
//! the fields are re-exported here.
mod camera;
mod light;
mod material;
mod object;
mod places;
mod presentation;
mod punctual_light;
mod render;

use std::collections::BTreeMap;

pub use glam::DVec3;

pub(super) use self::material::OPACITY;
pub use self::{
    camera::CameraDescription,
    light::{EmissionDescription, ReferenceDescription},
    material::{Bump, MaterialDescription},
    object::ObjectDescription,
    places::parameter_name,
    presentation::Presentation,
    punctual_light::PunctualLightDescription,
    render::RenderDescription,
};
pub use crate::{
    light::{emission::EmissionSource, environment::EnvironmentDescription},
    material::Material,
    sampling::Filter,
    scene::{Lens, Projection, RenderSettings},
    shape::{ShapeKind, Transform},
    texture::TextureKind,
};
pub use noisefall_base::declare::Textured;
use noisefall_base::declare::{CountRange, Declare, Parameter, Parameters};

/// A scene as described by a file or built in code.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneDescription {
    /// Title in the window and in reports.
    pub title: String,
    /// Notes about the scene.
    pub notes: String,
    /// The camera that the scene opens with.
    pub camera: CameraDescription,
    /// Radiance of rays that meet no surface; `None` is black.
    pub environment: Option<EnvironmentDescription>,
    /// Textures by name.
    pub textures: BTreeMap<String, TextureKind>,
    /// Materials by name.
    pub materials: BTreeMap<String, MaterialDescription>,
    /// The objects, in any order.
    pub objects: Vec<ObjectDescription>,
    /// Punctual lights.
    pub punctual_lights: Vec<PunctualLightDescription>,
    /// The settings that the scene opens with.
    pub render: RenderDescription,
    /// The reference that the image must converge to, if it is known.
    pub reference: Option<ReferenceDescription>,
}

/// The version of the scene format that this program reads.
pub const FORMAT: u32 = 1;

impl Declare for SceneDescription {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const VERSION: Parameter = Parameter::new("format", "The version of the format: 1.").required();
        const CAMERA: Parameter =
            Parameter::new("camera", "Position, direction and lens of the camera.").required().aliases("sensor view");
        const ENVIRONMENT: Parameter =
            Parameter::new("environment", "Radiance of rays that meet no surface.").aliases("sky envmap world");
        const TEXTURES: Parameter = Parameter::new("textures", "Textures by name.").aliases("texture");
        const MATERIALS: Parameter = Parameter::new("materials", "Materials by name.").aliases("material bsdfs");
        const OBJECTS: Parameter =
            Parameter::new("objects", "The objects of the scene, one table each.").aliases("object shapes");
        const LIGHTS: Parameter = Parameter::new("lights", "Punctual lights, one table each.").aliases("light emitters");
        p.count(&VERSION, &mut FORMAT.clone(), CountRange::new(FORMAT, FORMAT));
        presentation::texts(p, &mut self.title, &mut self.notes);
        p.table(&CAMERA, &mut self.camera);
        p.optional_table(&ENVIRONMENT, &mut self.environment);
        p.map(&TEXTURES, &mut self.textures);
        p.map(&MATERIALS, &mut self.materials);
        p.list(&OBJECTS, &mut self.objects);
        p.list(&LIGHTS, &mut self.punctual_lights);
        presentation::settings_and_reference(p, &mut self.render, &mut self.reference);
    }
}
