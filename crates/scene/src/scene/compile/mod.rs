//! From a description to what the renderer runs on: names become numbers, values are checked, tables are built.
mod blend;
mod camera;
mod check;
mod light;
mod material;
mod merge;
mod object;
mod problems;
mod punctual_light;
mod reuse;

use std::{
    path::Path as FilePath,
    sync::{Arc, OnceLock},
    time::{Duration, Instant},
};

use glam::DVec3;

use self::{
    blend::blends, camera::camera, material::materials, object::objects, problems::Problems, punctual_light::punctual_lights,
};
pub use self::{
    blend::check_blend,
    check::{check_camera, check_object, check_punctual},
    reuse::Before,
};
use super::{
    Camera, CompileReport, MaterialInstance, Object, PunctualLightInstance, RenderSettings, Scene, SceneReference, SceneText,
    damage::Damage,
    description::{ReferenceDescription, RenderDescription, SceneDescription},
    surface::Surfaces,
    used::used_textures,
};
use crate::{
    geometry::{Motion, Shape},
    image::{Encoding, read},
    light::{Environment, PunctualLight},
    material::Materials,
    shape::motion,
    texture::{TextureCompiler, Textures},
};
use noisefall_base::{
    declare::{Assets, Leftovers, Memo, Path, Problem, Resources, key_of_file},
    progress::Progress,
    quote,
};

/// Files that a description names: in memory, or in a folder.
pub struct Files<'a> {
    pub folder: &'a FilePath,
    pub assets: Assets,
    /// Shows how far the compile is, and cancels it.
    pub progress: Progress,
}

impl Default for Files<'_> {
    fn default() -> Self {
        Files { folder: FilePath::new(""), assets: Assets::default(), progress: Progress::default() }
    }
}

/// Checks a description and builds the scene, or returns its problems except those that follow from `damage`. `source` is the text of
/// the scene file. Parts that did not change are reused from the scene `before`.
pub fn compile(
    description: &SceneDescription,
    source: SceneText,
    files: Files,
    damage: &Damage,
    before: Option<Before>,
) -> Result<Scene, Vec<Problem>> {
    let start = Instant::now();
    let memo = before.map_or_else(Memo::default, |before| before.scene.memo.clone());
    let Files { folder, assets, progress } = files;
    let resources = Resources::after(folder, memo).with_assets(assets.clone()).with_progress(progress);
    let mut problems = Problems::new(damage);
    let parts = CompiledParts::new(description, &resources, before, &mut problems);
    let Some(parts) = parts.filter(|_| problems.found.is_empty()) else { return Err(problems.found) };
    let mut scene = parts.build(description, source, resources, before).map_err(|problem| vec![problem])?;
    scene.compiled.took = start.elapsed();
    assets.forget_loaded();
    scene.assets = assets;
    Ok(scene)
}

/// The compiled tables of a description.
struct CompiledParts {
    camera: Camera,
    camera_motion: Motion,
    environment: Option<Environment>,
    textures: Textures,
    materials: Vec<MaterialInstance>,
    tables: Materials,
    objects: Vec<Object>,
    punctual_lights: Vec<(PunctualLightInstance, PunctualLight)>,
    settings: RenderSettings,
    spp: Option<u32>,
    exposure: f32,
    reference: Option<SceneReference>,
}

impl CompiledParts {
    /// All tables are looked at, whatever is wrong with one of them.
    fn new(
        description: &SceneDescription,
        resources: &Resources,
        before: Option<Before>,
        problems: &mut Problems,
    ) -> Option<CompiledParts> {
        let at = Path::of;
        let camera = problems.keep(&at("camera"), || camera(&description.camera));
        let camera_motion = problems.keep(&at("camera.motion"), || motion(&description.camera.motion));
        let environment =
            description.environment.as_ref().map(|described| problems.keep(&at("environment"), || described.compile(resources)));
        let mut wrong = Vec::new();
        let (used, stand_ins) = (used_textures(description), problems.damage.names("textures"));
        let mut textures = TextureCompiler::new(resources, &description.textures, used, stand_ins, &mut wrong);
        wrong.retain(|problem| !problems.damage.reaches(&Path(problem.path.0.iter().take(2).cloned().collect())));
        problems.found.extend(wrong);
        let known = before.map(|before| Materials::after(&before.scene.surfaces.materials, before.precision));
        let mut tables = known.unwrap_or_default();
        let (mut materials, numbers) = materials(&description.materials, &mut textures, &mut tables, problems);
        blends(&description.materials, &numbers, &mut materials, &mut textures, &mut tables, problems);
        let mut objects = objects(&description.objects, &numbers, &textures, resources, problems);
        objects.iter_mut().for_each(|object| light::see_through(object, &materials));
        let punctual_lights = punctual_lights(&description.punctual_lights, resources, problems);
        let RenderDescription { settings, spp, exposure } = description.render;
        let reference =
            description.reference.as_ref().map(|described| problems.keep(&at("reference"), || reference(described, resources)));
        Some(CompiledParts {
            camera: camera?,
            camera_motion: camera_motion?,
            environment: environment.flatten().flatten(),
            textures: textures.textures,
            materials,
            tables,
            objects,
            punctual_lights,
            settings,
            spp,
            exposure,
            reference: reference.flatten(),
        })
    }

    /// The scene of its parts.
    fn build(
        self,
        description: &SceneDescription,
        source: SceneText,
        resources: Resources,
        before: Option<Before>,
    ) -> Result<Scene, Problem> {
        let CompiledParts { camera, camera_motion, environment, textures, materials, tables, objects, punctual_lights, .. } =
            self;
        let CompiledParts { settings, spp, exposure, reference, .. } = self;
        let (punctual_instances, punctual_lights): (Vec<_>, Vec<_>) = punctual_lights.into_iter().unzip();
        reserve_tables(&resources, &objects, punctual_lights.len())?;
        let owners = objects.iter().enumerate().flat_map(|(i, o)| vec![i as u32; o.shape.piece_count()]).collect();
        let shapes = reuse::shapes(&objects, camera.look_at, before, &resources)?;
        let lights = reuse::lights(&objects, &shapes, &punctual_lights, environment, before, &resources);
        tables.times_of_tables().iter().for_each(|took| resources.note("material tables", *took));
        let start = Instant::now();
        let surfaces = Surfaces::new(&objects, &materials, tables);
        surfaces.check().map_err(|message| Problem::at("", message, "in this scene"))?;
        resources.note("surfaces", Some(start.elapsed()));
        let Leftovers { memory, memo, report } = resources.into_leftovers();
        let lights_are_missed = lights.are_missed_over(longest_way_of_light(&objects));
        let mut scene = Scene {
            title: quote::message(&description.title),
            notes: description.notes.clone(),
            source,
            lights,
            shapes,
            camera_motion,
            owners,
            surfaces,
            textures,
            size: size(&objects, &camera),
            materials,
            objects,
            punctual_lights: punctual_instances,
            camera,
            settings,
            path_reuse_by_trial: Default::default(),
            light_paths: OnceLock::new(),
            estimator_by_trial: OnceLock::new(),
            spp,
            exposure,
            reference,
            deepest_media: 0,
            lights_are_missed,
            identity: Arc::new(()),
            lineage: before.map(|before| before.scene.lineage.clone()).unwrap_or_default(),
            former_names: Vec::new(),
            warned: OnceLock::new(),
            compiled: CompileReport { parts: report, took: Duration::ZERO },
            memo,
            memory,
            assets: Assets::default(),
        };
        scene.deepest_media = reuse::deepest_media(&scene, before);
        Ok(scene)
    }
}

fn reference(description: &ReferenceDescription, resources: &Resources) -> Result<SceneReference, Problem> {
    match description {
        ReferenceDescription::Radiance(radiance) => Ok(SceneReference::Radiance(radiance.map(|x| x as f32))),
        ReferenceDescription::Image(image) => {
            let path = resources.path(image);
            let picture = resources.once("references", format!("reference {}", key_of_file(&path)), || {
                read(&path, Encoding::Srgb).map_err(|error| Problem::at("image", error.to_string(), "this image cannot be used"))
            })?;
            Ok(SceneReference::Image(path, picture))
        }
    }
}

/// Room for what the renderer looks objects up in: trees, and lights.
fn reserve_tables(resources: &Resources, objects: &[Object], punctual_lights: usize) -> Result<(), Problem> {
    /// Bytes of an object that is not a mesh: in the tree of objects, in tables, and while those are built.
    const OBJECT: u64 = 1000;
    /// Bytes per triangle and per vertex for the tree of a mesh, including its construction.
    const TRIANGLE: u64 = 160;
    const VERTEX: u64 = 24;
    /// Bytes per light among many; each emitting triangle is a light.
    const LIGHT: u64 = 900;
    resources.reserve("", format_args!("{} objects", objects.len()), OBJECT * objects.len() as u64)?;
    let mut lights = punctual_lights as u64;
    for object in objects {
        let count = match &object.shape {
            Shape::Mesh { data, .. } => {
                let [triangles, vertices] = [data.triangles.len(), data.vertices.len()].map(|count| count as u64);
                // Scenes that share a mesh share its tree. The room holds the data: its address is that of no other mesh.
                resources.hold(format!("tree of {:p}", Arc::as_ptr(data)), || {
                    resources.reserve("", format_args!("{triangles} triangles"), TRIANGLE * triangles + VERTEX * vertices)?;
                    Ok(data.clone())
                })?;
                triangles
            }
            _ => 1,
        };
        lights += if object.emission.is_some() { count } else { 0 };
    }
    resources.reserve("", format_args!("{lights} lights"), LIGHT * lights)
}

/// An upper bound of the distance between a point of a light with a surface and one that it can light, metres.
fn longest_way_of_light(objects: &[Object]) -> f64 {
    let spheres: Vec<(DVec3, f64)> = objects.iter().map(|object| object.shape.swept_sphere(&object.motion)).collect();
    let lights = objects.iter().zip(&spheres).filter(|(object, _)| object.emission.is_some());
    let [min, max] = lights.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[min, max], (_, &(center, radius))| {
        [min.min(center - radius), max.max(center + radius)]
    });
    let (middle, extent) = ((min + max) / 2.0, max.distance(min) / 2.0);
    let way = |(object, &(center, radius)): (&Object, &(DVec3, f64))| {
        let farthest = center.distance(middle) + extent;
        // From outside, no more of a ball is lit than up to its horizon.
        let is_ball = matches!(object.shape, Shape::Sphere { .. }) && object.motion.0.is_empty();
        let to_horizon = (farthest * farthest - radius * radius).sqrt();
        if is_ball && center.distance(middle) - extent > radius { to_horizon } else { farthest + radius }
    };
    objects.iter().zip(&spheres).map(way).fold(0.0, f64::max)
}

/// The extent that a person would call the size of the scene: of the objects that are not themselves far larger than the
/// distance the camera looks over.
fn size(objects: &[Object], camera: &Camera) -> f64 {
    let view = camera.eye.distance(camera.look_at);
    let spheres = objects.iter().map(|object| object.shape.bounding_sphere());
    let small = spheres.filter(|(_, radius)| *radius < 10.0 * view);
    small.map(|(center, radius)| 2.0 * (center.distance(camera.look_at) + radius)).fold(view, f64::max).min(10.0 * view)
}
