//! The scene: what a file says, checked and compiled to what the renderer runs on.
mod camera;
mod check;
mod colour;
mod compile;
mod desc;
mod diagnostic;
mod load;
mod rays;
mod settings;
pub mod surface;
mod textures;

use std::path::PathBuf;

use glam::DVec3;

use self::surface::Stage;
pub use self::{
    camera::{Camera, CameraError, Lens},
    diagnostic::SceneError,
    load::{BUILT_IN, built_in, load, parse},
    rays::CameraRays,
    settings::{Estimator, RenderSettings, Roulette},
};
use crate::{
    geometry::Shapes,
    light::{Emission, Lights},
    material::{Material, Materials},
    texture::Textures,
};

/// A compiled scene. Immutable; shared between threads.
pub struct Scene {
    pub title: String,
    /// The text of the scene file.
    pub source: String,
    pub notes: String,
    pub shapes: Shapes,
    pub materials: Materials,
    /// Colour of every primitive, and its surface in one word: see [`surface`]. A black one reflects nothing.
    pub surfaces: Vec<[f32; 4]>,
    /// What else is looked up of a primitive: roughness α.
    pub varying: Vec<[f32; 4]>,
    /// The shading stages that the scene needs.
    pub stages: Vec<Stage>,
    pub textures: Textures,
    pub lights: Lights,
    /// The objects in the order of their primitive ids.
    pub objects: Vec<Object>,
    /// The extent of the scene in metres, as a person walking through it would say it.
    pub size: f64,
    /// What the scene opens with.
    pub camera: Camera,
    pub settings: RenderSettings,
    pub spp: Option<u32>,
    pub truth: Option<Truth>,
}

/// One object as the file describes it.
#[derive(Clone, Debug)]
pub struct Object {
    pub name: String,
    pub center: DVec3,
    pub radius: f64,
    /// `None` is black.
    pub material: Option<Material>,
    pub emission: Option<Emission>,
}

/// What the picture must converge to.
#[derive(Clone, Debug, PartialEq)]
pub enum Truth {
    /// The same exact radiance at every pixel.
    Radiance([f32; 3]),
    /// A reference image.
    Image(PathBuf),
}

impl Scene {
    /// Whether all surfaces are diffuse and nothing about them varies.
    pub fn is_plain(&self) -> bool {
        self.stages == [Stage::Plain]
    }

    /// Things that are legal but probably not meant, for the window and the command line.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        if self.lights.is_empty() {
            warnings.push("nothing in this scene emits light: the picture will be black".to_owned());
        }
        if self.objects.is_empty() {
            warnings.push("this scene has no objects".to_owned());
        }
        warnings
    }
}
