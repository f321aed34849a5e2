//! Materials, textures and lights.
use std::f64::consts::SQRT_2;

use glam::DVec3;

use super::round_trip;
use crate::{
    export::round_trip::{self as scene_files, RoundTrip, scenes},
    import::pictures,
};
use noisefall_base::declare::{Assets, Textured};
use noisefall_scene::{
    image::Encoding,
    light::{
        emission::radiance::Radiance,
        punctual_light::{
            PunctualLightKind,
            directional::Directional,
            point::Point,
            spot::{Falloff, Spot},
        },
    },
    material::{
        Conductor, Dielectric, Lambertian, Material, Reflectance, Roughness, mirror::Mirror, null::Null, principled::Principled,
    },
    scene::description::{EmissionDescription, MaterialDescription, PunctualLightDescription, SceneDescription, TextureKind},
    shape::{Sphere, cuboid::Cuboid},
    texture::{
        checker::Checker,
        image::{Channel, Image, TexelFilter, Wrap},
        product::Product,
        ramp::{Ramp, Stop},
    },
};

/// A material that comes back, and the remarks.
fn of(material: MaterialDescription) -> (MaterialDescription, Vec<String>) {
    let (trip, material) = with(material, &SceneDescription::default(), &Assets::default());
    (material, trip.remarks)
}

/// A material that comes back from a scene with textures, and the round trip.
fn with(material: MaterialDescription, scene: &SceneDescription, assets: &Assets) -> (RoundTrip, MaterialDescription) {
    let mut scene = scene.clone();
    scene.materials.insert("m".to_owned(), material);
    scene.add_object("box", Cuboid::default()).material = Some("m".to_owned());
    scene.camera.resolution = [1280, 960];
    let trip = round_trip(&scene, assets);
    let material = trip.imported.description.materials["m"].clone();
    (trip, material)
}

fn plain(kind: impl Into<Material>) -> MaterialDescription {
    MaterialDescription { kind: kind.into(), ..MaterialDescription::default() }
}

fn texture<T>(name: &str) -> Textured<T> {
    Textured::Texture(name.to_owned())
}

const HALF: Textured<f64> = Textured::Constant(0.5);
const QUARTER: Textured<f64> = Textured::Constant(0.25);
const ONE: Textured<f64> = Textured::Constant(1.0);
const COLOR: Textured = Textured::Constant([1.0, 0.5, 0.25]);

#[test]
fn principled_materials_come_back() {
    let usual = Principled::default;
    let clear = Principled { transmission_weight: ONE, base_color: Textured::grey(1.0), ..usual() };
    let cases = [
        usual(),
        Principled { base_color: COLOR, base_metalness: HALF, specular_roughness: QUARTER, specular_ior: 1.75, ..usual() },
        Principled { specular_weight: HALF, specular_color: COLOR, ..usual() },
        Principled { base_color: COLOR, transmission_color: COLOR, ..clear.clone() },
        Principled { base_color: COLOR, transmission_color: COLOR, transmission_weight: HALF, ..clear.clone() },
        Principled { base_color: COLOR, transmission_color: COLOR, thin_walled: true, ..clear.clone() },
        Principled { transmission_color: COLOR, transmission_depth: 2.0, specular_roughness: HALF, ..clear.clone() },
        Principled {
            coat_weight: HALF,
            coat_roughness: QUARTER,
            coat_ior: 1.5,
            coat_darkening: Textured::Constant(0.0),
            ..usual()
        },
        Principled { thin_film_weight: HALF, thin_film_thickness: QUARTER, thin_film_ior: 1.25, ..usual() },
    ];
    for case in cases {
        let (found, remarks) = of(plain(case.clone()));
        assert_eq!(found, plain(case));
        assert_eq!(remarks, [""; 0]);
    }
    let fuzz = Principled { fuzz_weight: HALF, fuzz_color: COLOR, fuzz_roughness: QUARTER, ..usual() };
    assert_eq!(of(plain(fuzz.clone())), (plain(fuzz), vec!["the fuzz".to_owned()]));
}

#[test]
fn anisotropy_comes_back_up_to_rounding() {
    let case = Principled {
        specular_roughness: HALF,
        specular_roughness_anisotropy: Textured::Constant(0.75),
        tangent_rotation: 30.0,
        ..Principled::default()
    };
    let (found, remarks) = of(plain(case));
    let Material::Principled(found) = found.kind else { panic!("it is principled") };
    let near = |found: &Textured<f64>, expected: f64| matches!(found, Textured::Constant(x) if (x - expected).abs() < 1e-9);
    assert!(near(&found.specular_roughness, 0.5) && near(&found.specular_roughness_anisotropy, 0.75), "{found:?}");
    assert!((found.tangent_rotation - 30.0).abs() < 1e-9 && remarks.is_empty(), "{remarks:?}");
}

#[test]
fn other_kinds_become_principled() {
    let metal = Principled {
        base_metalness: ONE,
        specular_roughness: Textured::Constant(0.0),
        base_color: COLOR,
        ..Principled::default()
    };
    let white = Principled { base_color: Textured::grey(1.0), ..metal.clone() };
    let diffuse = Principled {
        base_color: COLOR,
        specular_weight: Textured::Constant(0.0),
        specular_roughness: ONE,
        ..Principled::default()
    };
    let glass = Principled {
        base_color: Textured::grey(1.0),
        specular_roughness: Textured::Constant(0.0),
        specular_ior: 1.75,
        transmission_weight: ONE,
        ..Principled::default()
    };
    let tinted = Principled { transmission_color: COLOR, transmission_depth: 1.0, ..glass.clone() };
    let rough = Roughness::Alpha(Textured::Constant(0.25));
    let cases: [(Material, Principled); 5] = [
        (Lambertian { albedo: COLOR }.into(), diffuse),
        (Mirror { reflectance: Textured::grey(1.0) }.into(), white),
        (
            Conductor { fresnel: Reflectance::Schlick(COLOR), roughness: rough, ..Conductor::default() }.into(),
            Principled { specular_roughness: HALF, ..metal },
        ),
        (Dielectric { ior: 3.5, ior_outside: 2.0, ..Dielectric::default() }.into(), glass),
        (Dielectric { ior: 1.75, transmittance: [1.0, 0.5, 0.25], ..Dielectric::default() }.into(), tinted),
    ];
    for (case, expected) in cases {
        let (found, remarks) = of(MaterialDescription { opacity: Some(HALF), ..plain(case) });
        assert_eq!(found, MaterialDescription { opacity: Some(HALF), ..plain(expected) });
        assert_eq!(remarks, [""; 0]);
    }
    let (found, _) = of(MaterialDescription { two_sided: Some(false), ..plain(Lambertian::default()) });
    assert_eq!(found.two_sided, Some(false));
    let (found, _) = of(plain(Null));
    assert_eq!(found.opacity, Some(Textured::Constant(0.0)));
}

/// A PNG with opacity of 2 × 2 pixels.
fn picture() -> Vec<u8> {
    pictures::png(2, 2, &[[255, 0, 10, 255], [0, 60, 70, 80], [9, 8, 7, 0], [200, 100, 50, 128]]).expect("it is encoded")
}

/// A scene with an image of the colours of a file, and others of its channels.
fn textured() -> (SceneDescription, Assets) {
    let mut scene = SceneDescription::default();
    let mut assets = Assets::default();
    assets.insert("textures/paint.png", picture());
    let place = Image {
        path: "textures/paint.png".to_owned(),
        wrap_u: Wrap::Mirror,
        wrap_v: Wrap::Clamp,
        filter: TexelFilter::Nearest,
        scale: [2.0, 3.0],
        offset: [0.25, -0.5],
        ..Image::default()
    };
    let channel = |channel, encoding| Image { channel, encoding, ..place.clone() }.into();
    let all: [(&str, TextureKind); 6] = [
        ("paint", channel(Channel::Rgb, Encoding::Srgb)),
        ("paint alpha", channel(Channel::Alpha, Encoding::Srgb)),
        ("paint green", channel(Channel::Green, Encoding::Linear)),
        ("paint blue", channel(Channel::Blue, Encoding::Linear)),
        ("tinted", Product { a: COLOR, b: texture("paint") }.into()),
        (
            "mask",
            Ramp {
                input: texture("paint alpha"),
                stops: vec![Stop { at: 0.5 - 1e-3, color: [0.0; 3] }, Stop { at: 0.5, color: [1.0; 3] }],
            }
            .into(),
        ),
    ];
    scene.textures.extend(all.map(|(name, kind)| (name.to_owned(), kind)));
    (scene, assets)
}

#[test]
fn images_in_their_channels_are_passed_through() {
    let (scene, assets) = textured();
    let principled = Principled {
        base_color: texture("tinted"),
        specular_roughness: texture("paint green"),
        base_metalness: texture("paint blue"),
        ..Principled::default()
    };
    let material = MaterialDescription { opacity: Some(texture("mask")), ..plain(principled) };
    let (trip, found) = with(material, &scene, &assets);
    assert_eq!(trip.remarks, [""; 0]);
    let theirs = &trip.imported.description;
    let image = |name: &str| match &theirs.textures[name] {
        TextureKind::Image(image) => image.clone(),
        other => panic!("{other:?}"),
    };
    for (name, kind) in scene.textures.iter().filter(|(name, _)| name.starts_with("paint")) {
        let TextureKind::Image(ours) = kind else { panic!("an image") };
        let mut theirs = image(name);
        let path = std::mem::replace(&mut theirs.path, ours.path.clone());
        assert_eq!(theirs, *ours, "{name}");
        assert_eq!(std::fs::read(trip.folder.path().join(path)).expect("it is there"), picture());
    }
    assert_eq!(theirs.textures["product"], Product { a: COLOR, b: texture("paint") }.into());
    let Some(Textured::Texture(ramp)) = &found.opacity else { panic!("a texture") };
    let TextureKind::Ramp(ramp) = &theirs.textures[ramp] else { panic!("a ramp") };
    assert_eq!((&ramp.input, ramp.stops.len(), ramp.stops[1].at), (&texture("paint alpha"), 2, 0.5));
    let Material::Principled(found) = found.kind else { panic!("it is principled") };
    assert_eq!((found.base_metalness, found.specular_roughness), (texture("paint blue"), texture("paint green")));
}

#[test]
fn binary_files_hold_the_bytes_of_images() {
    let (mut scene, assets) = textured();
    scene.materials.insert("m".to_owned(), plain(Lambertian { albedo: texture("paint") }));
    scene.add_object("ball", Sphere::default()).material = Some("m".to_owned());
    let RoundTrip { imported, .. } = scene_files::round_trip(&scene, &assets, &scenes(), "scene.glb");
    let TextureKind::Image(image) = &imported.description.textures["paint"] else { panic!("an image") };
    assert_eq!(*imported.assets.get::<Vec<u8>>(&image.path).expect("it is within"), picture());
}

#[test]
fn channels_in_other_places_are_packed_without_loss() {
    let (scene, assets) = textured();
    let principled = Principled {
        // Each reads a channel that the format has elsewhere.
        specular_roughness: texture("paint blue"),
        base_metalness: texture("paint green"),
        coat_weight: texture("paint green"),
        coat_ior: 1.5,
        coat_darkening: Textured::Constant(0.0),
        ..Principled::default()
    };
    let (trip, found) = with(plain(principled), &scene, &assets);
    assert_eq!(trip.remarks, [""; 0]);
    let Material::Principled(found) = found.kind else { panic!("it is principled") };
    let texels = |number: &Textured<f64>| {
        let Textured::Texture(name) = number else { panic!("a texture") };
        let TextureKind::Image(image) = &trip.imported.description.textures[name] else { panic!("an image") };
        assert_eq!((image.wrap_u, image.scale, image.filter), (Wrap::Mirror, [2.0, 3.0], TexelFilter::Nearest));
        let read = noisefall_scene::image::read(&trip.folder.path().join(&image.path), Encoding::Linear).expect("it is an image");
        let channel = [Channel::Red, Channel::Green, Channel::Blue].iter().position(|c| *c == image.channel).expect("one");
        read.radiance.iter().map(|texel| (255.0 * texel[channel]).round() as u8).collect::<Vec<_>>()
    };
    assert_eq!(texels(&found.specular_roughness), [10, 70, 7, 50]);
    assert_eq!(texels(&found.base_metalness), [0, 60, 8, 100]);
    assert_eq!(texels(&found.coat_weight), [0, 60, 8, 100]);
}

#[test]
fn checkers_become_four_pixels() {
    let mut scene = SceneDescription::default();
    let checker = Checker { even: Textured::grey(1.0), odd: Textured::grey(0.0), scale: 5.0 };
    scene.textures.insert("squares".to_owned(), checker.into());
    let (trip, _) = with(plain(Lambertian { albedo: texture("squares") }), &scene, &Assets::default());
    assert_eq!(trip.remarks, [""; 0]);
    let TextureKind::Image(image) = &trip.imported.description.textures["squares"] else { panic!("an image") };
    assert_eq!((image.scale, image.filter), ([2.5; 2], TexelFilter::Nearest));
    let read = noisefall_scene::image::read(&trip.folder.path().join(&image.path), Encoding::Srgb).expect("it is an image");
    assert_eq!(read.radiance, [[1.0; 3], [0.0; 3], [0.0; 3], [1.0; 3]]);
}

#[test]
fn emission_comes_back() {
    let of = |radiance: [f64; 3], scale| {
        let mut scene = SceneDescription::default();
        let source = Radiance { radiance }.into();
        scene.add_object("light", Sphere::default()).emission = Some(EmissionDescription { source, two_sided: true, scale });
        let RoundTrip { imported, .. } = round_trip(&scene, &Assets::default());
        imported.description.objects[0].emission.clone()
    };
    let expected = |radiance, scale| Some(EmissionDescription { source: Radiance { radiance }.into(), two_sided: true, scale });
    assert_eq!(of([1.0, 0.5, 0.25], 8.0), expected([1.0, 0.5, 0.25], 8.0));
    assert_eq!(of([16.0, 8.0, 2.0], 2.0), expected([1.0, 0.5, 0.125], 32.0));
    assert_eq!(of([0.0; 3], 1.0), None);
}

#[test]
fn lamps_come_back() {
    let position = DVec3::new(1.0, 2.0, 3.0);
    let target = position + DVec3::new(0.0, -SQRT_2, -SQRT_2) / 2.0;
    let spot = Spot { position, target, intensity: [1.0, 2.0, 4.0], angle: 30.0, inner: 15.0, falloff: Falloff::Square };
    let cases: [PunctualLightKind; 3] = [
        Point { position, intensity: [1.0, 2.0, 4.0] }.into(),
        Directional { direction: DVec3::new(0.0, -1.0, 0.0), irradiance: [3.0, 1.5, 0.0] }.into(),
        spot.clone().into(),
    ];
    let punctual_lights =
        cases.iter().map(|kind| PunctualLightDescription { name: "light".to_owned(), kind: kind.clone(), transform: Vec::new() });
    let mut scene = SceneDescription { punctual_lights: punctual_lights.collect(), ..SceneDescription::default() };
    scene.camera.resolution = [1280, 960];
    let RoundTrip { imported, remarks, .. } = round_trip(&scene, &Assets::default());
    let found: Vec<PunctualLightKind> =
        imported.description.punctual_lights.iter().map(|punctual_light| punctual_light.kind.clone()).collect();
    assert_eq!(found[..2], cases[..2]);
    let PunctualLightKind::Spot(back) = &found[2] else { panic!("a spot") };
    assert!((back.target - target).length() < 1e-12 && (back.angle - 30.0).abs() + (back.inner - 15.0).abs() < 1e-12);
    assert_eq!((back.position, back.intensity, back.falloff), (spot.position, spot.intensity, spot.falloff));
    assert_eq!(remarks, [""; 0]);
}
