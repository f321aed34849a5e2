//! The scene: scene files, checked and compiled to the renderer's data.
mod black;
mod build;
mod camera;
mod camera_path;
mod camera_sequence;
mod compile;
mod compile_report;
mod damage;
pub mod description;
mod diagnostic;
mod embedded;
mod estimator;
mod excerpt;
mod floor;
mod infinite_variance;
mod legend;
mod light_paths;
mod light_starts;
mod load;
mod locate;
mod material_instance;
mod media_walks;
mod nesting;
mod object;
mod parse;
mod path_reuse;
pub mod projection;
mod punctual_light;
mod rays;
mod read;
mod renamed;
mod reuse;
pub mod roulette;
mod same_image;
mod settings;
mod shipped;
mod shutter;
mod strategy;
pub mod surface;
mod syntax;
mod turntable;
mod unused;
mod used;
mod values;
mod warnings;
mod wording;

use std::{
    ops::Range,
    path::PathBuf,
    sync::{Arc, LazyLock, OnceLock},
};

use glam::DVec3;

pub use self::settings::InjectedFault;
use self::surface::Surfaces;
pub use self::{
    camera::{Camera, CameraError, Lens},
    camera_path::CameraPath,
    camera_sequence::CameraSequence,
    compile::{check_blend, check_camera, check_object, check_punctual},
    compile_report::CompileReport,
    diagnostic::{SceneError, SourceText},
    estimator::{Estimator, Obstacle, power_heuristic},
    legend::Legend,
    light_paths::EstimatorInForce,
    light_starts::LightStarts,
    load::{LARGEST_FILE, load, load_watched, read_text},
    material_instance::{BY_SIDE, BlendParts, MaterialInstance, Properties},
    object::Object,
    parse::{BUILT_IN, built_in, describe, parse, parse_watched},
    projection::Projection,
    punctual_light::PunctualLightInstance,
    rays::{CameraJoin, CameraRays},
    renamed::{RENAMED, Renamed},
    reuse::{PathReuse, Reuse},
    roulette::Roulette,
    settings::{Changes, RenderSettings, Setting},
    shipped::ShippedScene,
    shutter::{Moments, Shutter},
    strategy::Strategy,
    used::used_textures,
};
use crate::{
    geometry::{Motion, Shapes},
    image::Picture,
    light::Lights,
    material::Stage,
    sampling::Directions,
    texture::Textures,
};
use noisefall_base::{
    declare::{Assets, Memo},
    memory::Reservation,
};

/// Media that a path can be in at once: those of tinted scenes are kept in four bytes.
const MOST_NESTED: usize = 4;

/// Dielectrics that are looked at for media within each other.
const MOST_LOOKED_AT: usize = 256;

/// A compiled scene, shared between threads. It does not change, except that four values are computed at their first use and then
/// kept: what it pays to share, the estimator that `auto` stands for, how paths start at the lights, and the warnings. All depend on the
/// scene alone.
pub struct Scene {
    /// Name of the scene in the window and in reports.
    pub title: String,
    /// The text of the scene file.
    pub source: SceneText,
    /// A text for people.
    pub notes: String,
    /// Shapes and their acceleration structures.
    pub shapes: Arc<Shapes>,
    /// Surface data of every primitive for the kernel.
    pub surfaces: Surfaces,
    /// All textures.
    pub textures: Textures,
    /// Emitters, lights and background, with the tables that choose among them.
    pub lights: Arc<Lights>,
    /// The materials of the scene file.
    pub materials: Vec<MaterialInstance>,
    /// The objects in the order of their primitive ids, emitting ones first.
    pub objects: Vec<Object>,
    /// The punctual lights that emit light, in the order of [`Lights::punctual_lights`].
    pub punctual_lights: Vec<PunctualLightInstance>,
    /// The place of the object that a primitive is a piece of.
    pub owners: Vec<u32>,
    /// The extent of the scene in metres, as a person walking through it would say it.
    pub size: f64,
    /// Settings that the scene opens with.
    pub camera: Camera,
    /// Motion of the camera from time 0 to 1.
    pub camera_motion: Motion,
    /// The settings that the scene opens with.
    pub settings: RenderSettings,
    /// The path reuse that pays in this scene, once it has been tried.
    pub path_reuse_by_trial: OnceLock<PathReuse>,
    /// The rays with which light paths start, or what keeps them from it: see [`Scene::light_rays`].
    pub light_paths: OnceLock<Result<LightStarts, Obstacle>>,
    /// The estimator that [`Estimator::Auto`] stands for, once it has been tried.
    pub estimator_by_trial: OnceLock<Estimator>,
    /// Samples per pixel to stop at.
    pub spp: Option<u32>,
    /// Exposure that the scene is displayed with, stops.
    pub exposure: f32,
    /// The reference that the image must converge to, if it is known.
    pub reference: Option<SceneReference>,
    /// Largest number of media around the middle of a dielectric.
    pub deepest_media: usize,
    /// Whether rays miss part of a light that they were sampled towards: see [`Lights::are_missed_over`].
    pub lights_are_missed: bool,
    /// Shared by scenes that have the same image: see [`Scene::has_same_image`].
    pub identity: Arc<()>,
    /// Shared by a scene and those that were rebuilt from it: see [`Scene::is_of_same_file`].
    pub lineage: Arc<()>,
    /// Warnings about former names in the file.
    pub former_names: Vec<String>,
    /// See [`Scene::warnings`].
    pub warned: OnceLock<Vec<String>>,
    /// The parts that the compile made, and those that it reused from another scene.
    pub compiled: CompileReport,
    /// Slow parts that other scenes can reuse.
    pub memo: Memo,
    /// Files that the scene names and that are not on disk.
    pub assets: Assets,
    /// Given back with the scene.
    pub memory: Reservation,
}

/// The text of a scene file. For a scene that was changed in memory, it is written at its first use.
pub type SceneText = LazyLock<String, Box<dyn FnOnce() -> String + Send>>;

/// The known solution of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum SceneReference {
    /// An exact radiance, constant over all pixels.
    Radiance([f32; 3]),
    /// A reference image, read from this file.
    Image(PathBuf, Arc<Picture>),
}

impl Scene {
    /// Whether all surfaces are spheres or flat, diffuse, from both sides, and neither their colour nor what they emit varies.
    pub fn is_plain(&self) -> bool {
        self.surfaces.plain && !self.lights.emitters.vary() && self.shapes.are_simple()
    }

    /// Whether all lights are the environment or surfaces in lists, so that any other surface on the way to one hides it.
    pub fn lights_are_listed(&self) -> bool {
        self.lights.punctual_lights.is_empty() && self.lights.emitters.len() <= self.shapes.first_unlisted() as usize
    }

    /// Whether pixels reuse path suffixes.
    #[inline(always)]
    pub fn shares(&self, rays: &CameraRays, settings: &RenderSettings) -> bool {
        PathReuse::asked(settings.reuse).has_suffixes() && self.can_share(rays, settings)
    }

    /// Whether they could: from diffuse surfaces by cosine-distributed directions, in empty space, while nothing moves.
    ///
    /// Not where light passes through surfaces or materials are blended: the pdf with which another pixel finds a point would then
    /// contain the mean transmittance on the way and the mean opacity there, and a visibility ray tells neither. Not with paths from
    /// lights, which are shared by all pixels already.
    #[inline]
    pub fn can_share(&self, rays: &CameraRays, settings: &RenderSettings) -> bool {
        settings.directions != Directions::Uniform
            && settings.max_bounces.is_none_or(|cap| cap > 1)
            && !rays.take_time()
            && self.surfaces.media.is_empty()
            && self.surfaces.are_opaque()
            && self.surfaces.stages.contains(&Stage::Plain)
            && !self.traces_light_paths(settings)
    }

    /// Whether crossings of surfaces count as bounces, and some surface can be crossed.
    #[inline]
    pub fn counts_crossings(&self, settings: &RenderSettings) -> bool {
        settings.count_crossings && settings.max_bounces.is_some() && !self.surfaces.are_opaque()
    }

    /// Whether light samples depend on what glossy surfaces reflect.
    pub fn weights_lights_by_lobe(&self) -> bool {
        self.lights.heed_lobes() && self.surfaces.glossy
    }

    /// Whether it has the bits of a scene that is compiled from scratch: see [`Precision`](noisefall_base::declare::Precision).
    pub fn is_exact(&self) -> bool {
        !self.shapes.have_moved_meshes() && self.surfaces.materials.are_exact()
    }

    /// Whether something moves in the course of time.
    pub fn moves(&self) -> bool {
        self.shapes.move_in_time() || !self.camera_motion.0.is_empty()
    }

    /// The media around a point at a time, as paths carry them: see [`surface::Surfaces::media`].
    fn media_at(&self, p: DVec3, time: f64) -> u32 {
        if self.surfaces.media.is_empty() {
            return 0;
        }
        self.nested_media(self.media_around(p, time).collect())
    }

    /// The media inside of objects around a point, with their numbers, as paths carry them.
    fn nested_media(&self, mut around: Vec<(usize, &Object)>) -> u32 {
        // The outermost first: a medium that fills all but a sphere lies around every one within a sphere.
        let reach = |object: &Object| if object.flip { f64::INFINITY } else { object.shape.bounding_sphere().1 };
        around.sort_by(|a, b| reach(b.1).total_cmp(&reach(a.1)));
        around.iter().fold(0, |stack, (id, _)| stack << 8 | self.medium(*id))
    }

    /// The medium inside an object; 0 if it is not tinted.
    fn medium(&self, object: usize) -> u32 {
        let primitive = self.owners.partition_point(|owner| *owner < object as u32);
        self.surfaces.varying.get(primitive).map_or(0, |row| row[3].to_bits())
    }

    /// Largest number of media around the middle of a dielectric, including its own; 0 if none is tinted.
    fn count_deepest_media(&self) -> usize {
        if self.surfaces.media.is_empty() {
            return 0;
        }
        // In a large scene only some dielectrics are tested, each against all others.
        let dielectrics = self.objects.iter().filter(|object| self.has_inside(object));
        let step = dielectrics.clone().count().div_ceil(MOST_LOOKED_AT).max(1);
        let middles = dielectrics.step_by(step).map(|object| object.shape.bounding_sphere().0);
        middles.map(|middle| self.media_around(middle, 0.0).count()).max().unwrap_or(0)
    }

    /// The dielectrics whose inside holds a point at a time, with their numbers.
    fn media_around(&self, p: DVec3, time: f64) -> impl Iterator<Item = (usize, &Object)> {
        let holds = move |object: &Object| {
            // Where the point is in the pose at time 0.
            let p = object.motion.at(time).inverse().transform_point3(p);
            object.shape.contains(p) != object.flip
        };
        self.objects.iter().enumerate().filter(move |(_, object)| self.has_inside(object) && holds(object))
    }
}

impl Scene {
    /// Material of an object; `None` is black.
    pub fn material(&self, object: &Object) -> Option<&MaterialInstance> {
        object.material.map(|number| &self.materials[number as usize])
    }

    /// The places of the objects that an object of the description was compiled to. They follow each other.
    pub fn objects_of(&self, described: usize) -> Range<usize> {
        let is_of = |object: &Object| object.described as usize == described;
        let first = self.objects.iter().position(is_of).unwrap_or(0);
        first..first + self.objects[first..].iter().take_while(|object| is_of(object)).count()
    }

    /// Whether light passes into an object.
    pub fn has_inside(&self, object: &Object) -> bool {
        self.material(object).is_some_and(|material| material.properties.has_inside)
    }

    /// Whether light passes through the surface of an object without meeting it.
    pub fn lets_pass(&self, object: &Object) -> bool {
        self.material(object).is_some_and(|material| material.properties.passes)
    }
}
