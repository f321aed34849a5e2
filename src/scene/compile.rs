//! From what a file says to what the renderer runs on: names become numbers, values are checked, tables are built.
use std::collections::BTreeMap;

use glam::DVec3;
use toml::Spanned;

use super::{
    Camera, CameraError, Object, RenderSettings, Roulette, Scene, Truth,
    check::{Checker, ColourRange},
    desc::{
        BackgroundDesc, CameraDesc, DirectionsDesc, EmissionDesc, EstimatorDesc, MaterialDesc, ObjectDesc, RenderDesc, SceneDesc,
        ShapeDesc, TruthDesc,
    },
    diagnostic::{SceneError, SourceText},
    textures::{ColourSource, NamedTextures},
};
use crate::{
    geometry::{Shapes, Sphere},
    light::{Background, Emission, Emitters, Side},
    material::Material,
    sampling::Directions,
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
    let spheres = objects.iter().map(|o| Sphere::new(o.center, o.radius, camera.look_at)).collect();
    let emissions: Vec<Emission> = objects.iter().map_while(|o| o.emission).collect();
    let albedo = |object: &Object| match object.material {
        Some(Material::Lambertian { albedo: [r, g, b] }) => [r, g, b, 0.0],
        None => [0.0; 4],
    };
    Scene {
        title: String::new(),
        source: String::new(),
        notes: String::new(),
        shapes: Shapes::new(spheres),
        albedo: objects.iter().map(albedo).collect(),
        textures: Textures::default(),
        emitters: Emitters::new(&emissions),
        background: background.filter(|b| b.radiance != [0.0; 3]),
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

fn camera(check: &Checker, desc: &Spanned<CameraDesc>) -> Result<Camera, SceneError> {
    let c = desc.as_ref();
    check.refuse(&[("lens", &c.lens), ("shutter", &c.shutter)])?;
    let camera = Camera {
        eye: check.point("eye", &c.eye)?,
        look_at: check.point("look_at", &c.look_at)?,
        up: c.up.as_ref().map_or(Ok(DVec3::Y), |up| check.point("up", up))?,
        fov: *c.fov.as_ref(),
        resolution: c.resolution.as_ref().0,
    };
    camera.check().map_err(|error| {
        let span = match error {
            CameraError::Resolution => c.resolution.span(),
            CameraError::Fov | CameraError::NotFinite => c.fov.span(),
            CameraError::NoDirection => c.look_at.span(),
            CameraError::UpIsForward => c.up.as_ref().unwrap_or(&c.look_at).span(),
        };
        check.0.error(span, error.to_string(), "here")
    })?;
    Ok(camera)
}

fn background(check: &Checker, desc: &Spanned<BackgroundDesc>) -> Result<Background, SceneError> {
    let b = desc.as_ref();
    check.refuse(&[("image", &b.image), ("rotate", &b.rotate), ("scale", &b.scale)])?;
    let radiance = b.radiance.as_ref().ok_or_else(|| missing(check, desc, "radiance"))?;
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
    let radiance = check.radiance(e.radiance.as_ref().ok_or_else(|| missing(check, desc, "radiance"))?)?;
    let side = match (e.two_sided, flip) {
        (true, _) => Side::Both,
        (false, false) => Side::Front,
        (false, true) => Side::Back,
    };
    Ok((radiance != [0.0; 3]).then_some(Emission { radiance, side }))
}

fn settings(check: &Checker, desc: &RenderDesc) -> Result<(RenderSettings, Option<u32>), SceneError> {
    if let Some(estimator) = &desc.estimator {
        match estimator.as_ref() {
            EstimatorDesc::Path => {}
            EstimatorDesc::Light => return Err(check.not_supported("light", estimator.span())),
            EstimatorDesc::Mis => return Err(check.not_supported("mis", estimator.span())),
        }
    }
    let directions = match desc.directions.as_ref().map(|d| (*d.as_ref(), d.span())) {
        None => Directions::default(),
        Some((DirectionsDesc::Uniform, _)) => Directions::Uniform,
        Some((DirectionsDesc::Cosine, _)) => Directions::Cosine,
        Some((DirectionsDesc::Bsdf, span)) => return Err(check.not_supported("bsdf", span)),
    };
    let roulette = desc.roulette.as_ref().map_or(Roulette::default(), |r| *r.as_ref());
    if let (Roulette::Fixed(p), Some(r)) = (roulette, &desc.roulette)
        && !(Roulette::LEAST..=1.0).contains(&p)
    {
        return Err(check.0.error(r.span(), format!("a survival probability of {p}"), "expected a number from 0.01 to 1"));
    }
    if let Some(spp) = desc.spp.as_ref().filter(|spp| *spp.as_ref() == 0) {
        return Err(check.0.error(spp.span(), "`spp` is 0", "expected at least 1 sample per pixel"));
    }
    let settings = RenderSettings {
        sampler: desc.sampler.unwrap_or_default(),
        directions,
        roulette,
        max_bounces: desc.max_bounces,
        seed: desc.seed.unwrap_or(0),
    };
    Ok((settings, desc.spp.as_ref().map(|spp| *spp.as_ref())))
}

fn truth(check: &Checker, desc: &Spanned<TruthDesc>) -> Result<Truth, SceneError> {
    match (&desc.as_ref().radiance, &desc.as_ref().image) {
        (Some(radiance), None) => Ok(Truth::Radiance(check.radiance(radiance)?)),
        (None, Some(image)) => {
            let path = check.path(image);
            if !path.is_file() {
                return Err(check.0.error(image.span(), format!("there is no file {}", path.display()), "not found"));
            }
            Ok(Truth::Image(path))
        }
        _ => Err(check.0.error(desc.span(), "`truth` must say either `radiance` or `image`", "here")),
    }
}

fn missing<T>(check: &Checker, table: &Spanned<T>, key: &str) -> SceneError {
    check.0.error(table.span(), format!("missing key `{key}`"), format!("`{key}` must be given here"))
}
