//! Lamps, backgrounds and surfaces that emit.
use glam::DVec3;

use super::{SENSOR, object, read_with, remarks, scene};
use crate::{
    import::ImportOptions,
    light::{
        background::sky::SkyModel,
        lamp::{LampKind, spot::Falloff},
    },
    scene::description::{BackgroundDescription, EmissionSource},
    shape::product,
};

fn lamp(emitter: &str) -> LampKind {
    scene(&format!("{SENSOR}{emitter}")).description.lamps.remove(0).kind
}

#[test]
fn points_and_directions_shine() {
    let LampKind::Point(point) = lamp(
        "<emitter type=\"point\"><point name=\"position\" x=\"-5\" y=\"-6.0\" z=\"0.0\"/>\
        <rgb name=\"intensity\" value=\"300\"/></emitter>",
    ) else {
        panic!("not a point")
    };
    assert_eq!((point.position, point.intensity), (DVec3::new(-5.0, -6.0, 0.0), [300.0; 3]));
    let LampKind::Directional(sun) = lamp(
        "<emitter type=\"directional\"><vector name=\"direction\" value=\"0,0,-2\"/>\
        <rgb name=\"irradiance\" value=\"1.0\"/></emitter>",
    ) else {
        panic!("not a direction")
    };
    assert_eq!((sun.direction, sun.irradiance), (DVec3::NEG_Z, [1.0; 3]));
}

#[test]
fn spots_fall_linearly_from_their_beam_to_their_cutoff() {
    let LampKind::Spot(spot) = lamp(
        "<emitter type=\"spot\"><float name=\"cutoff_angle\" value=\"30\"/><transform name=\"to_world\">\
        <lookat origin=\"0, 3, 0\" target=\"0, 0, 0\" up=\"0, 0, 1\"/></transform></emitter>",
    ) else {
        panic!("not a spot")
    };
    assert_eq!((spot.angle, spot.inner, spot.falloff, spot.intensity), (30.0, 22.5, Falloff::Linear, [1.0; 3]));
    assert!(spot.target.abs_diff_eq(DVec3::new(0.0, 2.0, 0.0), 1e-12), "{}", spot.target);
}

#[test]
fn projectors_shine_pi_times_their_irradiance() {
    let LampKind::Projector(projector) = lamp(
        "<emitter type=\"projector\"><float name=\"scale\" value=\"2\"/>\
        <rgb name=\"irradiance\" value=\"1\"/><float name=\"fov\" value=\"40\"/></emitter>",
    ) else {
        panic!("not a projector")
    };
    assert!((projector.scale - std::f64::consts::TAU).abs() < 1e-12 && (projector.fov - 40.0).abs() < 1e-9);
    assert_eq!((projector.target, projector.up, projector.image.as_str()), (DVec3::Z, DVec3::Y, "textures/projector.exr"));
}

#[test]
fn spots_with_a_picture_are_projectors_with_a_cone() {
    let text = "<scene version=\"3.0.0\"><emitter type=\"spot\"><rgb name=\"intensity\" value=\"4, 2, 1\"/><float name=\"cutoff_angle\" value=\"25\"/>\
        <texture name=\"texture\" type=\"bitmap\"><string name=\"filename\" value=\"squares.png\"/></texture></emitter></scene>";
    let imported = read_with(&[("squares.png", "")], text, &ImportOptions::default()).expect("it is valid");
    let LampKind::Projector(projector) = &imported.description.lamps[0].kind else { panic!("not a projector") };
    assert_eq!((projector.scale, projector.tint), (4.0, [1.0, 0.5, 0.25]));
    assert_eq!((projector.angle, projector.inner, projector.fov, projector.aspect), (25.0, 18.75, 50.0, 1.0));
    assert_eq!((projector.up, projector.flat), (DVec3::NEG_Y, false));
}

#[test]
fn shapes_emit_from_their_front() {
    let lamp = object(
        "<shape type=\"rectangle\"><emitter type=\"area\"><rgb name=\"radiance\" value=\"0.2, 0.4, 0.6\"/></emitter></shape>",
    );
    let emission = lamp.emission.expect("it emits");
    assert!(matches!(emission.source, EmissionSource::Radiance(r) if r.radiance == [0.2, 0.4, 0.6]) && !emission.two_sided);
    let spectrum = object(
        "<shape type=\"sphere\"><emitter type=\"area\">\
        <spectrum name=\"radiance\" value=\"400:0, 500:8, 600:15.6, 700:18.4\"/></emitter></shape>",
    );
    let Some(EmissionSource::Radiance(light)) = spectrum.emission.map(|emission| emission.source) else { panic!("not constant") };
    // The colour of this lamp in Mitsuba's own picture of it, `arealight`.
    let [r, g, b] = light.radiance;
    assert!((r / g / 1.908 - 1.0).abs() < 0.003 && (b / g / 0.2553 - 1.0).abs() < 0.003, "{:?}", light.radiance);
    let textured = object(
        "<shape type=\"sphere\"><emitter type=\"area\">\
        <texture name=\"radiance\" type=\"checkerboard\" id=\"squares\"/></emitter></shape>",
    );
    assert!(matches!(textured.emission.map(|e| e.source), Some(EmissionSource::Texture(t)) if t.name == "squares"));
    assert!(!textured.transform.is_empty(), "the sphere carries coordinates");
}

#[test]
fn emission_in_one_direction_is_reported() {
    let imported = scene(&format!("{SENSOR}<shape type=\"rectangle\"><emitter type=\"directionalarea\"/></shape>"));
    assert!(imported.description.objects[0].emission.is_none() && remarks(&imported)[0].contains("directionalarea"));
}

#[test]
fn backgrounds_are_constant_images_or_skies() {
    let background = |emitter: &str| {
        let text = format!("<scene version=\"3.0.0\">{emitter}</scene>");
        let imported = read_with(&[("sky.exr", "")], &text, &ImportOptions::default()).expect("it is valid");
        imported.description.background.expect("it has a background")
    };
    let plain = background("<emitter type=\"constant\"/>");
    assert!(matches!(plain, BackgroundDescription::Constant(c) if c.radiance == [1.0; 3]));
    let sky = "<emitter type=\"envmap\"><string name=\"filename\" value=\"sky.exr\"/><float name=\"scale\" value=\"0.5\"/>\
        <transform name=\"to_world\"><rotate x=\"1\" angle=\"90\"/></transform></emitter>";
    let BackgroundDescription::Image(image) = background(sky) else { panic!("not an image") };
    assert_eq!((image.path.as_str(), image.rotate, image.scale), ("sky.exr", 180.0, 0.5));
    let turned = product(&image.transform).expect("it is valid").transform_vector3(DVec3::Y);
    assert!(turned.abs_diff_eq(DVec3::Z, 1e-12), "{turned}");
    let sky = background(
        "<emitter type=\"sunsky\"><vector name=\"sun_direction\" value=\"1, 0, 1\"/><float name=\"sun_scale\" value=\"0\"/></emitter>",
    );
    let BackgroundDescription::Sky(sky) = sky else { panic!("not a sky") };
    assert_eq!((sky.sun_scale, sky.turbidity, sky.model, sky.zenith), (0.0, 3.0, SkyModel::Hosek, DVec3::Z));
    assert!(sky.sun.x > 0.7 && sky.ground_albedo == [0.3; 3] && sky.sun_diameter.is_none());
    let upright = "<emitter type=\"sunsky\"><rgb name=\"albedo\" value=\"0.1, 0.2, 0.6\"/><float name=\"sun_aperture\" value=\"5\"/>\
        <transform name=\"to_world\"><rotate x=\"1\" angle=\"-90\"/></transform></emitter>";
    let BackgroundDescription::Sky(sky) = background(upright) else { panic!("not a sky") };
    assert!(sky.zenith.abs_diff_eq(DVec3::Y, 1e-12) && sky.sun.y > 0.7, "{} {}", sky.zenith, sky.sun);
    assert_eq!((sky.ground_albedo, sky.sun_diameter), ([0.1, 0.2, 0.6], Some(5.0)));
}
