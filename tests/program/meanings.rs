//! Every key of a scene file takes effect in the scene, with its default and with another value.
use std::{fs, sync::Arc};

use glam::DVec3;
use noisefall_base::{
    declare::Textured,
    math::{F, One, V},
};
use noisefall_scene::{
    geometry::Shape,
    light::{Environment, Side, environment::constant::ConstantRadiance},
    material::{AlphaSource, Conductor, Dielectric, Lambertian, Material, Mirror, Plastic, Reflectance, Roughness, Stage},
    sampling::{Directions, Filter, Sampler},
    scene::{Estimator, Lens, MaterialInstance, Object, Projection, Reuse, Roulette, Scene, SceneReference, Shutter, parse},
    texture::ColourSource,
};

fn compiled(text: &str) -> Scene {
    let view = "camera = { eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0], fov = 40.0, resolution = [8, 8] }";
    let text = format!("format = 1\n{}", text.replace("VIEW", view));
    parse("meanings.toml", text).unwrap_or_else(|error| panic!("{}", error.report()))
}

fn object(text: &str) -> Object {
    compiled(&format!("VIEW\n[[objects]]\n{text}")).objects.remove(0)
}

fn instance(material: &str) -> MaterialInstance {
    let ball = "shape.sphere = { center = [0, 0, 0], radius = 1.0 }";
    let scene = compiled(&format!("VIEW\n[materials.m]\n{material}\n[[objects]]\n{ball}\nmaterial = 'm'"));
    scene.material(&scene.objects[0]).cloned().expect("it has a material")
}

#[test]
fn cameras() {
    let plain = compiled("VIEW").camera;
    assert_eq!((plain.eye, plain.look_at, plain.up), (DVec3::new(0.0, 0.0, 4.0), DVec3::ZERO, DVec3::Y));
    assert_eq!((plain.fov, plain.projection, plain.lens, plain.shutter), (40.0, Projection::Perspective, None, None));
    assert_eq!((plain.filter, plain.resolution), (Filter::Box, [8, 8]));
    let scene = compiled(
        "camera = { eye = [1, 2, 3], look_at = [4, 5, 6], up = [0, 0, 2], fov = 50, resolution = [7, 9], projection = 'perspective', \
         lens = { radius = 0.25, focus = 3.5 }, shutter = [0.25, 0.75], filter.gaussian.sigma = 0.625, \
         motion = [{ translate = [1, 2, 3] }] }",
    );
    let camera = scene.camera;
    assert_eq!(
        [camera.eye, camera.look_at, camera.up].map(|p| p.to_array()),
        [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [0.0, 0.0, 2.0]]
    );
    assert_eq!((camera.fov, camera.resolution), (50.0, [7, 9]));
    assert_eq!(camera.lens, Some(Lens { radius: 0.25, focus: 3.5 }));
    assert_eq!(camera.shutter, Some(Shutter { open: 0.25, close: 0.75 }));
    assert_eq!(camera.filter, Filter::gaussian(0.625));
    assert_eq!(scene.camera_motion.at(0.5).translation, DVec3::new(0.5, 1.0, 1.5));
    let flat =
        compiled("camera = { eye = [0, 0, 4], look_at = [0, 0, 0], projection.orthographic.width = 3, resolution = [8, 8] }");
    assert_eq!((flat.camera.projection, flat.camera.width_at_look_at()), (Projection::orthographic(3.0), 3.0));
    let filter = |text: &str| {
        let camera = "eye = [0, 0, 4], look_at = [0, 0, 0], fov = 40, resolution = [8, 8]";
        compiled(&format!("camera = {{ {camera}, lens = {{ radius = 0, focus = 1 }}, filter = {text} }}")).camera
    };
    assert_eq!(filter("'tent'").filter, Filter::tent(1.0));
    assert_eq!(filter("'gaussian'").filter, Filter::gaussian(0.5));
    assert_eq!(filter("{ tent = { radius = 2.5 } }").filter, Filter::tent(2.5));
    assert_eq!(filter("'box'").lens, None, "a lens without extent is a pinhole");
}

#[test]
fn settings() {
    let plain = compiled("VIEW");
    assert_eq!((plain.settings, plain.spp, plain.reference), (Default::default(), None, None));
    let scene = compiled(
        "VIEW\n[render]\nestimator = 'light'\ndirections = 'cosine'\nsampler = 'bluenoise'\nmax_bounces = 3\n\
         roulette = { throughput = { start = 7 } }\nreuse = 'off'\nadaptive = true\nspp = 12\nseed = 99\n[reference]\nradiance = [1, 2, 3]",
    );
    let settings = scene.settings;
    assert_eq!(
        (settings.estimator, settings.directions, settings.sampler),
        (Estimator::Light, Directions::Cosine, Sampler::BlueNoise)
    );
    assert_eq!((settings.max_bounces, settings.roulette), (Some(3), Roulette::by_throughput_from(7)));
    assert_eq!((settings.reuse, settings.adaptive, settings.seed, scene.spp), (Reuse::Off, true, 99, Some(12)));
    assert_eq!(scene.reference, Some(SceneReference::Radiance([1.0, 2.0, 3.0])));
    let roulette = |text: &str| compiled(&format!("VIEW\nrender.roulette = {text}")).settings.roulette;
    assert_eq!(roulette("'off'"), Roulette::Off);
    assert_eq!([roulette("'throughput'"), roulette("{ throughput = {} }")], [Roulette::by_throughput_from(4); 2]);
    assert_eq!(roulette("{ fixed = 0.25 }"), Roulette::fixed(0.25));
}

#[test]
fn materials() {
    let material = |text: &str| instance(text).material;
    let grey = Textured::grey(0.5);
    let rgb = Textured::Constant([0.1, 0.2, 0.3]);
    assert_eq!(material("lambertian.albedo = [0.1, 0.2, 0.3]"), Lambertian { albedo: rgb.clone() }.into());
    assert_eq!(material("mirror.reflectance = 0.5"), Mirror { reflectance: grey.clone() }.into());
    let glass = Dielectric {
        ior: 1.5,
        ior_outside: 1.0,
        roughness: Roughness::SMOOTH,
        anisotropy: 0.0,
        tangent_rotation: 0.0,
        transmittance: [1.0; 3],
        specular_reflectance: Textured::grey(1.0),
        specular_transmittance: Textured::grey(1.0),
        energy_compensation: true,
        ..Dielectric::default()
    };
    assert_eq!(material("dielectric.ior = 1.5"), glass.into());
    let nested = instance(
        "dielectric = { ior = 1.25, ior_outside = 1.75, roughness = 0.5, transmittance = [0.1, 0.2, 0.3], energy_compensation = false }",
    );
    let rough = Dielectric {
        ior: 1.25,
        ior_outside: 1.75,
        roughness: Roughness::Roughness(Textured::Constant(0.5)),
        anisotropy: 0.0,
        tangent_rotation: 0.0,
        transmittance: [0.1, 0.2, 0.3],
        energy_compensation: false,
        ..Dielectric::default()
    };
    assert_eq!((nested.material, nested.compiled.inside), (rough.into(), Some([0.1, 0.2, 0.3])));
    assert_eq!(nested.compiled.alpha, AlphaSource::Constant(0.25));
    let gold = Reflectance::Index { eta: [0.1, 0.2, 0.3], k: [3.0, 2.0, 1.0], tint: Textured::grey(1.0) };
    assert_eq!(
        material("conductor = { eta = [0.1, 0.2, 0.3], k = [3, 2, 1], alpha = 0.5 }"),
        Conductor { fresnel: gold, roughness: Roughness::alpha(0.5), energy_compensation: true, ..Conductor::default() }.into()
    );
    let steel = |fresnel| {
        Material::from(Conductor { fresnel, roughness: Roughness::SMOOTH, energy_compensation: false, ..Conductor::default() })
    };
    assert_eq!(material("conductor = { f0 = 0.5, energy_compensation = false }"), steel(Reflectance::Schlick(grey.clone())));
    assert_eq!(material("conductor = { reflectance = 0.5, energy_compensation = false }"), steel(Reflectance::Constant(grey)));
    let plastic = instance("plastic = { albedo = [0.1, 0.2, 0.3], ior = 1.25, roughness = 0.1 }");
    let roughness = Roughness::Roughness(Textured::Constant(0.1));
    assert_eq!(plastic.material, Plastic { albedo: rgb, ior: 1.25, roughness }.into());
    assert_eq!(plastic.compiled.alpha, AlphaSource::Constant(0.1f32 * 0.1));
    let sides = |text: &str| instance(&format!("lambertian.albedo = 0.5\n{text}")).one_sided;
    assert_eq!([sides(""), sides("two_sided = true"), sides("two_sided = false")], [false, false, true]);
    let is_plain = |two_sided: bool| {
        let ball = "[[objects]]\nshape.sphere = { center = [0, 0, 0], radius = 1.0 }\nmaterial =";
        let [a, b] = ["a", "b"].map(|name| format!("[materials.{name}]\nlambertian.albedo = 0.5"));
        compiled(&format!("VIEW\n{a}\n{b}\ntwo_sided = {two_sided}\n{ball} 'a'\n{ball} 'b'")).is_plain()
    };
    assert!(is_plain(true) && !is_plain(false), "one surface that reflects from one side is enough");
    assert_eq!(instance("lambertian.albedo = 0.5").compiled.inside, None);
}

#[test]
fn textured_materials() {
    let scene = compiled(
        "VIEW\ntextures.t.checker = { even = 0.25, odd = [0.5, 0.75, 0.125], scale = 2.0 }
        materials.m = { conductor = { f0 = { texture = 't' }, roughness = { texture = 't' } }, bump = { texture = 't', height = -0.5 } }
        [[objects]]
        shape.sphere = { center = [0, 0, 0], radius = 1.0 }
        material = 'm'
        emission = { texture = 't', scale = 4.0 }",
    );
    let object = &scene.objects[0];
    let instance = scene.material(object).expect("it has a material");
    let mean = [0.375, 0.5, 0.1875];
    let Some((texture, height)) = instance.bump else { panic!("{instance:?}") };
    assert_eq!((height, instance.normal_map), (-0.5, None));
    assert_eq!(instance.compiled.colour, ColourSource::Texture(texture));
    assert_eq!(instance.compiled.alpha, AlphaSource::Texture { id: texture, squared: true });
    // The square root of the largest luminance of the texture is well above the limit of smooth surfaces.
    assert_eq!((instance.compiled.stage, scene.textures.mean(texture)), (Stage::Conductor, mean));
    let emission = object.emission.expect("it emits");
    assert_eq!((emission.radiance, emission.mean, emission.texture), ([4.0; 3], mean.map(|x| 4.0 * x), Some(texture)));
}

#[test]
fn lights() {
    let light =
        |rest: &str| object(&format!("shape.sphere = {{ center = [0, 0, 0], radius = 1 }}\n{rest}")).emission.expect("it emits");
    let plain = light("emission.radiance = [1, 2, 3]");
    assert_eq!((plain.radiance, plain.mean, plain.texture, plain.side), ([1.0, 2.0, 3.0], [1.0, 2.0, 3.0], None, Side::Front));
    assert_eq!(light("emission = { radiance = [1, 2, 3], scale = 2.5 }").radiance, [2.5, 5.0, 7.5]);
    assert_eq!(light("emission = { radiance = 1, two_sided = true }").side, Side::Both);
    assert_eq!(light("emission = { radiance = 1 }\nflip = true").side, Side::Back);
    assert!(matches!(
        compiled("VIEW\nenvironment.radiance = [1, 2, 3]").lights.environment,
        Some(Environment::Constant(ConstantRadiance([1.0, 2.0, 3.0])))
    ));
    assert!(compiled("VIEW\nenvironment.radiance = 0").lights.environment.is_none());
}

#[test]
fn skies() {
    // One of eight columns is bright. The centre of the image, between the fourth and the fifth column, is towards −z.
    let folder = tempfile::tempdir().expect("a folder");
    let pixels: Vec<u8> =
        (0..8).flat_map(|column| if column == 4 { [128, 128, 128, 129] } else { [128, 128, 128, 122] }).collect();
    fs::write(folder.path().join("sky.hdr"), [b"#?RADIANCE\n\n-Y 1 +X 8\n".as_slice(), &pixels].concat()).expect("it is written");
    let name = folder.path().join("sky.toml").display().to_string();
    let radiance = |rest: &str, degrees: f64| {
        let view = "camera = { eye = [0, 0, 4], look_at = [0, 0, 0], fov = 40, resolution = [8, 8] }";
        let text = format!("format = 1\n{view}\nenvironment = {{ image = 'sky.hdr'{rest} }}");
        let scene = parse(&name, text).unwrap_or_else(|error| panic!("{}", error.report()));
        let Some(Environment::Image(sky)) = &scene.lights.environment else { panic!("it is an image") };
        let (sin, cos) = degrees.to_radians().sin_cos();
        // From −z towards −x, which is counter-clockwise seen from above.
        sky.radiance(One, V { x: F(-sin as f32), y: F(0.0), z: F(-cos as f32) }).x.0
    };
    let close = |a: f32, b: f32| assert!((a - b).abs() < 1e-4 * b, "{a} is not {b}");
    close(radiance("", -22.5), 1.0);
    close(radiance(", rotate = 90.0", 67.5), 1.0);
    close(radiance(", rotate = -720030.0", -52.5), 1.0);
    close(radiance(", rotate = 1.8e20", -22.5 + 1.8e20 % 360.0), 1.0);
    close(radiance(", scale = 3.0", -22.5), 3.0);
    close(radiance(", scale = 3.0", 157.5), 3.0 / 128.0);
}

#[test]
fn objects_and_their_transforms() {
    let plain = object("shape.sphere = { center = [1, 2, 3], radius = 0.5 }");
    assert_eq!((plain.name.as_str(), plain.flip, plain.motion.0.len(), plain.emission), ("", false, 0, None));
    assert!(plain.material.is_none() && plain.shape.bounding_sphere() == (DVec3::new(1.0, 2.0, 3.0), 0.5));
    let center = |list: &str| {
        object(&format!("shape.sphere = {{ center = [1, 2, 3], radius = 0.5 }}\ntransform = [{list}]")).shape.bounding_sphere().0
    };
    let near = |list: &str, p: [f64; 3]| assert!(center(list).distance(DVec3::from(p)) < 1e-12, "{list}: {}", center(list));
    near("{ translate = [1, 0, 0] }, { scale = 2 }", [4.0, 4.0, 6.0]);
    near("{ scale = 2 }, { translate = [1, 0, 0] }", [3.0, 4.0, 6.0]);
    near("{ rotate = { axis = [0, 5, 0], degrees = 90 } }", [3.0, 2.0, -1.0]);
    near("{ rotate = { axis = [0, 1, 0], degrees = 15099494490 } }", [3.0, 2.0, -1.0]);
    near("{ matrix = [[0, 1, 0, 7], [2, 0, 0, 8], [0, 0, 1, 9], [0, 0, 0, 1]] }", [9.0, 10.0, 12.0]);
    let scaled = object("shape.sphere = { center = [0, 0, 0], radius = 1 }\ntransform = [{ scale = [1, 2, 3] }]");
    assert!((scaled.shape.bounding_sphere().1 - 3.0).abs() < 1e-5);
    let moving = object(
        "shape.sphere = { center = [1, 0, 0], radius = 1 }\nmotion = [{ rotate = { axis = [0, 1, 0], degrees = 90 } }, { translate = [0, 4, 0] }]",
    );
    let there = moving.motion.at(0.5).transform_point3(DVec3::X);
    assert!(there.distance(DVec3::new(0.5f64.sqrt(), 2.0, -(0.5f64.sqrt()))) < 1e-12, "{there}");
}

#[test]
fn shapes_and_their_defaults() {
    let cylinder = "shape.cylinder = { base = [0, 0, 0], top = [0, 2, 0], radius = 1";
    let capped = |rest: &str| match object(&format!("{cylinder}{rest} }}")).shape {
        Shape::Cylinder { capped, .. } => capped,
        _ => panic!("no cylinder"),
    };
    assert_eq!([capped(""), capped(", capped = true"), capped(", capped = false")], [true, true, false]);
    let smooth = |mesh: &str| match object(&format!("shape.mesh = {{ {mesh} }}")).shape {
        Shape::Mesh { data, .. } => !data.normals.is_empty(),
        _ => panic!("no mesh"),
    };
    let lists = "vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles = [[0, 1, 2]]";
    assert_eq!([smooth(lists), smooth(&format!("{lists}, smooth = true"))], [false, true]);
    assert_eq!([smooth("knot = { triangles = 50 }"), smooth("knot = { triangles = 50 }, smooth = false")], [true, false]);
    assert_eq!([smooth("heightfield = { quads = 2 }"), smooth("heightfield = { quads = 2 }, smooth = false")], [true, false]);
    let heights = |seed: &str| match object(&format!("shape.mesh = {{ heightfield = {{ quads = 2{seed} }} }}")).shape {
        Shape::Mesh { data, .. } => data.vertices.clone(),
        _ => panic!("no mesh"),
    };
    assert_eq!(heights(""), heights(", seed = 0"));
    assert_ne!(heights(""), heights(", seed = 1"));
    let field = |rest: &str| {
        let text = format!(
            "VIEW\n[[objects]]\nname = 'drop'\nshape.sphere_field = {{ count = 12, bounds = {{ min = [1, 1, 1], max = [2, 3, 4] }}{rest} }}"
        );
        compiled(&text).objects.iter().map(|object| (object.name.clone(), object.shape.bounding_sphere())).collect::<Vec<_>>()
    };
    assert_eq!((field("").len(), field("")[0].0.as_str(), field("")[11].0.as_str()), (12, "drop 1", "drop 12"));
    assert_eq!(field(""), field(", seed = 0"));
    assert_ne!(field(""), field(", seed = 1"));
    let inside = |p: DVec3| p.cmpgt(DVec3::ONE).all() && p.cmplt(DVec3::new(2.0, 3.0, 4.0)).all();
    assert!(field("").iter().all(|(_, (center, _))| inside(*center)));
}

#[test]
fn meshes_that_are_made_alike_are_one() {
    let is_shared = |one: &str, other: &str| {
        let scene = compiled(&format!("VIEW\n[[objects]]\nshape.mesh = {{ {one} }}\n[[objects]]\nshape.mesh = {{ {other} }}"));
        let [Shape::Mesh { data: one, .. }, Shape::Mesh { data: other, .. }] = [&scene.objects[0].shape, &scene.objects[1].shape]
        else {
            panic!("no mesh")
        };
        Arc::ptr_eq(one, other)
    };
    let (knot, hills) = ("knot = { triangles = 50 }", "heightfield = { quads = 2, seed = 1 }");
    assert!(is_shared(knot, knot) && is_shared(hills, hills) && !is_shared(knot, hills));
    assert!(!is_shared(knot, "knot = { triangles = 60 }") && !is_shared(knot, &format!("{knot}, smooth = false")));
    assert!(
        !is_shared(hills, "heightfield = { quads = 2, seed = 2 }") && !is_shared(hills, "heightfield = { quads = 3, seed = 1 }")
    );
}

#[test]
fn pictures_of_colours_go_through_the_curve_of_srgb_and_normal_maps_do_not() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/assets/bricks_normal.png");
    let scene = compiled(&format!(
        "VIEW\ntextures.a.image.path = '{path}'\ntextures.b.image = {{ path = '{path}', encoding = 'linear' }}
        materials.m = {{ lambertian.albedo = 0.5, normal_map = '{path}' }}
        [[objects]]
        shape.sphere = {{ center = [0, 0, 0], radius = 1 }}
        material = 'm'"
    ));
    let map = scene.material(&scene.objects[0]).and_then(|material| material.normal_map).expect("it has one");
    let [colours, numbers, normals] = [0, 1, map].map(|id| scene.textures.mean(id)[0]);
    // Means of the red channel of all pixels, by an independent reader.
    assert!((colours - 0.225_73).abs() < 1e-4 && (numbers - 0.501_63).abs() < 1e-4, "{colours} {numbers}");
    assert_eq!(normals, numbers);
}

#[test]
fn lights_come_first_and_pieces_know_their_objects() {
    let scene = compiled(
        "VIEW
        [[objects]]
        name = 'box'
        shape.cuboid = { min = [0, 0, 0], max = [1, 1, 1] }
        [[objects]]
        name = 'light'
        shape.cuboid = { min = [5, 0, 0], max = [6, 1, 1] }
        emission.radiance = 1.0
        [[objects]]
        name = 'ball'
        shape.sphere = { center = [9, 0, 0], radius = 1.0 }",
    );
    let names: Vec<&str> = scene.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["light", "box", "ball"]);
    let pieces = scene.objects.iter().map(|object| object.shape.piece_count());
    let owners: Vec<u32> = pieces.enumerate().flat_map(|(i, count)| vec![i as u32; count]).collect();
    assert_eq!(scene.owners, owners);
}

#[test]
fn the_size_of_a_scene_is_that_of_its_near_objects() {
    let ball =
        |x: f64, radius: f64| format!("[[objects]]\nshape.sphere = {{ center = [{x:?}, 0.0, 0.0], radius = {radius:?} }}\n");
    let size = |objects: &[String]| compiled(&format!("VIEW\n{}", objects.concat())).size;
    assert_eq!(size(&[]), 4.0, "the distance that is looked over");
    assert_eq!(size(&[ball(5.0, 1.0)]), 12.0);
    assert_eq!(size(&[ball(5.0, 1.0), ball(0.0, 1000.0)]), 12.0, "a sun is no part of it");
    assert_eq!(size(&[ball(90.0, 1.0)]), 40.0, "ten times the distance at most");
}

#[test]
fn warnings() {
    let shells = |count: usize, tint: &str| {
        let shell = |i: usize| {
            format!("[[objects]]\nshape.sphere = {{ center = [0, 0, 0], radius = {}.0 }}\nmaterial = 'glass'\n", i + 1)
        };
        let glass = format!("materials.glass.dielectric = {{ ior = 1.5{tint} }}\n");
        compiled(&format!("VIEW\nenvironment.radiance = 1.0\n{glass}{}", (0..count).map(shell).collect::<String>()))
            .warnings()
            .to_vec()
    };
    assert_eq!(shells(5, ", transmittance = 0.5"), ["5 media are nested: only the innermost 4 are tinted"]);
    assert_eq!((shells(4, ", transmittance = 0.5").len(), shells(9, "").len()), (0, 0));
    let moving = |shutter: &str| {
        let view = format!("camera = {{ eye = [0, 0, 4], look_at = [0, 0, 0], fov = 40, resolution = [8, 8]{shutter} }}");
        let ball = "[[objects]]\nshape.sphere = { center = [0, 0, 0], radius = 1 }\nemission.radiance = 1\nmotion = [{ translate = [1, 0, 0] }]";
        compiled(&format!("{view}\nenvironment.radiance = 1\n{ball}")).warnings().to_vec()
    };
    assert_eq!(moving("").len(), 1);
    assert_eq!((moving(", shutter = [0, 0]").len(), moving(", shutter = [0, 1]").len()), (0, 0));
    assert_eq!(compiled("VIEW").warnings().len(), 2, "no light, no objects");
}

#[test]
fn closed_shapes_tell_inside_from_outside() {
    let cube = "mesh = { vertices = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], \
        triangles = [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4], [3, 7, 6], [3, 6, 2], [0, 4, 7], [0, 7, 3], \
        [1, 2, 6], [1, 6, 5]] }";
    let shapes = [
        "cuboid = { min = [0, 0, 0], max = [1, 1, 1] }",
        cube,
        "isosurface = { expression = 'max(abs(x - 0.5), abs(y - 0.5), abs(z - 0.5)) - 0.5', bounds = { min = [-1, -1, -1], max = [2, 2, 2] } }",
    ];
    for shape in shapes {
        for (list, scale) in [("", 1.0), ("transform = [{ scale = 2 }]", 2.0), ("transform = [{ scale = -2 }]", -2.0)] {
            let object = object(&format!("shape.{shape}\n{list}"));
            for (p, inside) in [
                ([0.5, 0.5, 0.5], true),
                ([0.1, 0.9, 0.2], true),
                ([1.1, 0.5, 0.5], false),
                ([0.5, -0.2, 0.5], false),
                ([0.9, 0.9, 1.3], false),
            ] {
                assert_eq!(object.shape.contains(scale * DVec3::from(p)), inside, "{shape}, {list}, {p:?}");
            }
        }
    }
    let holds = |shape: &str, p: [f64; 3]| object(&format!("shape.{shape}")).shape.contains(DVec3::from(p));
    let cylinder = "cylinder = { base = [0, 0, 0], top = [0, 2, 0], radius = 1 }";
    assert!(holds(cylinder, [0.6, 1.9, 0.6]) && !holds(cylinder, [0.8, 1.0, 0.8]) && !holds(cylinder, [0.0, 2.1, 0.0]));
    let ball = "sphere = { center = [1, 0, 0], radius = 1 }";
    assert!(holds(ball, [1.9, 0.0, 0.0]) && !holds(ball, [-0.1, 0.0, 0.0]));
    assert!(!holds("disk = { center = [0, 0, 0], normal = [0, 1, 0], radius = 1 }", [0.0, 0.0, 0.0]));
}
