//! From what a file says to what the renderer runs on: names become numbers, values are checked, tables are built.
use std::{
    collections::{BTreeMap, HashSet},
    sync::Arc,
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
    Camera, Object, Scene,
    check::Checker,
    desc::SceneDesc,
    diagnostic::{SceneError, SourceText},
    surface::Surfaces,
    textures::NamedTextures,
};
use crate::{
    geometry::{Shape, Shapes},
    light::Lights,
    quote,
};

/// The version of the scene format that this program reads.
pub const FORMAT: i64 = 1;

/// Checks a description and builds the scene. Errors point into `source`, which is the text that `desc` was read from.
pub fn compile(desc: &SceneDesc, source: &SourceText) -> Result<Scene, SceneError> {
    let check = Checker::new(source);
    let camera = camera(&check, &desc.camera)?;
    let background = desc.background.as_ref().map(|b| background(&check, b)).transpose()?.flatten();
    let mut textures = NamedTextures::compile(&check, &desc.textures)?;
    let mut coatings = BTreeMap::new();
    for (name, material) in &desc.materials {
        coatings.insert(name.clone(), coating(&check, name, material, &mut textures)?);
    }
    let mut meshes = Meshes::default();
    let lists = desc.objects.iter().map(|o| objects(&check, o, &coatings, &textures, &mut meshes));
    let mut objects: Vec<Object> = lists.collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect();
    // A stable sort: emitting primitives first, as the table of emitters wants it.
    objects.sort_by_key(|object| object.emission.is_none());
    reserve_tables(&check, &objects)?;
    let (settings, spp) = settings(&check, &desc.render)?;
    let truth = desc.truth.as_ref().map(|t| truth(&check, t)).transpose()?;
    let owners = objects.iter().enumerate().flat_map(|(i, o)| vec![i as u32; o.shape.piece_count()]).collect();
    let shapes = Shapes::new(objects.iter().map(|o| (&o.shape, &o.motion)), camera.look_at);
    let emitting = objects.iter().map_while(|o| o.emission.map(|emission| (o, emission)));
    let emitters: Vec<_> = emitting
        .flat_map(|(o, emission)| o.shape.pieces().into_iter().map(move |piece| (piece, o.motion.clone(), emission)))
        .collect();
    let camera_motion = motion(&check, &desc.camera.as_ref().motion)?;
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
