//! Cameras of pbrt, and the handedness of its world.
use glam::DVec3;

use super::{error, imported, remarks};
use noisefall_scene::{
    sampling::Filter,
    scene::{Estimator, Projection, description::CameraDescription},
    shape::Transform,
};

fn right(camera: &CameraDescription) -> DVec3 {
    (camera.look_at - camera.eye).cross(camera.up.expect("it is given")).normalize()
}

#[test]
fn a_left_handed_camera_mirrors_the_world() {
    let found = imported("LookAt 1 0 5  1 0 0  0 1 0\nCamera \"perspective\"\nWorldBegin\nTranslate 2 3 4\nShape \"sphere\"");
    let camera = &found.description.camera;
    // +x of the file is at the left when it looks along −z in a right-handed world, and at the right in pbrt's.
    assert!(camera.eye.abs_diff_eq(DVec3::new(-1.0, 0.0, 5.0), 1e-12) && right(camera).abs_diff_eq(DVec3::X, 1e-12));
    let Transform::Matrix([x, y, z, _]) = &found.description.objects[0].transform[0] else { panic!("a matrix") };
    assert_eq!([x[3], y[3], z[3]], [-2.0, 3.0, 4.0]);
}

#[test]
fn a_world_of_a_right_handed_program_stays() {
    let found =
        imported("Scale -1 1 1\nLookAt 1 0 5  1 0 0  0 1 0\nCamera \"perspective\"\nWorldBegin\nTranslate 2 3 4\nShape \"disk\"");
    assert!(found.description.camera.eye.abs_diff_eq(DVec3::new(1.0, 0.0, 5.0), 1e-12));
    let Transform::Matrix([x, ..]) = &found.description.objects[0].transform[0] else { panic!("a matrix") };
    assert_eq!(x[3], 2.0);
}

#[test]
fn the_angle_is_that_of_the_shorter_side() {
    let fov = |film: &str, camera: &str| {
        imported(&format!("Film \"rgb\" {film}\nCamera \"perspective\" {camera}")).description.camera.fov.expect("an angle")
    };
    let wide = fov("\"integer xresolution\" 400 \"integer yresolution\" [200]", "\"float fov\" 60");
    assert!((wide - 2.0 * (2.0 * 30f64.to_radians().tan()).atan().to_degrees()).abs() < 1e-9, "{wide}");
    let high = fov("\"integer xresolution\" 200 \"integer yresolution\" 400", "\"float fov\" 60");
    assert!((high - 60.0).abs() < 1e-9, "{high}");
    let half =
        fov("\"integer xresolution\" 100 \"integer yresolution\" 100", "\"float fov\" 90 \"float screenwindow\" [-.5 .5 -.5 .5]");
    assert!((half - 2.0 * 0.5f64.atan().to_degrees()).abs() < 1e-9, "{half}");
}

#[test]
fn lens_projection_and_settings_are_taken_over() {
    let found = imported(
        "Integrator \"bdpt\" \"integer maxdepth\" 17\nSampler \"zsobol\" \"integer pixelsamples\" 128\n\
         PixelFilter \"triangle\" \"float xradius\" 1 \"float yradius\" 1\nScale 0.5 0.5 0.5\n\
         Camera \"perspective\" \"float lensradius\" .1 \"float focaldistance\" 3",
    );
    let description = &found.description;
    assert_eq!((description.render.settings.max_bounces, description.render.spp), (Some(17), Some(128)));
    assert_eq!(description.render.settings.estimator, Estimator::Bidirectional);
    assert!(matches!(description.camera.filter, Filter::Tent(tent) if tent.radius == 1.0));
    let lens = description.camera.lens.expect("a lens");
    assert!((lens.radius - 0.2).abs() < 1e-12 && (lens.focus - 6.0).abs() < 1e-12, "the camera is scaled by 2");
    let parallel = imported("Film \"rgb\" \"integer xresolution\" 200 \"integer yresolution\" 100\nCamera \"orthographic\"");
    assert_eq!(parallel.description.camera.projection, Projection::orthographic(4.0));
}

#[test]
fn defaults_are_those_of_pbrt() {
    let found = imported("WorldBegin");
    let description = &found.description;
    assert_eq!((description.camera.resolution, description.render.spp), ([1280, 720], Some(16)));
    assert_eq!(description.render.settings.max_bounces, Some(5));
    assert!(description.environment.is_some(), "a scene without light gets a sky");
    assert!(remarks(&found).is_empty());
}

#[test]
fn ignored_parameters_are_reported() {
    let found = imported("Film \"rgb\" \"float cropwindow\" [0 .5 0 .5] \"string hue\" \"red\"\nCamera \"spherical\"");
    let lines = remarks(&found).join("\n");
    assert!(lines.contains("cropwindow") && lines.contains("`hue`") && lines.contains("spherical"), "{lines}");
    assert!(error("Camera \"fisheye\"\nWorldBegin").contains("not a camera"));
    assert!(error("Film \"rgb\" \"integer xresolution\" 0\nWorldBegin").contains("xresolution"));
}
