//! From a description to what the renderer runs on: names become numbers, values are checked, tables are built.
mod camera;
mod check;
mod light;
mod material;
mod object;
mod problems;

use std::{
    collections::HashSet,
    path::Path as FilePath,
    sync::{Arc, OnceLock},
};

pub use self::check::{check_camera, check_object};
use self::{camera::camera, material::materials, object::objects, problems::Problems};
use super::{
    Camera, MaterialInstance, Object, RenderSettings, Scene, Truth,
    damage::Damage,
    description::{RenderDescription, SceneDescription, TruthDescription},
    surface::Surfaces,
};
use crate::{
    declare::{Path, Problem, Resources},
    geometry::{Motion, Shape, Shapes},
    image::{Encoding, read},
    light::{Background, Lights},
    material::Materials,
    quote,
    shape::motion,
    texture::{TextureCompiler, Textures},
};

/// Checks a description and builds the scene, or says what is wrong with it: nothing that follows from `damage`. `source` is the text of
/// the scene file, and files are looked for in `folder`.
pub fn compile(description: &SceneDescription, source: &str, folder: &FilePath, damage: &Damage) -> Result<Scene, Vec<Problem>> {
    let resources = Resources::new(folder);
    let mut problems = Problems::new(damage);
    let parts = Parts::new(description, &resources, &mut problems);
    match parts {
        Some(parts) if problems.found.is_empty() => parts.build(description, source, resources).map_err(|problem| vec![problem]),
        _ => Err(problems.found),
    }
}

/// What the tables of a description say, each by itself.
struct Parts {
    camera: Camera,
    camera_motion: Motion,
    background: Option<Background>,
    textures: Textures,
    materials: Vec<MaterialInstance>,
    tables: Materials,
    objects: Vec<Object>,
    settings: RenderSettings,
    spp: Option<u32>,
    truth: Option<Truth>,
}

impl Parts {
    /// All tables are looked at, whatever is wrong with one of them.
    fn new(description: &SceneDescription, resources: &Resources, problems: &mut Problems) -> Option<Parts> {
        let at = Path::of;
        let camera = problems.keep(&at("camera"), || camera(&description.camera));
        let camera_motion = problems.keep(&at("camera.motion"), || motion(&description.camera.motion));
        let background =
            description.background.as_ref().map(|described| problems.keep(&at("background"), || described.compile(resources)));
        let mut wrong = Vec::new();
        let mut textures = TextureCompiler::new(resources, &description.textures, problems.damage.names("textures"), &mut wrong);
        wrong.retain(|problem| !problems.damage.reaches(&Path(problem.path.0.iter().take(2).cloned().collect())));
        problems.found.extend(wrong);
        let mut tables = Materials::default();
        let (materials, numbers) = materials(&description.materials, &mut textures, &mut tables, problems);
        let objects = objects(&description.objects, &numbers, &textures, resources, problems);
        let RenderDescription { settings, spp } = description.render;
        let truth = description.truth.as_ref().map(|described| problems.keep(&at("truth"), || truth(described, resources)));
        Some(Parts {
            camera: camera?,
            camera_motion: camera_motion?,
            background: background.flatten().flatten(),
            textures: textures.textures,
            materials,
            tables,
            objects,
            settings,
            spp,
            truth: truth.flatten(),
        })
    }

    /// The scene of its parts.
    fn build(self, description: &SceneDescription, source: &str, resources: Resources) -> Result<Scene, Problem> {
        let Parts { camera, camera_motion, background, textures, materials, tables, objects, settings, spp, truth } = self;
        reserve_tables(&resources, &objects)?;
        let owners = objects.iter().enumerate().flat_map(|(i, o)| vec![i as u32; o.shape.piece_count()]).collect();
        let shapes = Shapes::new(objects.iter().map(|o| (&o.shape, &o.motion)), camera.look_at);
        let emitting = objects.iter().map_while(|o| o.emission.map(|emission| (o, emission)));
        let emitters: Vec<_> = emitting
            .flat_map(|(o, emission)| o.shape.pieces().into_iter().map(move |piece| (piece, o.motion.clone(), emission)))
            .collect();
        let surfaces = Surfaces::new(&objects, &materials, tables);
        surfaces.check().map_err(|message| Problem::at("", message, "in this scene"))?;
        let mut scene = Scene {
            title: quote::message(&description.title),
            notes: description.notes.clone(),
            source: source.to_owned(),
            lights: Lights::new(&shapes, &emitters, background, camera.look_at),
            shapes,
            camera_motion,
            owners,
            surfaces,
            textures,
            size: size(&objects, &camera),
            materials,
            objects,
            camera,
            settings,
            sharing_pays: Default::default(),
            spp,
            truth,
            deepest_media: 0,
            warned: OnceLock::new(),
            memory: resources.into_memory(),
        };
        scene.deepest_media = scene.count_deepest_media();
        Ok(scene)
    }
}

fn truth(description: &TruthDescription, resources: &Resources) -> Result<Truth, Problem> {
    match description {
        TruthDescription::Radiance(radiance) => Ok(Truth::Radiance(radiance.map(|x| x as f32))),
        TruthDescription::Image(image) => {
            let path = resources.path(image);
            let picture = read(&path, Encoding::Srgb)
                .map_err(|error| Problem::at("image", error.to_string(), "this picture cannot be used"))?;
            Ok(Truth::Image(path, Arc::new(picture)))
        }
    }
}

/// Room for what the renderer looks objects up in: trees, and lights.
fn reserve_tables(resources: &Resources, objects: &[Object]) -> Result<(), Problem> {
    /// Bytes of an object that is not a mesh: in the tree of objects, in tables, and while those are built.
    const OBJECT: u64 = 1000;
    /// Of a triangle in the tree of its mesh, and while that is built.
    const TRIANGLE: u64 = 220;
    /// Of a light among many, a triangle that emits being one each.
    const LIGHT: u64 = 900;
    let mut meshes = HashSet::new();
    let (mut triangles, mut lights) = (0, 0);
    for object in objects {
        let count = match &object.shape {
            Shape::Mesh { data, .. } => {
                if meshes.insert(Arc::as_ptr(data)) {
                    triangles += data.triangles.len() as u64;
                }
                data.triangles.len() as u64
            }
            _ => 1,
        };
        lights += if object.emission.is_some() { count } else { 0 };
    }
    resources.reserve("", format_args!("{} objects", objects.len()), OBJECT * objects.len() as u64)?;
    resources.reserve("", format_args!("{triangles} triangles"), TRIANGLE * triangles)?;
    resources.reserve("", format_args!("{lights} lights"), LIGHT * lights)
}

/// The extent that a person would call the size of the scene: of the objects that are not themselves far larger than the
/// distance the camera looks over.
fn size(objects: &[Object], camera: &Camera) -> f64 {
    let view = camera.eye.distance(camera.look_at);
    let spheres = objects.iter().map(|object| object.shape.bounding_sphere());
    let small = spheres.filter(|(_, radius)| *radius < 10.0 * view);
    small.map(|(center, radius)| 2.0 * (center.distance(camera.look_at) + radius)).fold(view, f64::max).min(10.0 * view)
}
