//! Lights of pbrt.
use glam::DVec3;

use super::{SceneFolder, error, imported, remarks, world};
use crate::import::Imported;
use noisefall_scene::light::{emission::EmissionSource, environment::EnvironmentDescription, punctual_light::PunctualLightKind};

fn radiance(found: &Imported) -> [f64; 3] {
    let emission = found.description.objects[0].emission.as_ref().expect("it emits");
    match &emission.source {
        EmissionSource::Radiance(constant) => constant.radiance,
        other => panic!("{other:?} is not constant"),
    }
}

fn near(found: [f64; 3], expected: [f64; 3]) -> bool {
    found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= 1e-6 * b.abs().max(1.0))
}

#[test]
fn rgb_light_has_its_radiance_and_spectra_have_luminance_1() {
    let light = |parameters: &str| radiance(&world(&format!("AreaLightSource \"diffuse\" {parameters}\nShape \"sphere\"")));
    assert!(near(light("\"rgb L\" [1 2 3] \"float scale\" 2"), [2.0, 4.0, 6.0]));
    assert!(near(light(""), [1.0; 3]));
    for spectrum in ["\"blackbody L\" 4000", "\"spectrum L\" [400 7 700 9]", "\"spectrum L\" \"stdillum-F11\""] {
        let [r, g, b] = light(spectrum);
        let luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        assert!((luminance - 1.0).abs() < 0.02, "{spectrum}: {luminance}");
    }
}

#[test]
fn power_is_spread_over_the_area() {
    let sphere = world("Scale 2 2 2\nAreaLightSource \"diffuse\" \"float power\" 100\nShape \"sphere\" \"float radius\" 1.5");
    let expected = 100.0 / (std::f64::consts::PI * 4.0 * std::f64::consts::PI * 9.0);
    assert!(near(radiance(&sphere), [expected; 3]), "{:?}", radiance(&sphere));
    let square = "\"point3 P\" [0 0 0 2 0 0 2 2 0 0 2 0] \"integer indices\" [0 1 2 0 2 3]";
    let mesh =
        world(&format!("AreaLightSource \"diffuse\" \"float power\" 6 \"bool twosided\" true\nShape \"trianglemesh\" {square}"));
    // Each triangle of 2 m² emits the power, on both sides.
    assert!(near(radiance(&mesh), [6.0 / (std::f64::consts::PI * 2.0 * 2.0); 3]), "{:?}", radiance(&mesh));
}

#[test]
fn the_film_multiplies_all_light() {
    let found = imported(
        "Film \"rgb\" \"float iso\" 200 \"float exposuretime\" .25\nWorldBegin\nLightSource \"infinite\" \"rgb L\" [1 2 4]\n\
         LightSource \"infinite\" \"rgb L\" [1 1 1] \"float scale\" 3",
    );
    let Some(EnvironmentDescription::Constant(constant)) = &found.description.environment else { panic!("a constant") };
    assert!(near(constant.radiance, [2.0, 2.5, 3.5]), "{:?}", constant.radiance);
}

#[test]
fn lights_stand_where_the_file_puts_them() {
    let found = world(
        "Translate 0 0 1\nLightSource \"point\" \"rgb I\" [1 2 3] \"float scale\" 10 \"point3 from\" [1 0 0]\n\
         LightSource \"spot\" \"point3 from\" [0 5 0] \"point3 to\" [0 0 0] \"float coneangle\" 40 \"float conedeltaangle\" 10\n\
         LightSource \"distant\" \"point3 from\" [0 1 0] \"point3 to\" [0 0 0] \"float illuminance\" 7",
    );
    let [point, spot, distant] = &found.description.punctual_lights[..] else { panic!("three lights") };
    let PunctualLightKind::Point(point) = &point.kind else { panic!("a point") };
    assert!(near(point.intensity, [10.0, 20.0, 30.0]) && point.position == DVec3::new(1.0, 0.0, 1.0));
    let PunctualLightKind::Spot(spot) = &spot.kind else { panic!("a spot") };
    assert_eq!((spot.angle, spot.inner, spot.target), (40.0, 30.0, DVec3::new(0.0, 0.0, 1.0)));
    let PunctualLightKind::Directional(sun) = &distant.kind else { panic!("a sun") };
    assert!(near(sun.irradiance, [7.0; 3]) && sun.direction == DVec3::NEG_Y);
    assert!(remarks(&found).is_empty());
}

#[test]
fn black_lights_are_left_out_with_a_remark() {
    for light in [
        "LightSource \"point\" \"rgb I\" [0 0 0]",
        "LightSource \"spot\" \"float scale\" 0",
        "LightSource \"distant\" \"rgb L\" [0 0 0]",
        "LightSource \"infinite\" \"rgb L\" [0 0 0]",
        "AreaLightSource \"diffuse\" \"rgb L\" [0 0 0]\nShape \"sphere\"",
        "AreaLightSource \"diffuse\" \"float scale\" 0\nShape \"sphere\"",
    ] {
        let found = world(light);
        let lines = remarks(&found).join("\n");
        assert!(found.description.punctual_lights.is_empty() && lines.contains("it is black"), "{light}: {lines}");
        assert!(found.description.objects.iter().all(|object| object.emission.is_none()), "{light}");
    }
    let black = pfm([0.0; 3]);
    for light in [
        "LightSource \"infinite\" \"string filename\" \"t.pfm\"",
        "LightSource \"projection\" \"string filename\" \"t.pfm\"",
        "LightSource \"goniometric\" \"string filename\" \"t.pfm\"",
        "AreaLightSource \"diffuse\" \"string filename\" \"t.pfm\"\nShape \"sphere\"",
    ] {
        let found = with_picture(light, &black);
        let lines = remarks(&found).join("\n");
        let lit = found.description.objects.iter().any(|object| object.emission.is_some());
        assert!(found.description.punctual_lights.is_empty() && !lit && lines.contains("it is black"), "{light}: {lines}");
    }
}

/// A PFM of 1 × 1 pixel.
fn pfm(pixel: [f32; 3]) -> Vec<u8> {
    [b"PF\n1 1\n-1\n".to_vec(), pixel.iter().flat_map(|x| x.to_le_bytes()).collect()].concat()
}

/// A world beside an image `t.pfm`.
fn with_picture(text: &str, picture: &[u8]) -> Imported {
    let files = SceneFolder::new(&[("a.pbrt", &format!("WorldBegin\n{text}"))]);
    std::fs::write(files.0.path().join("t.pfm"), picture).expect("it is written");
    files.read().unwrap_or_else(|error| panic!("{}", error.report()))
}

#[test]
fn images_may_be_pfm() {
    let light = "LightSource \"projection\" \"string filename\" \"t.pfm\" \"float scale\" 3";
    let found = with_picture(light, &pfm([1.0, 2.0, 3.0]));
    assert!(
        matches!(&found.description.punctual_lights[0].kind, PunctualLightKind::Projector(punctual_light) if punctual_light.image == "t.pfm" && punctual_light.scale == 3.0)
    );
    let texture = "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"t.pfm\"\nMaterial \"diffuse\" \"texture reflectance\" \"t\"";
    let found = with_picture(&format!("{texture}\nShape \"sphere\""), &pfm([0.1, 0.2, 0.3]));
    assert!(found.description.textures.len() == 1 && remarks(&found).is_empty(), "{:?}", remarks(&found));
}

#[test]
fn errors_have_their_places() {
    assert!(error("WorldBegin\n  LightSource \"sun\"").contains("a.pbrt:2:3"));
    assert!(error("WorldBegin\nLightSource \"infinite\" \"string filename\" \"/etc/passwd\"").contains("absolute"));
    assert!(error("WorldBegin\nLightSource \"infinite\" \"string filename\" \"no.exr\"").contains("no such file"));
}
