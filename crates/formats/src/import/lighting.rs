//! Light of scenes of other programs: emission that gives none is dropped, and a scene without light gets the sky of [`super::studio`].
use std::f64::consts::PI;

use glam::{DVec3, Vec3};

use super::{Folder, Imported, studio};
use noisefall_base::{declare::Resources, math::colour::LUMINANCE};
use noisefall_scene::{
    light::emission::Side,
    model::Model,
    scene::{
        description::{ObjectDescription, SceneDescription},
        used_textures,
    },
    texture::TextureCompiler,
};

/// Least light of surfaces, as part of that of the studio sky, with which a scene is lit. The indicator lights of a device are below it,
/// and the light of a room is above.
const LIT: f64 = 0.05;

/// Sizes that tell how much light emission gives.
pub struct Sizes {
    /// Areas of the objects, m²: infinite where they are not known. Only those of objects that emit count.
    pub areas: Vec<f64>,
    /// Least and greatest coordinates of the scene, metres.
    pub bounds: [DVec3; 2],
}

impl Sizes {
    /// For scenes whose emission always counts as light.
    pub fn unknown(to: &Imported) -> Sizes {
        Sizes { areas: vec![f64::INFINITY; to.description.objects.len()], bounds: [DVec3::ZERO, DVec3::ONE] }
    }
}

/// Drops black emission, which is no light and which a scene may not have. Returns the mean luminance of each object's emission,
/// W/(m² sr).
pub fn drop_black(to: &mut Imported, folder: &Folder) -> Vec<f64> {
    let luminances = luminances(to, folder);
    for (object, _) in to.description.objects.iter_mut().zip(&luminances).filter(|(_, luminance)| **luminance <= 0.0) {
        object.emission = None;
    }
    luminances
}

/// Drops black emission, and adds the neutral studio sky unless lights or emission light the scene.
pub fn complete(to: &mut Imported, folder: &Folder, sizes: &Sizes, place: &str) {
    let luminances = drop_black(to, folder);
    if !to.description.punctual_lights.is_empty() || to.description.environment.is_some() {
        return;
    }
    let power = |((object, luminance), area): ((&ObjectDescription, f64), &f64)| {
        let sides = object.emission.as_ref().map(|emission| if emission.two_sided { 2.0 } else { 1.0 })?;
        Some(PI * luminance * area * sides)
    };
    let power: f64 = to.description.objects.iter().zip(luminances).zip(&sizes.areas).filter_map(power).sum();
    let [x, y, z] = (sizes.bounds[1] - sizes.bounds[0]).to_array();
    // The box around the scene stands in for the surfaces that the light falls on.
    let lit = power / (2.0 * (x * y + y * z + z * x)) / (PI * studio::RADIANCE);
    if power == 0.0 {
        studio::light(to, place, "no light", "the light differs from the original");
    } else if lit < LIT {
        let found = format!("only emission that gives {} of a studio's light", percent(lit));
        studio::light(to, place, found, "the scene has this sky besides its own light");
    }
}

/// A part as percentage of two digits.
fn percent(part: f64) -> String {
    let percent = 100.0 * part;
    if percent >= 0.1 { format!("{percent:.1} %") } else { format!("{percent:.2} %") }
}

/// The mean luminance of the emission of each object, as the renderer takes it; 0 without emission. An image that cannot be read counts as
/// grey.
fn luminances(to: &Imported, folder: &Folder) -> Vec<f64> {
    let emitting =
        to.description.objects.iter().map(|object| ObjectDescription { emission: object.emission.clone(), ..Default::default() });
    let mut lights =
        SceneDescription { objects: emitting.collect(), textures: to.description.textures.clone(), ..Default::default() };
    let used = used_textures(&lights);
    lights.textures.retain(|name, _| used.contains(name));
    let resources = Resources::new(folder.path()).with_assets(to.assets.clone());
    let textures = TextureCompiler::new(&resources, &lights.textures, used, std::iter::empty(), &mut Vec::new());
    let luminance = |object: &ObjectDescription| {
        let Some(emission) = &object.emission else { return 0.0 };
        let mean = emission.source.kind().compile(emission.scale as f32, Side::Front, &textures);
        let mean = mean.map_or([1.0; 3], |found| found.mean);
        mean.iter().zip(LUMINANCE).map(|(x, weight)| f64::from(x * weight)).sum()
    };
    lights.objects.iter().map(luminance).collect()
}

/// The area of a mesh, m².
pub fn area(model: &Model) -> f64 {
    let corner = |vertex: u32| Vec3::from(model.vertices[vertex as usize]).as_dvec3();
    let area = |[a, b, c]: &[u32; 3]| (corner(*b) - corner(*a)).cross(corner(*c) - corner(*a)).length() / 2.0;
    model.triangles.iter().map(area).sum()
}
