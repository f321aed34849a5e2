//! The scene: what a file says, checked and compiled to what the renderer runs on.
mod black;
mod camera;
mod check;
mod colour;
mod compile;
mod desc;
mod diagnostic;
mod excerpt;
mod filter;
mod load;
mod rays;
mod roulette;
mod settings;
pub mod surface;
mod textures;
mod wording;

use std::{path::PathBuf, sync::Arc};

use glam::DVec3;

use self::surface::Surfaces;
pub use self::{
    camera::{Camera, CameraError, Lens},
    compile::{Coating, Roughness},
    diagnostic::SceneError,
    load::{BUILT_IN, built_in, load, parse},
    rays::CameraRays,
    settings::{Estimator, RenderSettings, Roulette},
    wording::nearest,
};
use crate::{
    geometry::Shapes,
    image::Picture,
    light::{Emission, Lights},
    material::Material,
    texture::Textures,
};

/// A compiled scene. Immutable; shared between threads.
pub struct Scene {
    pub title: String,
    /// The text of the scene file.
    pub source: String,
    pub notes: String,
    pub shapes: Shapes,
    pub surfaces: Surfaces,
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
    /// The normal points inwards.
    pub flip: bool,
    /// `None` is black.
    pub coating: Option<Coating>,
    pub emission: Option<Emission>,
}

/// What the picture must converge to.
#[derive(Clone, Debug, PartialEq)]
pub enum Truth {
    /// The same exact radiance at every pixel.
    Radiance([f32; 3]),
    /// A reference image, read from this file.
    Image(PathBuf, Arc<Picture>),
}

impl Scene {
    /// Whether all surfaces are diffuse, from both sides, and neither their colour nor what they emit varies.
    pub fn is_plain(&self) -> bool {
        self.surfaces.plain && !self.lights.emitters.vary()
    }

    /// The media around a point, as paths carry them: see [`surface::Surfaces::media`].
    fn media_at(&self, p: DVec3) -> u32 {
        if self.surfaces.media.is_empty() {
            return 0;
        }
        let inside = |(_, object): &(usize, &Object)| (p.distance(object.center) < object.radius) != object.flip;
        let is_dielectric = |coating: &Coating| matches!(coating.material, Material::Dielectric { .. });
        let mut around: Vec<_> = self.objects.iter().enumerate().filter(inside).collect();
        around.retain(|(_, object)| object.coating.as_ref().is_some_and(is_dielectric));
        around.sort_by(|a, b| b.1.radius.total_cmp(&a.1.radius));
        around.iter().fold(0, |stack, (id, _)| stack << 8 | self.surfaces.varying[*id][3].to_bits())
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
