//! Vertex colours of meshes, as the view of a triangle whose colour is its barycentric coordinates.
use noisefall_base::math::SimdLevel;
use noisefall_kernel::integrator::{Features, features};
use noisefall_scene::scene::{Estimator, Scene};

use crate::picture::{RED, assert_all_within, picture, scene, settings};

const SIDE: u32 = 64;
/// The corners are red, green and blue.
const TRIANGLE: &str = "v -0.8 -0.8 0 1 0 0\nv 0.8 -0.8 0 0 1 0\nv -0.8 0.8 0 0 0 1\nf 1 2 3\n";

/// A view along −z of two metres; `MESH` stands for the path of the triangle.
fn view(objects: &str) -> Scene {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("triangle.obj");
    std::fs::write(&path, TRIANGLE).expect("it is written");
    scene(&format!(
        "camera = {{ eye = [0, 0, 3], look_at = [0, 0, 0], projection.orthographic.width = 2.0, resolution = [{SIDE}, {SIDE}] }}
        textures.painted.vertex_color = {{}}
        materials.m.lambertian.albedo.texture = 'painted'
        {}",
        objects.replace("MESH", &path.display().to_string())
    ))
}

fn seen(objects: &str) -> Features {
    let scene = view(objects);
    features(SimdLevel::best(), &scene, &scene.camera, &|| false).expect("nobody interrupts")
}

/// The barycentric coordinates of a point of the triangle.
fn barycentrics([x, y, _]: [f32; 3]) -> [f32; 3] {
    let [green, blue] = [(x + 0.8) / 1.6, (y + 0.8) / 1.6];
    [1.0 - green - blue, green, blue]
}

#[test]
fn a_mesh_has_the_interpolated_colors_of_its_vertices() {
    let seen = seen("[[objects]]\nmaterial = 'm'\nshape.mesh.path = 'MESH'");
    let mut compared = 0;
    for pixel in (0..seen.object.len()).filter(|pixel| seen.object[*pixel] == 0) {
        let (found, expected) = (seen.albedo[pixel], barycentrics(seen.position[pixel]));
        assert!((0..3).all(|i| (found[i] - expected[i]).abs() < 1e-4), "pixel {pixel}: {found:?} is not {expected:?}");
        compared += 1;
    }
    assert!(compared > 1000, "only {compared} pixels show the triangle");
}

#[test]
fn instances_keep_their_colors_and_other_shapes_are_white() {
    let seen = seen(
        "[[objects]]\nmaterial = 'm'\nshape.mesh.path = 'MESH'\ntransform = [{ scale = [0.5, 0.5, 1] }, { translate = [-0.5, 0, 0] }]
        [[objects]]\nmaterial = 'm'\nshape.mesh.path = 'MESH'\ntransform = [{ scale = [-0.5, 0.5, 1] }, { translate = [0.5, 0, 0] }]
        [[objects]]\nmaterial = 'm'\nshape.sphere = { center = [0, 0.8, 0], radius = 0.2 }",
    );
    let mut compared = [0; 3];
    for pixel in 0..seen.object.len() {
        let [x, y, z] = seen.position[pixel];
        let expected = match seen.object[pixel] {
            0 => barycentrics([2.0 * (x + 0.5), 2.0 * y, z]),
            1 => barycentrics([-2.0 * (x - 0.5), 2.0 * y, z]),
            2 => [1.0; 3],
            _ => continue,
        };
        let found = seen.albedo[pixel];
        assert!((0..3).all(|i| (found[i] - expected[i]).abs() < 1e-4), "pixel {pixel}: {found:?} is not {expected:?}");
        compared[seen.object[pixel] as usize] += 1;
    }
    assert!(compared.iter().all(|count| *count > 50), "{compared:?}");
}

#[test]
fn a_mesh_emits_in_the_colors_of_its_vertices() {
    let scene = view("[[objects]]\nshape.mesh.path = 'MESH'\nemission.texture = 'painted'");
    let found = picture(&scene, settings(Estimator::Mis), RED, 64);
    let middle = |i: usize| (i as f32 + 0.5) / SIDE as f32 * 2.0 - 1.0;
    let inside = |pixel: usize| {
        let weights = barycentrics([middle(pixel % SIDE as usize), -middle(pixel / SIDE as usize), 0.0]);
        // Color is linear within a pixel, so that its mean is that of the middle.
        weights.iter().all(|weight| *weight > 0.1).then_some(f64::from(weights[0]))
    };
    let deviations: Vec<f64> = found.pixels.iter().enumerate().filter_map(|(i, pixel)| Some(pixel.z(inside(i)?))).collect();
    assert!(deviations.len() > 300, "only {} pixels are inside", deviations.len());
    assert_all_within(&deviations, "red");
}
