//! First surfaces along camera rays, compared with geometry and with the renderer.
use std::{path::Path, sync::atomic::AtomicU32, sync::atomic::Ordering};

use glam::{DVec3, Vec3};
use noisefall_base::math::SimdLevel;
use noisefall_kernel::integrator::{Features, features, replay};
use noisefall_scene::{
    sampling::Filter,
    scene::{Camera, RenderSettings, Scene, Shutter, load},
};

use crate::picture::scene;

const MISS: u32 = u32::MAX;

/// The features of the scene's camera.
fn seen(scene: &Scene, camera: &Camera) -> Features {
    features(SimdLevel::best(), scene, camera, &|| false).expect("nobody interrupts")
}

/// Unit directions through the centres of the pixels of a pinhole camera.
fn directions(camera: &Camera) -> Vec<DVec3> {
    let [right, up, forward] = camera.axes();
    let [width, height] = camera.resolution;
    let pixel_size = 2.0 * (camera.fov.to_radians() / 2.0).tan() / f64::from(width);
    let offset = |at: u32, side: u32| (f64::from(at) + 0.5 - f64::from(side) / 2.0) * pixel_size;
    let direction = |x: u32, y: u32| (forward + right * offset(x, width) - up * offset(y, height)).normalize();
    (0..height).flat_map(|y| (0..width).map(move |x| direction(x, y))).collect()
}

fn world(normal: [f32; 3]) -> DVec3 {
    Vec3::from(normal).as_dvec3()
}

fn assert_nothing_at(found: &Features, pixel: usize) {
    assert_eq!([found.normal[pixel], found.albedo[pixel], found.position[pixel]], [[0.0; 3]; 3]);
    assert_eq!((found.depth[pixel], found.object[pixel], found.material[pixel]), (f32::INFINITY, MISS, MISS));
}

#[test]
fn a_sphere_is_where_it_is() {
    let scene = scene(
        "camera = { eye = [0.0, 0.0, 5.0], look_at = [0.0, 0.0, 0.0], fov = 30.0, resolution = [75, 50], \
         lens = { radius = 0.2, focus = 3.0 } }
        materials.clay.lambertian.albedo = [0.25, 0.5, 0.75]
        [[objects]]
        shape.sphere = { center = [0.0, 0.0, 0.0], radius = 1.0 }
        material = 'clay'
        [[objects]]
        shape.sphere = { center = [0.0, 0.0, 90.0], radius = 1.0 }
        emission.radiance = 1.0",
    );
    let (found, eye) = (seen(&scene, &scene.camera), scene.camera.eye);
    assert_eq!([found.width, found.height], [75, 50]);
    // Lights come first.
    let legend = scene.legend();
    assert_eq!((&legend.names[..], &legend.of_object[..]), (&["black".to_owned(), "clay".to_owned()][..], &[0, 1][..]));
    let mut hits = 0;
    for (pixel, d) in directions(&scene.camera).into_iter().enumerate() {
        let b = eye.dot(d);
        let discriminant = b * b - (eye.length_squared() - 1.0);
        if discriminant < 0.0 {
            assert_nothing_at(&found, pixel);
            continue;
        }
        hits += 1;
        let t = -b - discriminant.sqrt();
        // On a grazing ray, a small error sideways is a large one along the ray.
        let tolerance = 2e-6 / discriminant.sqrt().min(1.0);
        assert!((f64::from(found.depth[pixel]) - t).abs() < tolerance * t, "{pixel}: {} for {t}", found.depth[pixel]);
        assert!((world(found.normal[pixel]) - (eye + d * t)).length() < tolerance * t, "{pixel}: {:?}", found.normal[pixel]);
        assert_eq!((found.object[pixel], found.material[pixel]), (1, 1));
        assert_eq!(found.albedo[pixel], [0.25, 0.5, 0.75]);
    }
    assert!((500..2500).contains(&hits), "{hits}");
    assert!(found.cost.iter().all(|cost| cost.is_finite() && *cost > 0.0));
}

#[test]
fn parallel_rays_show_a_checker_as_it_is_and_its_back_black() {
    let text = |eye: f64| {
        format!(
            "camera = {{ eye = [0.0, 0.0, {eye:?}], look_at = [0.0, 0.0, 0.0], projection.orthographic.width = 2.0, resolution = [64, 64] }}
            textures.squares.checker = {{ even = [0.75, 0.5, 0.25], odd = 0.125, scale = 8.0 }}
            materials.board = {{ lambertian.albedo.texture = 'squares', two_sided = false }}
            [[objects]]
            shape.rectangle = {{ origin = [-1.0, -1.0, 0.0], edge_u = [2.0, 0.0, 0.0], edge_v = [0.0, 2.0, 0.0] }}
            material = 'board'"
        )
    };
    let front = scene(&text(3.0));
    let found = seen(&front, &front.camera);
    for pixel in 0..64 * 64 {
        let cells = pixel % 64 / 8 + pixel / 64 / 8;
        assert_eq!(found.albedo[pixel], if cells % 2 == 0 { [0.75, 0.5, 0.25] } else { [0.125; 3] }, "{pixel}");
        assert_eq!((found.depth[pixel], found.normal[pixel]), (3.0, [0.0, 0.0, 1.0]));
    }
    let behind = scene(&text(-3.0));
    let found = seen(&behind, &behind.camera);
    assert!(found.albedo.iter().all(|albedo| *albedo == [0.0; 3]));
    assert!(found.normal.iter().all(|normal| *normal == [0.0, 0.0, -1.0]));
}

#[test]
fn a_smooth_octahedron_has_the_normals_of_a_sphere() {
    let scene = scene(
        "camera = { eye = [1.5, 2.0, 3.0], look_at = [0.0, 0.0, 0.0], fov = 40.0, resolution = [60, 60] }
        materials.clay.lambertian.albedo = 0.5
        [[objects]]
        shape.mesh = { smooth = true, vertices = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], \
         triangles = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]] }
        material = 'clay'",
    );
    let (found, eye) = (seen(&scene, &scene.camera), scene.camera.eye);
    let mut compared = 0;
    for (pixel, d) in directions(&scene.camera).into_iter().enumerate().filter(|(pixel, _)| found.object[*pixel] == 0) {
        let p = eye + d * f64::from(found.depth[pixel]);
        let off = p.x.abs() + p.y.abs() + p.z.abs() - 1.0;
        assert!(off.abs() < 5e-6, "{pixel} is {off} off the faces");
        // Shading normals that face away from the viewer are not used.
        let exact = p.normalize();
        if exact.dot(-d) > 0.01 {
            compared += 1;
            assert!((world(found.normal[pixel]) - exact).length() < 1e-5, "{pixel}: {:?}, {exact}", found.normal[pixel]);
        }
    }
    assert!(compared > 400, "{compared}");
}

/// The shipped scenes at a low resolution; they have shapes, textures and motions of every kind.
fn scenes() -> Vec<(&'static str, Scene, Camera)> {
    let names = ["shapes", "textures_and_bump", "isosurfaces", "gloss_row", "motion_blur", "depth_of_field", "cornell_spheres"];
    let scene = |name| {
        let scene = load(&Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("scenes/{name}.toml"))).expect("it is a scene");
        let camera = Camera { resolution: [45, 37], ..scene.camera };
        (name, scene, camera)
    };
    names.map(scene).into()
}

#[test]
fn the_renderer_meets_the_same_surfaces() {
    for (name, scene, camera) in scenes() {
        let found = seen(&scene, &camera);
        let middle = Camera { lens: None, shutter: camera.shutter.map(Shutter::at_opening), filter: Filter::tent(0.0), ..camera };
        let rays = scene.rays(&middle);
        for pixel in (0..found.depth.len()).step_by(7) {
            let [x, y] = [pixel as u32 % found.width, pixel as u32 / found.width];
            let path = replay(&scene, &rays, &RenderSettings::default(), [x, y], 3);
            let first = &path.vertices[0];
            assert_eq!(first.object.unwrap_or(MISS), found.object[pixel], "{name} at {x}, {y}");
            assert_eq!(first.distance.unwrap_or(f32::INFINITY), found.depth[pixel], "{name} at {x}, {y}");
            let Some(object) = first.object else { continue };
            let material = scene.material(&scene.objects[object as usize]).map_or("black", |material| &material.name);
            assert_eq!(scene.legend().names[found.material[pixel] as usize], material);
            let n = world(found.normal[pixel]);
            assert!((n.length() - 1.0).abs() < 1e-5 && n.dot(world(first.direction)) < 0.0, "{name} at {x}, {y}: {n}");
            if name != "textures_and_bump" && first.normal.is_some() {
                let geometric = world(first.normal.unwrap_or_default());
                assert!(n.dot(geometric) > 0.5, "{name} at {x}, {y}: {n} and {geometric}");
            }
        }
    }
}

#[test]
fn all_levels_see_the_same_bits() {
    let bits = |found: &Features| {
        let vectors = found.normal.iter().chain(&found.albedo).chain(&found.position).flatten();
        let reals: Vec<u32> = vectors.chain(&found.depth).map(|x| x.to_bits()).collect();
        (reals, found.object.clone(), found.material.clone())
    };
    for (name, scene, camera) in scenes() {
        let of_level = |level| bits(&features(level, &scene, &camera, &|| false).expect("nobody interrupts"));
        let reference = of_level(SimdLevel::Scalar);
        for level in SimdLevel::available() {
            assert!(of_level(level) == reference, "{name}, {level:?}");
        }
    }
}

#[test]
fn looking_can_be_interrupted() {
    let (_, scene, camera) = scenes().remove(0);
    let asked = AtomicU32::new(0);
    let in_the_middle = || asked.fetch_add(1, Ordering::Relaxed) == 9;
    assert!(features(SimdLevel::best(), &scene, &camera, &in_the_middle).is_none());
}
