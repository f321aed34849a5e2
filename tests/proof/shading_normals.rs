//! Shading normals of bump and normal maps on every shape, compared with normals derived from positions and texture coordinates
//! of pixels.
//!
//! The surface shows its own (u, v) as red and green, so differences of neighbouring pixels give their derivatives.
use std::path::PathBuf;

use glam::{DMat2, DVec2, DVec3, Vec3};
use noisefall_base::math::SimdLevel;
use noisefall_kernel::integrator::{Features, features};
use noisefall_render::render::{Display, Frame, image_file::save};
use noisefall_scene::scene::{Estimator, Scene};

use crate::{
    picture::{LUMINANCE, picture, scene, settings},
    statistics::assert_within,
};

const SIDE: u32 = 96;
/// Texels of the images.
const TEXELS: u32 = 64;
/// Change of u and of v across the image.
const RISE: DVec2 = DVec2::new(0.5, 0.3);
/// Height from black to white, metres.
const HEIGHT: f64 = 0.4;
/// The constant normal of the normal map, before normalisation.
const TILT: DVec3 = DVec3::new(0.5, 0.25, 0.8);

/// Shapes within 1 m of the origin.
const SHAPES: [(&str, &str); 13] = [
    ("sphere", "sphere = { center = [0, 0, 0], radius = 0.9 }"),
    (
        "ellipsoid",
        "sphere = { center = [0, 0, 0], radius = 0.9 } }\ntransform = [{ scale = [0.6, 1.0, 0.8] }, { rotate = { axis = [1, 1, 0], degrees = 30 } }]#",
    ),
    ("mirrored sphere", "sphere = { center = [0, 0, 0], radius = 0.9 } }\ntransform = [{ scale = [-1.0, 1.0, 1.0] }]#"),
    ("cuboid", "cuboid = { min = [-0.6, -0.5, -0.4], max = [0.6, 0.5, 0.4] }"),
    ("cylinder", "cylinder = { base = [0.1, -0.6, 0], top = [-0.1, 0.6, 0.1], radius = 0.5 }"),
    ("disk", "disk = { center = [0, 0, 0], normal = [0.2, 0.3, 1.0], radius = 0.9 }"),
    ("rectangle", "rectangle = { origin = [-0.6, -0.5, 0], edge_u = [1.2, 0, -0.2], edge_v = [0.3, 1.0, 0] }"),
    ("triangle", "triangle = { a = [-0.8, -0.6, 0], b = [0.8, -0.5, 0.2], c = [0.1, 0.8, -0.1] }"),
    (
        "isosurface",
        "isosurface = { expression = 'x^2 + 2*y^2 + 1.5*z^2 - 0.6', bounds = { min = [-0.9, -0.9, -0.9], max = [0.9, 0.9, 0.9] } }",
    ),
    (
        "stretched isosurface",
        "isosurface = { expression = 'x^2 + 2*y^2 + 1.5*z^2 - 0.6', bounds = { min = [-0.9, -0.9, -0.9], max = [0.9, 0.9, 0.9] } } }\ntransform = [{ scale = [1.0, 0.7, -1.0] }, { rotate = { axis = [0, 1, 0], degrees = 170 } }]#",
    ),
    ("mesh", "mesh = { path = 'MESH' }"),
    ("smooth mesh", "mesh = { path = 'SMOOTH' }"),
    (
        "stretched mesh",
        "mesh = { path = 'MESH' } }\ntransform = [{ scale = [1.0, 0.7, -1.0] }, { rotate = { axis = [0, 1, 0], degrees = 170 } }]#",
    ),
];

/// Two triangles with texture coordinates that are rotated and sheared relative to their edges.
const MESH: &str = "v -0.8 -0.7 0\nv 0.8 -0.6 0.1\nv 0.7 0.8 0\nv -0.7 0.6 -0.1\n\
                    vt 0.2 0.1\nvt 0.9 0.3\nvt 0.7 0.9\nvt 0.1 0.6\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";

/// The mesh with vertex normals.
fn smooth_mesh() -> String {
    let (places, _) = MESH.split_once("f ").expect("it has faces");
    format!("{places}vn 0.3 0.1 1\nvn -0.3 0.2 1\nvn -0.2 -0.3 1\nvn 0.2 -0.1 1\nf 1/1/1 2/2/2 3/3/3\nf 1/1/1 3/3/3 4/4/4\n")
}

/// The files that the scenes name.
struct Files {
    folder: tempfile::TempDir,
}

impl Files {
    fn new() -> Files {
        let files = Files { folder: tempfile::tempdir().expect("a folder") };
        for (name, text) in [("mesh.obj", MESH), ("smooth.obj", &smooth_mesh())] {
            std::fs::write(files.path(name), text).expect("it is written");
        }
        files.picture("uv.exr", |at| [at.x, at.y, 0.0]);
        files.picture("height.exr", |at| [RISE.dot(at); 3]);
        let code = TILT.normalize() * 0.5 + 0.5;
        files.picture("tilt.exr", |_| code.to_array());
        files
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// An image of a function of (u, v) at the centres of the texels.
    fn picture(&self, name: &str, colour: impl Fn(DVec2) -> [f64; 3]) {
        let at = |i: u32| (f64::from(i) + 0.5) / f64::from(TEXELS);
        let pixel = |i: u32| colour(DVec2::new(at(i % TEXELS), at(i / TEXELS))).map(|c| c as f32);
        let radiance = (0..TEXELS * TEXELS).map(pixel).collect();
        let frame = Frame { width: TEXELS, height: TEXELS, full_resolution: [TEXELS; 2], radiance, ..Frame::default() };
        save(&frame, Display::default(), "{}", &self.path(name)).expect("it is written");
    }

    /// The view of a shape by parallel rays from (2, 1.5, 3).
    fn seen(&self, shape: &str, material: &str, flip: bool) -> Features {
        let path = |name: &str| self.path(name).display().to_string();
        let shape = shape.replace("MESH", &path("mesh.obj")).replace("SMOOTH", &path("smooth.obj"));
        let scene: Scene = scene(&format!(
            "camera = {{ eye = [1.0, 0.7, 3.0], look_at = [0, 0, 0], projection.orthographic.width = 2.0, resolution = [{SIDE}, {SIDE}] }}
            textures.uv.image = {{ path = '{}', encoding = 'linear' }}
            textures.height.image = {{ path = '{}', encoding = 'linear' }}
            [materials.m]
            lambertian.albedo.texture = 'uv'
            {}
            [[objects]]
            material = 'm'
            flip = {flip}
            shape = {{ {shape} }}",
            path("uv.exr"),
            path("height.exr"),
            material.replace("TILT", &path("tilt.exr")),
        ));
        features(SimdLevel::best(), &scene, &scene.camera, &|| false).expect("nobody interrupts")
    }
}

/// A point of the surface and its derivatives.
struct Place {
    pixel: usize,
    normal: DVec3,
    /// ∂p/∂u and ∂p/∂v.
    along: [DVec3; 2],
    wo: DVec3,
}

/// The pixels inside a smooth piece of surface, away from edges of the texture.
fn places(seen: &Features) -> Vec<Place> {
    let wo = DVec3::new(1.0, 0.7, 3.0).normalize();
    let right = DVec3::Y.cross(wo).normalize();
    let up = wo.cross(right);
    let offset = |at: usize| (at as f64 + 0.5) / f64::from(SIDE) * 2.0 - 1.0;
    let eye = DVec3::new(1.0, 0.7, 3.0);
    let side = SIDE as usize;
    let p = |i: usize| eye + right * offset(i % side) - up * offset(i / side) - wo * f64::from(seen.depth[i]);
    let uv = |i: usize| DVec2::new(seen.albedo[i][0].into(), seen.albedo[i][1].into());
    let normal = |i: usize| Vec3::from(seen.normal[i]).as_dvec3();
    let within = |x: DVec2| x.min_element() > 0.05 && x.max_element() < 0.95;
    let mut all = Vec::new();
    for y in 1..side - 1 {
        for x in 1..side - 1 {
            let i = y * side + x;
            let [left, right, above, below] = [i - 1, i + 1, i - side, i + side];
            let is_smooth = |j: usize| seen.object[j] == 0 && within(uv(j)) && normal(i).dot(normal(j)) > 0.99;
            if ![i, left, right, above, below].into_iter().all(is_smooth) {
                continue;
            }
            let (across, down) = (uv(right) - uv(left), uv(below) - uv(above));
            // A seam between two pieces of a shape.
            if across.length().max(down.length()) > 0.2 {
                continue;
            }
            let steps = DMat2::from_cols(across, down);
            if steps.determinant().abs() < 1e-9 {
                continue;
            }
            let (dx, dy) = (p(right) - p(left), p(below) - p(above));
            let inverse = steps.inverse();
            let along = [DVec2::X, DVec2::Y].map(|axis| {
                let s = inverse * axis;
                dx * s.x + dy * s.y
            });
            all.push(Place { pixel: i, normal: normal(i), along, wo });
        }
    }
    all
}

/// Checks that the normals are those of `exact` wherever they face the viewer.
fn assert_normals(files: &Files, material: &str, flip: bool, exact: impl Fn(&Place) -> DVec3) {
    for (name, shape) in SHAPES {
        let (plain, found) = (files.seen(shape, "", flip), files.seen(shape, material, flip));
        let mut deviations = Vec::new();
        for place in places(&plain) {
            let expected = exact(&place).normalize();
            if expected.dot(place.wo) < 0.1 || place.normal.dot(place.wo) < 0.3 {
                continue;
            }
            let normal = Vec3::from(found.normal[place.pixel]).as_dvec3();
            assert!((normal - place.normal).length() > 0.05, "{name}: the texture changes nothing at {}", place.pixel);
            deviations.push((normal - expected).length());
        }
        deviations.sort_by(f64::total_cmp);
        assert!(deviations.len() > 300, "{name}: only {} pixels are compared", deviations.len());
        // A few pixels are next to an edge or a pole, where differences do not approximate derivatives.
        let [typical, most] = [0.5, 0.95].map(|part| deviations[(deviations.len() as f64 * part) as usize]);
        println!("{name}: {typical:.1e}, {most:.1e} of {}", deviations.len());
        assert!(typical < 0.01 && most < 0.05, "{name}: {typical:.3} and {most:.3} from the exact normal");
    }
}

#[test]
fn bump_tilts_normals_against_the_slope_of_its_heights() {
    let files = Files::new();
    let bump = format!("bump = {{ texture = 'height', height = {HEIGHT} }}");
    // All shapes show their fronts, or, if they are flipped, their backs: heights count along the reversed normal.
    for (flip, two_sided_relief, rise) in [(false, false, 1.0), (false, true, 1.0), (true, false, -1.0), (true, true, 1.0)] {
        assert_normals(&files, &format!("{bump}\ntwo_sided_relief = {two_sided_relief}"), flip, |place| {
            let [u, v] = place.along;
            // The gradient g lies in the surface, and g · ∂p/∂u = ∂h/∂u, g · ∂p/∂v = ∂h/∂v.
            let metric = DMat2::from_cols(DVec2::new(u.dot(u), u.dot(v)), DVec2::new(u.dot(v), v.dot(v)));
            let by = metric.inverse() * (RISE * HEIGHT) * rise;
            place.normal - u * by.x - v * by.y
        });
    }
}

#[test]
fn normal_maps_tilt_normals_along_u_and_against_v() {
    let files = Files::new();
    // A flipped surface turns the frame about ∂p/∂u, and shows its back. With relief on both sides, the tilt of the back is turned about the
    // normal, which need not be at right angles to ∂p/∂u on a smooth mesh.
    let sides =
        [(false, false, [1.0, -1.0]), (false, true, [1.0, -1.0]), (true, false, [-1.0, -1.0]), (true, true, [-1.0, -1.0])];
    for (flip, two_sided_relief, [red, green]) in sides {
        assert_normals(&files, &format!("normal_map = 'TILT'\ntwo_sided_relief = {two_sided_relief}"), flip, |place| {
            let [u, v] = place.along.map(DVec3::normalize);
            let tilted = (u * (red * TILT.x) + v * (green * TILT.y) + place.normal * TILT.z).normalize();
            if flip && two_sided_relief { place.normal * (2.0 * place.normal.dot(tilted)) - tilted } else { tilted }
        });
    }
}

/// A light lights a wall over a mirror whose normals lean by 15°: camera paths and paths from the light meet it at cosines
/// that differ by a factor of 2 (Veach 1997, section 5.3).
#[test]
fn light_paths_and_camera_paths_agree_at_a_mirror_with_tilted_normals() {
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = folder.path().join("tilted.obj");
    let (sin, cos) = 15.0_f64.to_radians().sin_cos();
    let text = format!("v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nvn {sin} {cos} 0\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n");
    std::fs::write(&mesh, text).expect("it is written");
    let scene = scene(&format!(
        "camera = {{ eye = [-0.5, 0.8, 0], look_at = [1.5, 0.8, 0], fov = 30, resolution = [16, 16] }}
        materials.grey.lambertian.albedo = 0.5
        materials.silver.mirror.reflectance = 0.9
        [[objects]]
        shape.mesh.path = '{}'
        material = 'silver'
        [[objects]]
        shape.rectangle = {{ origin = [1.5, 0, -2], edge_u = [0, 0, 4], edge_v = [0, 2, 0] }}
        material = 'grey'
        [[objects]]
        shape.rectangle = {{ origin = [-2, 2, -0.5], edge_u = [1, 0, 0], edge_v = [0, 0, 1] }}
        emission.radiance = 5.0",
        mesh.display()
    ));
    let mean = |estimator| picture(&scene, settings(estimator), LUMINANCE, 1024).whole();
    assert_within(mean(Estimator::Bidirectional).z_from(mean(Estimator::Path)), "bidirectional and path");
}
