//! Cameras and films.
use glam::DVec3;

use super::{refused, remarks, scene};
use noisefall_scene::{
    sampling::{Filter, Sampler},
    scene::Projection,
};

fn near(a: DVec3, b: DVec3) -> bool {
    a.abs_diff_eq(b, 1e-9)
}

#[test]
fn the_camera_looks_along_z_with_y_up() {
    let camera = scene("<sensor type=\"perspective\"><float name=\"fov\" value=\"50\"/></sensor>").description.camera;
    assert!(near(camera.eye, DVec3::ZERO) && near(camera.look_at, DVec3::Z) && camera.up.is_some_and(|up| near(up, DVec3::Y)));
    assert_eq!((camera.resolution, camera.filter), ([768, 576], Filter::GAUSSIAN));
    assert!(camera.fov.is_some_and(|fov| (fov - 50.0).abs() < 1e-9));
    let text = "<sensor type=\"perspective\"><transform name=\"to_world\">\
        <lookat origin=\"0,-5,1\" target=\"0,0,1\" up=\"0,0,1\"/></transform></sensor>";
    let camera = scene(text).description.camera;
    assert!(near(camera.eye, DVec3::new(0.0, -5.0, 1.0)) && near(camera.look_at, DVec3::new(0.0, -4.0, 1.0)));
    assert!(camera.up.is_some_and(|up| near(up, DVec3::Z)));
}

#[test]
fn without_an_angle_the_lens_has_fifty_millimetres() {
    let text = "<sensor type=\"perspective\"><film type=\"hdrfilm\"><integer name=\"width\" value=\"48\"/>\
        <integer name=\"height\" value=\"48\"/></film></sensor>";
    let fov = scene(text).description.camera.fov.expect("it has an angle");
    let across = 2.0 * (0.5 * 36f64.hypot(24.0) / 50.0 / 2f64.sqrt()).atan().to_degrees();
    assert!((fov - across).abs() < 1e-9 && (33.0..35.0).contains(&fov), "{fov}");
}

#[test]
fn parallel_rays_cover_the_scale_of_the_transform_and_begin_at_the_near_plane() {
    let text = "<sensor type=\"orthographic\"><float name=\"near_clip\" value=\"1\"/><transform name=\"to_world\">\
        <scale x=\"1.5\" y=\"1.5\"/><lookat origin=\"-5,0,3\" target=\"0,0,3\" up=\"0,0,1\"/></transform></sensor>";
    let imported = scene(text);
    let camera = &imported.description.camera;
    assert!(near(camera.eye, DVec3::new(-4.0, 0.0, 3.0)) && near(camera.look_at, DVec3::new(-3.0, 0.0, 3.0)));
    assert_eq!((camera.projection, camera.fov), (Projection::orthographic(3.0), None));
    assert!(imported.remarks.is_empty());
}

#[test]
fn clip_planes_are_remarked_on_unless_they_are_those_of_mitsuba() {
    let text = |near: f64, far: f64| {
        format!(
            "<sensor type=\"perspective\"><float name=\"near_clip\" value=\"{near}\"/><float name=\"far_clip\" value=\"{far}\"/></sensor>"
        )
    };
    assert!(scene(&text(0.01, 1e4)).remarks.is_empty());
    assert_eq!(scene(&text(0.1, 50.0)).remarks.len(), 2);
}

#[test]
fn a_lens_keeps_its_radius_and_distance() {
    let text = "<sensor type=\"thinlens\"><float name=\"aperture_radius\" value=\"0.1\"/>\
        <float name=\"focus_distance\" value=\"3\"/></sensor>";
    let lens = scene(text).description.camera.lens.expect("it has a lens");
    assert_eq!((lens.radius, lens.focus), (0.1, 3.0));
}

#[test]
fn a_crop_narrows_the_view_and_shifts_it() {
    let film = |offset: u32| {
        format!(
            "<sensor type=\"perspective\"><float name=\"fov\" value=\"90\"/><film type=\"hdrfilm\">\
             <integer name=\"width\" value=\"100\"/><integer name=\"height\" value=\"80\"/>\
             <integer name=\"crop_width\" value=\"50\"/><integer name=\"crop_height\" value=\"80\"/>\
             <integer name=\"crop_offset_x\" value=\"{offset}\"/><rfilter type=\"tent\"/></film></sensor>"
        )
    };
    let camera = scene(&film(25)).description.camera;
    assert_eq!((camera.resolution, camera.filter), ([50, 80], Filter::TENT));
    assert!(camera.fov.is_some_and(|fov| (fov - 2.0 * 0.5f64.atan().to_degrees()).abs() < 1e-9));
    assert_eq!(camera.shift, [0.0, 0.0]);
    let imported = scene(&film(40));
    let camera = &imported.description.camera;
    assert_eq!((camera.resolution, camera.shift, remarks(&imported).len()), ([50, 80], [0.3, 0.0], 0));
}

#[test]
fn a_principal_point_shifts_the_image() {
    let text = "<sensor type=\"perspective\"><float name=\"principal_point_offset_x\" value=\"0.25\"/>\
        <float name=\"principal_point_offset_y\" value=\"0.5\"/><film type=\"hdrfilm\"><integer name=\"width\" value=\"100\"/>\
        <integer name=\"height\" value=\"50\"/></film></sensor>";
    // Mitsuba 3.9 shows the scene a quarter of the width to the left, and half of the height up.
    assert_eq!(scene(text).description.camera.shift, [0.25, -0.25]);
}

#[test]
fn samplers_have_counterparts_but_for_the_default_of_mitsuba() {
    let sampler = |kind: &str| scene(&format!("<sensor type=\"perspective\"><sampler type=\"{kind}\"/></sensor>"));
    let found = ["independent", "stratified", "ldsampler"].map(|kind| sampler(kind).description.render.settings.sampler);
    assert_eq!(found, [Sampler::Sobol, Sampler::Stratified, Sampler::Sobol]);
}

#[test]
fn impossible_cameras_are_refused() {
    assert!(refused("<sensor type=\"irradiancemeter\"/>").contains("irradiancemeter"));
    assert!(refused("<sensor type=\"perspective\"><float name=\"fov\" value=\"200\"/></sensor>").contains("180"));
    let flat = "<sensor type=\"perspective\"><transform name=\"to_world\"><scale x=\"0\"/></transform></sensor>";
    assert!(refused(flat).contains("flattens"));
}
