//! Materials and lights that Mitsuba has come back as they were.
use glam::DVec3;

use super::{RoundTrip, round_trip, scenes};
use crate::import::mitsuba::coat;
use noisefall_base::declare::Textured;
use noisefall_scene::{
    light::punctual_light::{
        PunctualLightKind,
        directional::Directional,
        point::Point,
        spot::{Falloff, Spot},
    },
    material::{
        Conductor, Dielectric, Disney, Distribution, Lambertian, Material, Plastic, Reflectance, RoughPlastic, Roughness,
        blend::Blend, null::Null, thin_dielectric::ThinDielectric,
    },
    scene::description::{Bump, MaterialDescription, PunctualLightDescription, SceneDescription, TextureKind},
    shape::Sphere,
    texture::{
        checker::Checker,
        image::{Image, Wrap},
    },
};

fn of(material: MaterialDescription) -> (MaterialDescription, Vec<String>) {
    let mut scene = SceneDescription::default();
    scene.textures.insert("squares".to_owned(), Checker { scale: 6.0, ..Checker::default() }.into());
    let bricks = Image { path: "assets/uv.png".to_owned(), wrap_u: Wrap::Clamp, wrap_v: Wrap::Clamp, ..Image::default() };
    scene.textures.insert("bricks".to_owned(), Image { scale: [2.0, 3.0], offset: [0.25, 0.5], ..bricks }.into());
    scene.add_material("part", Lambertian { albedo: [0.25, 0.5, 0.75].into() });
    scene.materials.insert("paint".to_owned(), material);
    scene.add_object("ball", Sphere::default()).material = Some("paint".to_owned());
    let RoundTrip { imported, remarks, .. } = round_trip(&scene, &scenes());
    if let Some(TextureKind::Checker(squares)) = imported.description.textures.get("squares") {
        let [even, odd] = [&squares.even, &squares.odd].map(|part| match part {
            Textured::Constant([r, ..]) => *r,
            Textured::Texture(name) => panic!("{name}"),
        });
        assert!((even - 0.8).abs() < 1e-9 && (odd - 0.2).abs() < 1e-9, "{even} {odd}");
    }
    let name = imported.description.objects[0].material.clone().expect("it has one");
    (imported.description.materials[&name].clone(), remarks)
}

fn plain(kind: impl Into<Material>) -> MaterialDescription {
    MaterialDescription { kind: kind.into(), ..MaterialDescription::default() }
}

#[test]
fn materials_with_a_plugin_come_back() {
    let alpha = |alpha| Roughness::Alpha(Textured::Constant(alpha));
    let index = Reflectance::Index { eta: [0.25, 0.5, 1.5], k: [3.5, 2.5, 2.0], tint: Textured::Constant([0.5, 1.0, 0.25]) };
    let cases: Vec<MaterialDescription> = vec![
        plain(Lambertian { albedo: [0.1, 0.2, 0.3].into() }),
        plain(Lambertian { albedo: Textured::Texture("squares".to_owned()) }),
        plain(Lambertian { albedo: Textured::Texture("bricks".to_owned()) }),
        plain(Conductor { fresnel: index.clone(), ..Conductor::default() }),
        plain(Conductor { fresnel: index, roughness: alpha(0.25), energy_compensation: false, ..Conductor::default() }),
        plain(Dielectric { ior: 1.75, ior_outside: 1.25, ..Dielectric::default() }),
        plain(Dielectric { roughness: alpha(0.5), energy_compensation: false, ..Dielectric::default() }),
        plain(ThinDielectric { ior: 1.75, ..ThinDielectric::default() }),
        plain(Plastic { ior: 1.5, albedo: [0.2, 0.4, 0.6].into(), ..Plastic::default() }),
        plain(Blend { first: "part".to_owned(), second: "part".to_owned(), weight: Textured::Constant(0.25), by_side: false }),
        plain(Null),
        MaterialDescription { two_sided: Some(false), ..plain(Lambertian::default()) },
        MaterialDescription { opacity: Some(Textured::Texture("squares".to_owned())), ..plain(Lambertian::default()) },
        MaterialDescription {
            bump: Some(Bump { texture: "bricks".to_owned(), height: 0.125 }),
            mirrored_normals: Some(true),
            ..plain(Lambertian::default())
        },
    ];
    for case in cases {
        let (found, remarks) = of(case.clone());
        let smooth = |mut material: MaterialDescription| {
            // The two words for a smooth surface are one.
            if let Material::Conductor(metal) = &mut material.kind {
                metal.energy_compensation &= metal.roughness != Roughness::SMOOTH;
            }
            material
        };
        assert_eq!(smooth(found), smooth(case));
        assert!(remarks.is_empty(), "{remarks:?}");
    }
}

#[test]
fn rough_plastics_of_mitsuba_come_back() {
    for distribution in [Distribution::Ggx, Distribution::Beckmann] {
        let case = RoughPlastic {
            roughness: Roughness::Alpha(Textured::Constant(0.25)),
            distribution,
            specular_reflectance: [0.5, 0.25, 1.0],
            internal_reflectance: coat::internal_reflectance(1.5, 0.25, distribution),
            nonlinear: true,
            ..RoughPlastic::default()
        };
        let (found, remarks) = of(plain(case.clone()));
        assert_eq!(found.kind, case.into());
        assert!(remarks.is_empty(), "{remarks:?}");
    }
}

#[test]
fn disney_comes_back() {
    let half = || Textured::Constant(0.5);
    let squares = || Textured::Texture("squares".to_owned());
    let cases = [
        Disney::default(),
        Disney { base_color: Textured::Texture("squares".to_owned()), metallic: half(), ior: 1.75, ..Disney::default() },
        Disney { anisotropic: half(), sheen: half(), sheen_tint: half(), flatness: half(), ..Disney::default() },
        Disney { spec_trans: half(), spec_tint: half(), clearcoat: squares(), clearcoat_gloss: half(), ..Disney::default() },
    ];
    for case in cases {
        let (found, remarks) = of(plain(case.clone()));
        assert_eq!(found, plain(case));
        assert!(remarks.is_empty(), "{remarks:?}");
    }
}

#[test]
fn tints_and_beckmann_facets_come_back() {
    let glass = Dielectric {
        roughness: Roughness::Alpha(Textured::Constant(0.25)),
        distribution: Distribution::Beckmann,
        specular_reflectance: Textured::Constant([0.5, 0.25, 1.0]),
        specular_transmittance: Textured::Constant([1.0, 0.25, 0.5]),
        energy_compensation: false,
        ..Dielectric::default()
    };
    let pane =
        ThinDielectric { specular_reflectance: [0.5, 0.25, 1.0], specular_transmittance: [0.75; 3], ..ThinDielectric::default() };
    let cases: [Material; 2] = [glass.into(), pane.into()];
    for case in cases {
        let (found, remarks) = of(plain(case.clone()));
        assert_eq!(found.kind, case);
        assert!(remarks.is_empty(), "{remarks:?}");
    }
}

#[test]
fn lights_with_a_plugin_come_back() {
    let position = DVec3::new(1.0, 2.0, 3.0);
    let spot = Spot {
        position,
        target: DVec3::new(1.0, 2.0, 2.0),
        intensity: [1.0, 2.0, 3.0],
        angle: 30.0,
        inner: 15.0,
        falloff: Falloff::Linear,
    };
    let cases: [PunctualLightKind; 3] = [
        Point { position, intensity: [1.0, 2.0, 3.0] }.into(),
        Directional { direction: DVec3::new(0.0, -1.0, 0.0), irradiance: [3.0, 2.0, 1.0] }.into(),
        spot.into(),
    ];
    let punctual_lights =
        cases.iter().map(|kind| PunctualLightDescription { kind: kind.clone(), ..PunctualLightDescription::default() }).collect();
    let scene = SceneDescription { punctual_lights, ..SceneDescription::default() };
    let RoundTrip { imported, remarks, .. } = round_trip(&scene, &scenes());
    let found: Vec<PunctualLightKind> =
        imported.description.punctual_lights.iter().map(|punctual_light| punctual_light.kind.clone()).collect();
    assert_eq!(found, cases);
    assert!(remarks.is_empty(), "{remarks:?}");
}
