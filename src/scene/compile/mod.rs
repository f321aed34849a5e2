//! From what a file says to what the renderer runs on: names become numbers, values are checked, tables are built.
use std::collections::BTreeMap;

mod camera;
mod light;
mod material;
mod object;
mod settings;

pub use self::material::{Coating, Roughness};
use self::{
    camera::camera,
    light::background,
    material::coating,
    object::object,
    settings::{settings, truth},
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
    geometry::{Shapes, Sphere},
    light::{Emission, Lights},
};

/// The version of the scene format that this program reads.
pub const FORMAT: i64 = 1;

/// Checks a description and builds the scene. Errors point into `source`, which is the text that `desc` was read from.
pub fn compile(desc: &SceneDesc, source: &SourceText) -> Result<Scene, SceneError> {
    let check = Checker(source);
    let camera = camera(&check, &desc.camera)?;
    let background = desc.background.as_ref().map(|b| background(&check, b)).transpose()?.flatten();
    let mut textures = NamedTextures::compile(&check, &desc.textures)?;
    let mut coatings = BTreeMap::new();
    for (name, material) in &desc.materials {
        coatings.insert(name.clone(), coating(&check, name, material, &mut textures)?);
    }
    let objects = desc.objects.iter().map(|o| object(&check, o, &coatings, &textures));
    let mut objects = objects.collect::<Result<Vec<_>, _>>()?;
    // A stable sort: emitting primitives first, as the table of emitters wants it.
    objects.sort_by_key(|object| object.emission.is_none());
    let (settings, spp) = settings(&check, &desc.render)?;
    let truth = desc.truth.as_ref().map(|t| truth(&check, t)).transpose()?;
    let spheres: Vec<_> = objects.iter().map(|o| Sphere::new(o.center, o.radius, camera.look_at)).collect();
    let emissions: Vec<Emission> = objects.iter().map_while(|o| o.emission).collect();
    let surfaces = Surfaces::new(&objects);
    surfaces.check().map_err(|message| check.0.error(0..1, message, "in this scene"))?;
    Ok(Scene {
        title: desc.title.clone().unwrap_or_default(),
        notes: desc.notes.clone().unwrap_or_default(),
        source: source.text.clone(),
        lights: Lights::new(&spheres, &emissions, background),
        shapes: Shapes::new(spheres),
        surfaces,
        textures: textures.textures,
        size: size(&objects, &camera),
        objects,
        camera,
        settings,
        spp,
        truth,
    })
}

/// The extent that a person would call the size of the scene: of the objects that are not themselves far larger than the
/// distance the camera looks over.
fn size(objects: &[Object], camera: &Camera) -> f64 {
    let view = camera.eye.distance(camera.look_at);
    let small = objects.iter().filter(|object| object.radius < 10.0 * view);
    small.map(|object| 2.0 * (object.center.distance(camera.look_at) + object.radius)).fold(view, f64::max).min(10.0 * view)
}
