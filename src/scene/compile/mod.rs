//! From what a file says to what the renderer runs on: names become numbers, values are checked, tables are built.
use std::collections::BTreeMap;

use toml::Spanned;

mod camera;
mod settings;

use self::{
    camera::camera,
    settings::{settings, truth},
};
use super::{
    Camera, Object, RenderSettings, Scene,
    check::{Checker, ColourRange},
    desc::{BackgroundDesc, EmissionDesc, MaterialDesc, ObjectDesc, SceneDesc, ShapeDesc},
    diagnostic::{SceneError, SourceText},
    surface::{self, Stage},
    textures::{ColourSource, NamedTextures},
};
use crate::{
    geometry::{Shapes, Sphere},
    light::{Background, Emission, Lights, Side},
    material::{Material, Materials},
    texture::Textures,
};

/// The version of the scene format that this program reads.
pub const FORMAT: i64 = 1;

/// Checks a description and builds the scene. Errors point into `source`, which is the text that `desc` was read from.
pub fn compile(desc: &SceneDesc, source: &SourceText) -> Result<Scene, SceneError> {
    let check = Checker(source);
    let camera = camera(&check, &desc.camera)?;
    let background = desc.background.as_ref().map(|b| background(&check, b)).transpose()?;
    let textures = NamedTextures::compile(&check, &desc.textures)?;
    let materials = materials(&check, &desc.materials, &textures)?;
    let mut objects = desc.objects.iter().map(|o| object(&check, o, &materials)).collect::<Result<Vec<_>, _>>()?;
    // A stable sort: emitting primitives first, as the table of emitters wants it.
    objects.sort_by_key(|object| object.emission.is_none());
    let (settings, spp) = settings(&check, &desc.render)?;
    let truth = desc.truth.as_ref().map(|t| truth(&check, t)).transpose()?;
    let scene = build(objects, background, camera, settings);
    Ok(Scene {
        title: desc.title.clone().unwrap_or_default(),
        notes: desc.notes.clone().unwrap_or_default(),
        source: source.text.clone(),
        textures: textures.textures,
        spp,
        truth,
        ..scene
    })
}

/// The tables of the kernel.
fn build(objects: Vec<Object>, background: Option<Background>, camera: Camera, settings: RenderSettings) -> Scene {
    let spheres: Vec<_> = objects.iter().map(|o| Sphere::new(o.center, o.radius, camera.look_at)).collect();
    let emissions: Vec<Emission> = objects.iter().map_while(|o| o.emission).collect();
    let background = background.filter(|b| b.radiance != [0.0; 3]);
    let surface = |object: &Object| match object.material {
        Some(material) => {
            let [r, g, b] = material.colour();
            [r, g, b, f32::from_bits(surface::pack(0, Stage::Plain, 0))]
        }
        None => [0.0; 4],
    };
    Scene {
        title: String::new(),
        source: String::new(),
        notes: String::new(),
        lights: Lights::new(&spheres, &emissions, background),
        shapes: Shapes::new(spheres),
        textures: Textures::default(),
        materials: Materials::default(),
        surfaces: objects.iter().map(surface).collect(),
        varying: vec![[0.0; 4]; objects.len()],
        stages: vec![Stage::Plain],
        size: size(&objects, &camera),
        objects,
        camera,
        settings,
        spp: None,
        truth: None,
    }
}

/// The extent that a person would call the size of the scene: of the objects that are not themselves far larger than the
/// distance the camera looks over.
fn size(objects: &[Object], camera: &Camera) -> f64 {
    let view = camera.eye.distance(camera.look_at);
    let small = objects.iter().filter(|object| object.radius < 10.0 * view);
    small.map(|object| 2.0 * (object.center.distance(camera.look_at) + object.radius)).fold(view, f64::max).min(10.0 * view)
}

fn background(check: &Checker, desc: &Spanned<BackgroundDesc>) -> Result<Background, SceneError> {
    let b = desc.as_ref();
    check.refuse(&[("image", &b.image), ("rotate", &b.rotate), ("scale", &b.scale)])?;
    let radiance = b.radiance.as_ref().ok_or_else(|| check.missing(desc, "radiance"))?;
    Ok(Background { radiance: check.radiance(radiance)? })
}

fn materials(
    check: &Checker,
    descs: &BTreeMap<String, Spanned<MaterialDesc>>,
    textures: &NamedTextures,
) -> Result<BTreeMap<String, Material>, SceneError> {
    descs.iter().map(|(name, desc)| Ok((name.clone(), material(check, name, desc, textures)?))).collect()
}

fn material(check: &Checker, name: &str, desc: &Spanned<MaterialDesc>, textures: &NamedTextures) -> Result<Material, SceneError> {
    let m = desc.as_ref();
    check.refuse(&[
        ("mirror", &m.mirror),
        ("dielectric", &m.dielectric),
        ("conductor", &m.conductor),
        ("plastic", &m.plastic),
        ("bump", &m.bump),
        ("normal_map", &m.normal_map),
        ("two_sided", &m.two_sided),
    ])?;
    let lambertian = m.lambertian.as_ref().ok_or_else(|| {
        check.0.error(desc.span(), format!("material `{name}` says no kind"), "expected `lambertian = { albedo = … }`")
    })?;
    match textures.colour_or_texture(check, &ColourRange::ALBEDO, &lambertian.albedo)? {
        ColourSource::Constant(albedo) => Ok(Material::Lambertian { albedo }),
        ColourSource::Texture(_) => Err(check.not_supported("texture", lambertian.albedo.span())),
    }
}

fn object(check: &Checker, desc: &Spanned<ObjectDesc>, materials: &BTreeMap<String, Material>) -> Result<Object, SceneError> {
    let o = desc.as_ref();
    check.refuse(&[("transform", &o.transform), ("motion", &o.motion)])?;
    let unsupported = |kind: &str| Err(check.not_supported(kind, o.shape.span()));
    let sphere = match o.shape.as_ref() {
        ShapeDesc::Sphere(sphere) => sphere,
        ShapeDesc::Cuboid(_) => return unsupported("cuboid"),
        ShapeDesc::Cylinder(_) => return unsupported("cylinder"),
        ShapeDesc::Disk(_) => return unsupported("disk"),
        ShapeDesc::Rectangle(_) => return unsupported("rectangle"),
        ShapeDesc::Triangle(_) => return unsupported("triangle"),
        ShapeDesc::Mesh(_) => return unsupported("mesh"),
        ShapeDesc::Isosurface(_) => return unsupported("isosurface"),
    };
    let material = o.material.as_ref().map(|name| named_material(check, name, materials)).transpose()?;
    let emission = o.emission.as_ref().map(|e| emission(check, e, o.flip)).transpose()?.flatten();
    Ok(Object {
        name: o.name.clone().unwrap_or_default(),
        center: check.point("center", &sphere.center)?,
        radius: check.radius(&sphere.radius)?,
        material,
        emission,
    })
}

fn named_material(
    check: &Checker,
    name: &Spanned<String>,
    materials: &BTreeMap<String, Material>,
) -> Result<Material, SceneError> {
    materials.get(name.as_ref()).copied().ok_or_else(|| check.not_defined("material", name, materials.keys()))
}

fn emission(check: &Checker, desc: &Spanned<EmissionDesc>, flip: bool) -> Result<Option<Emission>, SceneError> {
    let e = desc.as_ref();
    check.refuse(&[("texture", &e.texture), ("scale", &e.scale)])?;
    let radiance = check.radiance(e.radiance.as_ref().ok_or_else(|| check.missing(desc, "radiance"))?)?;
    let side = match (e.two_sided, flip) {
        (true, _) => Side::Both,
        (false, false) => Side::Front,
        (false, true) => Side::Back,
    };
    Ok((radiance != [0.0; 3]).then_some(Emission { radiance, side }))
}
