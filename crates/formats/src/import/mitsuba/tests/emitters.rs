//! Lights, environments and surfaces that emit.
use glam::DVec3;

use super::{SENSOR, object, read_with, remarks, scene};
use crate::import::ImportOptions;
use noisefall_scene::{
    light::{
        environment::sky::SkyModel,
        punctual_light::{PunctualLightKind, spot::Falloff},
    },
    material::Material,
    scene::description::{EmissionSource, EnvironmentDescription, TextureKind, Textured},
    shape::product,
};

fn punctual_light(emitter: &str) -> PunctualLightKind {
    scene(&format!("{SENSOR}{emitter}")).description.punctual_lights.remove(0).kind
}

#[test]
fn points_and_directions_shine() {
    let PunctualLightKind::Point(point) = punctual_light(
        "<emitter type=\"point\"><point name=\"position\" x=\"-5\" y=\"-6.0\" z=\"0.0\"/>\
        <rgb name=\"intensity\" value=\"300\"/></emitter>",
    ) else {
        panic!("not a point")
    };
    assert_eq!((point.position, point.intensity), (DVec3::new(-5.0, -6.0, 0.0), [300.0; 3]));
    let PunctualLightKind::Directional(sun) = punctual_light(
        "<emitter type=\"directional\"><vector name=\"direction\" value=\"0,0,-2\"/>\
        <rgb name=\"irradiance\" value=\"1.0\"/></emitter>",
    ) else {
        panic!("not a direction")
    };
    assert_eq!((sun.direction, sun.irradiance), (DVec3::NEG_Z, [1.0; 3]));
}

#[test]
fn spots_fall_linearly_from_their_beam_to_their_cutoff() {
    let PunctualLightKind::Spot(spot) = punctual_light(
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
    let PunctualLightKind::Projector(projector) = punctual_light(
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
    let PunctualLightKind::Projector(projector) = &imported.description.punctual_lights[0].kind else {
        panic!("not a projector")
    };
    assert_eq!((projector.scale, projector.tint), (4.0, [1.0, 0.5, 0.25]));
    assert_eq!((projector.angle, projector.inner, projector.fov, projector.aspect), (25.0, 18.75, 50.0, 1.0));
    assert_eq!((projector.up, projector.flat), (DVec3::NEG_Y, false));
}

#[test]
fn shapes_emit_from_their_front() {
    let punctual_light = object(
        "<shape type=\"rectangle\"><emitter type=\"area\"><rgb name=\"radiance\" value=\"0.2, 0.4, 0.6\"/></emitter></shape>",
    );
    let emission = punctual_light.emission.expect("it emits");
    assert!(matches!(emission.source, EmissionSource::Radiance(r) if r.radiance == [0.2, 0.4, 0.6]) && !emission.two_sided);
    let spectrum = object(
        "<shape type=\"sphere\"><emitter type=\"area\">\
        <spectrum name=\"radiance\" value=\"400:0, 500:8, 600:15.6, 700:18.4\"/></emitter></shape>",
    );
    let Some(EmissionSource::Radiance(light)) = spectrum.emission.map(|emission| emission.source) else { panic!("not constant") };
    // The colour of this light in Mitsuba's own image of it, `arealight`.
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
fn environments_are_constant_images_or_skies() {
    let environment = |emitter: &str| {
        let text = format!("<scene version=\"3.0.0\">{emitter}</scene>");
        let imported = read_with(&[("sky.exr", "")], &text, &ImportOptions::default()).expect("it is valid");
        imported.description.environment.expect("it has a background")
    };
    let plain = environment("<emitter type=\"constant\"/>");
    assert!(matches!(plain, EnvironmentDescription::Constant(c) if c.radiance == [1.0; 3]));
    let sky = "<emitter type=\"envmap\"><string name=\"filename\" value=\"sky.exr\"/><float name=\"scale\" value=\"0.5\"/>\
        <transform name=\"to_world\"><rotate x=\"1\" angle=\"90\"/></transform></emitter>";
    let EnvironmentDescription::Image(image) = environment(sky) else { panic!("not an image") };
    assert_eq!((image.path.as_str(), image.rotate, image.scale), ("sky.exr", 180.0, 0.5));
    let turned = product(&image.transform).expect("it is valid").transform_vector3(DVec3::Y);
    assert!(turned.abs_diff_eq(DVec3::Z, 1e-12), "{turned}");
    let sky = environment(
        "<emitter type=\"sunsky\"><vector name=\"sun_direction\" value=\"1, 0, 1\"/><float name=\"sun_scale\" value=\"0\"/></emitter>",
    );
    let EnvironmentDescription::Sky(sky) = sky else { panic!("not a sky") };
    assert_eq!((sky.sun_scale, sky.turbidity, sky.model, sky.zenith), (0.0, 3.0, SkyModel::Hosek, DVec3::Z));
    assert!(sky.sun.x > 0.7 && sky.ground_albedo == [0.3; 3] && sky.sun_diameter.is_none());
    let upright = "<emitter type=\"sunsky\"><rgb name=\"albedo\" value=\"0.1, 0.2, 0.6\"/><float name=\"sun_aperture\" value=\"5\"/>\
        <transform name=\"to_world\"><rotate x=\"1\" angle=\"-90\"/></transform></emitter>";
    let EnvironmentDescription::Sky(sky) = environment(upright) else { panic!("not a sky") };
    assert!(sky.zenith.abs_diff_eq(DVec3::Y, 1e-12) && sky.sun.y > 0.7, "{} {}", sky.zenith, sky.sun);
    assert_eq!((sky.ground_albedo, sky.sun_diameter), ([0.1, 0.2, 0.6], Some(5.0)));
}

#[test]
fn lights_without_a_bsdf_reflect_nothing() {
    let area = "<emitter type=\"area\"/>";
    let punctual_light = |within: &str| object(&format!("<shape type=\"sphere\">{within}</shape>"));
    assert!(punctual_light(area).material.is_none() && punctual_light(area).emission.is_some());
    assert!(punctual_light(&format!("<bsdf type=\"diffuse\"/>{area}")).material.is_some());
    assert!(punctual_light("<emitter type=\"directionalarea\"/>").material.is_none());
    assert!(punctual_light("").material.is_some());
}

#[test]
fn shapes_refer_to_emitters_that_stand_elsewhere() {
    let punctual_light = "<emitter type=\"area\" id=\"light\"><rgb name=\"radiance\" value=\"3\"/></emitter>";
    let imported = scene(&format!(
        "{SENSOR}{punctual_light}<shape type=\"sphere\"><ref id=\"light\"/></shape><shape type=\"disk\"><ref id=\"light\"/></shape>"
    ));
    let of = |index: usize| imported.description.objects[index].emission.clone().map(|emission| emission.source);
    for index in [0, 1] {
        assert!(matches!(of(index), Some(EmissionSource::Radiance(r)) if r.radiance == [3.0; 3]));
    }
    assert!(imported.remarks.is_empty(), "{:?}", remarks(&imported));
    assert!(remarks(&scene(&format!("{SENSOR}{punctual_light}")))[0].contains("nothing"));
}

#[test]
fn emitters_without_light_are_left_out() {
    let black = |name: &str| format!("<rgb name=\"{name}\" value=\"0\"/>");
    let texture = format!("<texture name=\"radiance\" type=\"checkerboard\">{}{}</texture>", black("color0"), black("color1"));
    let emitters = [
        format!("<emitter type=\"point\">{}</emitter>", black("intensity")),
        format!("<emitter type=\"spot\">{}</emitter>", black("intensity")),
        format!("<emitter type=\"directional\">{}</emitter>", black("irradiance")),
        format!("<emitter type=\"projector\">{}</emitter>", black("irradiance")),
        format!("<emitter type=\"constant\">{}</emitter>", black("radiance")),
        "<emitter type=\"sunsky\"><float name=\"sun_scale\" value=\"0\"/><float name=\"sky_scale\" value=\"0\"/></emitter>"
            .to_owned(),
        format!("<shape type=\"sphere\"><emitter type=\"area\">{}</emitter></shape>", black("radiance")),
        format!("<shape type=\"sphere\"><emitter type=\"area\">{texture}</emitter></shape>"),
    ];
    for emitter in emitters {
        let imported = scene(&format!("{SENSOR}{emitter}"));
        let description = &imported.description;
        let emits = description.objects.iter().any(|object| object.emission.is_some());
        assert!(description.punctual_lights.is_empty() && description.environment.is_none() && !emits, "{emitter}");
        assert!(remarks(&imported).len() == 1 && remarks(&imported)[0].contains("nothing"), "{emitter}");
    }
    let pixels = crate::import::pictures::exr(2, 1, &[[0.0; 3]; 2]).expect("it is encoded");
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("black.exr"), pixels).expect("it is written");
    let file = "<string name=\"filename\" value=\"black.exr\"/>";
    let text = format!(
        "<scene version=\"3.0.0\">{SENSOR}<emitter type=\"envmap\">{file}</emitter><shape type=\"sphere\"><emitter type=\"area\">\
         <texture name=\"radiance\" type=\"bitmap\">{file}</texture></emitter></shape></scene>"
    );
    std::fs::write(folder.path().join("scene.xml"), text).expect("it is written");
    let imported = crate::import::read(&folder.path().join("scene.xml"), &ImportOptions::default()).expect("it is valid");
    assert!(imported.description.environment.is_none() && imported.description.objects[0].emission.is_none());
    assert_eq!(imported.remarks.len(), 2);
}

#[test]
fn sheared_images_of_the_sky_are_resampled() {
    let folder = tempfile::tempdir().expect("a folder");
    let sky = crate::import::pictures::exr(4, 2, &[[0.5; 3]; 8]).expect("it is encoded");
    std::fs::write(folder.path().join("sky.exr"), sky).expect("it is written");
    let environment = |transform: &str| {
        let text = format!(
            "<scene version=\"3.0.0\"><emitter type=\"envmap\"><string name=\"filename\" value=\"sky.exr\"/>\
             <transform name=\"to_world\">{transform}</transform></emitter></scene>"
        );
        std::fs::write(folder.path().join("scene.xml"), text).expect("it is written");
        let imported = crate::import::read(&folder.path().join("scene.xml"), &ImportOptions::default()).expect("it is valid");
        let Some(EnvironmentDescription::Image(image)) = imported.description.environment else { panic!("not an image") };
        (image, imported.remarks.len())
    };
    // A scene without a sensor has one remark.
    for turned in ["<rotate y=\"1\" angle=\"40\"/>", "<scale x=\"-1\"/>", "<scale value=\"3\"/>"] {
        assert!(matches!(environment(turned), (image, 1) if image.path == "sky.exr"), "{turned}");
    }
    for sheared in ["<scale y=\"2\"/>", "<matrix value=\"1 0.5 0 0 0 1 0 0 0 0 1 0 0 0 0 1\"/>"] {
        let (image, count) = environment(sheared);
        assert!(count == 2 && image.path == "textures/sky.exr" && image.transform.is_empty() && image.pole_rows, "{sheared}");
    }
}

/// A scene beside `a.exr`, an image of one colour.
fn with_image(colour: [f32; 3], within: &str) -> crate::import::Imported {
    let folder = tempfile::tempdir().expect("a folder");
    let image = crate::import::pictures::exr(2, 1, &[colour; 2]).expect("it is encoded");
    std::fs::write(folder.path().join("a.exr"), image).expect("it is written");
    std::fs::write(folder.path().join("scene.xml"), format!("<scene version=\"3.0.0\">{SENSOR}{within}</scene>"))
        .expect("it is written");
    crate::import::read(&folder.path().join("scene.xml"), &ImportOptions::default()).expect("it is valid")
}

#[test]
fn images_above_1_are_limited_where_they_are_fractions_and_not_where_they_are_light() {
    let bitmap =
        |name: &str| format!("<texture name=\"{name}\" type=\"bitmap\"><string name=\"filename\" value=\"a.exr\"/></texture>");
    let surfaces = [
        format!("<bsdf type=\"mask\">{}<bsdf type=\"diffuse\"/></bsdf>", bitmap("opacity")),
        format!("<bsdf type=\"blendbsdf\">{}<bsdf type=\"diffuse\"/><bsdf type=\"conductor\"/></bsdf>", bitmap("weight")),
        format!("<bsdf type=\"diffuse\">{}</bsdf>", bitmap("reflectance")),
        format!("<bsdf type=\"principled\">{}</bsdf>", bitmap("metallic")),
    ];
    for surface in &surfaces {
        let shape = format!("<shape type=\"rectangle\">{surface}</shape>");
        let count = |colour: [f32; 3]| with_image(colour, &shape).assets.paths().count();
        assert_eq!((count([0.5, 1.0, 0.0]), count([0.5, 3.0, 0.0])), (0, 1), "{surface}");
        assert_eq!(remarks(&with_image([2.0; 3], &shape)).len(), 1, "{surface}");
    }
    let punctual_light = format!("<shape type=\"sphere\"><emitter type=\"area\">{}</emitter></shape>", bitmap("radiance"));
    assert!(with_image([2.0; 3], &punctual_light).assets.is_empty());
    let heights =
        format!("<shape type=\"rectangle\"><bsdf type=\"bumpmap\">{}<bsdf type=\"diffuse\"/></bsdf></shape>", bitmap(""));
    assert!(with_image([2.0; 3], &heights).assets.is_empty());
    let squares = "<shape type=\"sphere\"><emitter type=\"area\"><texture name=\"radiance\" type=\"checkerboard\" id=\"c\">\
        <rgb name=\"color0\" value=\"5\"/></texture></emitter></shape>";
    let imported = scene(&format!("{SENSOR}{squares}"));
    assert!(matches!(&imported.description.textures["c"], TextureKind::Checker(squares) if squares.even == Textured::grey(5.0)));
    assert!(imported.remarks.is_empty());
}

#[test]
fn widths_that_vary_apart_are_mixed_of_a_few() {
    let bitmap =
        |name: &str| format!("<texture name=\"{name}\" type=\"bitmap\"><string name=\"filename\" value=\"a.exr\"/></texture>");
    let metal = |values: &str| format!("<shape type=\"rectangle\"><bsdf type=\"roughconductor\">{values}</bsdf></shape>");
    // One image for both keeps highlights round.
    let round = with_image(
        [0.3; 3],
        &metal("<ref name=\"alpha_u\" id=\"t\"/><ref name=\"alpha_v\" id=\"t\"/>")
            .replace("<shape", "<texture id=\"t\" type=\"bitmap\"><string name=\"filename\" value=\"a.exr\"/></texture><shape"),
    );
    assert!(round.remarks.is_empty() && round.description.materials.len() == 1);
    // An image of one value is a number.
    let even = with_image([0.3; 3], &metal(&format!("{}<float name=\"alpha_v\" value=\"0.1\"/>", bitmap("alpha_u"))));
    let found = even.description.materials.values().next().expect("there is one");
    assert!(matches!(&found.kind, Material::Conductor(metal) if (metal.anisotropy - 2.0 / 3.0).abs() < 1e-6), "{found:?}");
    let squares = "<texture name=\"alpha_v\" type=\"checkerboard\"><float name=\"color0\" value=\"0.1\"/>\
        <float name=\"color1\" value=\"0.4\"/></texture><float name=\"alpha_u\" value=\"0.2\"/>";
    let imported = scene(&format!("{SENSOR}{}", metal(squares)));
    let name = imported.description.objects[0].material.clone().expect("it has one");
    let Material::Blend(blend) = &imported.description.materials[&name].kind else { panic!("not a mixture") };
    let widths = [&blend.first, &blend.second].map(|name| match &imported.description.materials[name].kind {
        Material::Conductor(metal) => (metal.anisotropy, metal.tangent_rotation),
        other => panic!("{other:?}"),
    });
    // Where Mitsuba looks up a number, it exchanges the squares.
    assert!(widths.iter().all(|(anisotropy, _)| (anisotropy - 0.5).abs() < 1e-6) && [widths[0].1, widths[1].1] == [90.0, 0.0]);
    assert_eq!(imported.remarks.len(), 1);
}
