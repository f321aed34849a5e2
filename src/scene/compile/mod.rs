//! From what a file says to what the renderer runs on: names become numbers, values are checked, tables are built.
use std::{
    collections::{BTreeMap, HashSet},
    sync::{Arc, OnceLock},
};

mod camera;
mod light;
mod material;
mod mesh;
mod object;
mod settings;
mod shape;

pub use self::material::{Coating, Roughness};
use self::{
    camera::camera,
    light::background,
    material::coating,
    mesh::Meshes,
    object::objects,
    settings::{settings, truth},
    shape::motion,
};
use super::{
    Camera, Object, RenderSettings, Scene, Truth,
    check::Checker,
    desc::SceneDesc,
    describe::Damage,
    diagnostic::{SceneError, SourceText},
    errors::Errors,
    surface::Surfaces,
    textures::NamedTextures,
};
use crate::{
    geometry::{Motion, Shape, Shapes},
    light::{Background, Lights},
    quote,
};

/// The version of the scene format that this program reads.
pub const FORMAT: i64 = 1;

/// Checks a description and builds the scene, or says what is wrong with it: nothing more where `damage` is to blame. Errors point into
/// `source`, which is the text that `desc` was read from.
pub fn compile(desc: &SceneDesc, source: &SourceText, damage: &Damage) -> Result<Scene, Vec<SceneError>> {
    let check = Checker::new(source);
    let mut errors = Errors::new(damage);
    let parts = parts(&check, desc, &mut errors);
    match (parts, errors.into_found()) {
        (Some(parts), found) if found.is_empty() => build(parts, desc, check).map_err(|error| vec![error]),
        (_, found) => Err(found),
    }
}

/// What the tables of a file say, each by itself.
struct Parts {
    camera: Camera,
    camera_motion: Motion,
    background: Option<Background>,
    textures: NamedTextures,
    objects: Vec<Object>,
    settings: RenderSettings,
    spp: Option<u32>,
    truth: Option<Truth>,
}

/// All tables are looked at, whatever is wrong with one of them.
fn parts(check: &Checker, desc: &SceneDesc, errors: &mut Errors) -> Option<Parts> {
    let camera = camera(check, &desc.camera, errors);
    let camera_motion = errors.keep(&desc.camera, motion(check, &desc.camera.as_ref().motion));
    let background = desc.background.as_ref().and_then(|b| errors.keep(b, background(check, b)));
    let mut textures = NamedTextures::compile(check, &desc.textures, errors);
    // Without a coating: what is wrong with it has been said, and objects may name it.
    let left_out = errors.left_out("materials").map(|name| (name.to_owned(), None));
    let mut coatings: BTreeMap<String, Option<Coating>> = left_out.collect();
    for (name, material) in &desc.materials {
        if errors.are_many() {
            return None;
        }
        let coating = coating(check, name, material, &mut textures);
        coatings.insert(name.clone(), errors.keep(material, coating));
    }
    let mut meshes = Meshes::default();
    let mut objects: Vec<Object> = Vec::new();
    for object in &desc.objects {
        objects.extend(self::objects(check, object, &coatings, &textures, &mut meshes, errors));
        if errors.are_many() {
            return None;
        }
    }
    // A stable sort: emitting primitives first, as the table of emitters wants it.
    objects.sort_by_key(|object| object.emission.is_none());
    let settings = errors.keep_at(&(0..0), settings(check, &desc.render));
    let truth = desc.truth.as_ref().and_then(|t| errors.keep(t, truth(check, t)));
    let (settings, spp) = settings?;
    Some(Parts {
        camera: camera?,
        camera_motion: camera_motion?,
        background: background.flatten(),
        textures,
        objects,
        settings,
        spp,
        truth,
    })
}

/// The scene of its parts.
fn build(parts: Parts, desc: &SceneDesc, check: Checker) -> Result<Scene, SceneError> {
    let Parts { camera, camera_motion, background, textures, objects, settings, spp, truth } = parts;
    let source = check.0;
    reserve_tables(&check, &objects)?;
    let owners = objects.iter().enumerate().flat_map(|(i, o)| vec![i as u32; o.shape.piece_count()]).collect();
    let shapes = Shapes::new(objects.iter().map(|o| (&o.shape, &o.motion)), camera.look_at);
    let emitting = objects.iter().map_while(|o| o.emission.map(|emission| (o, emission)));
    let emitters: Vec<_> = emitting
        .flat_map(|(o, emission)| o.shape.pieces().into_iter().map(move |piece| (piece, o.motion.clone(), emission)))
        .collect();
    let surfaces = Surfaces::new(&objects);
    surfaces.check().map_err(|message| check.0.error(0..1, message, "in this scene"))?;
    let mut scene = Scene {
        title: desc.title.as_deref().map(quote::message).unwrap_or_default(),
        notes: desc.notes.clone().unwrap_or_default(),
        source: source.text.clone(),
        lights: Lights::new(&shapes, &emitters, background, camera.look_at),
        shapes,
        camera_motion,
        owners,
        surfaces,
        textures: textures.textures,
        size: size(&objects, &camera),
        objects,
        camera,
        settings,
        sharing_pays: Default::default(),
        spp,
        truth,
        deepest_media: 0,
        warned: OnceLock::new(),
        memory: check.into_memory(),
    };
    scene.deepest_media = scene.count_deepest_media();
    Ok(scene)
}

/// Room for what the renderer looks objects up in: trees, and lights.
fn reserve_tables(check: &Checker, objects: &[Object]) -> Result<(), SceneError> {
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
    let nowhere = || 0..1;
    check.reserve(nowhere(), format_args!("{} objects", objects.len()), OBJECT * objects.len() as u64)?;
    check.reserve(nowhere(), format_args!("{triangles} triangles"), TRIANGLE * triangles)?;
    check.reserve(nowhere(), format_args!("{lights} lights"), LIGHT * lights)
}

/// The extent that a person would call the size of the scene: of the objects that are not themselves far larger than the
/// distance the camera looks over.
fn size(objects: &[Object], camera: &Camera) -> f64 {
    let view = camera.eye.distance(camera.look_at);
    let spheres = objects.iter().map(|object| object.shape.bounding_sphere());
    let small = spheres.filter(|(_, radius)| *radius < 10.0 * view);
    small.map(|(center, radius)| 2.0 * (center.distance(camera.look_at) + radius)).fold(view, f64::max).min(10.0 * view)
}
