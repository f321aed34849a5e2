//! Finds the vertices of a path that the camera sees.
use glam::{DVec3, Vec3};

use super::Replay;
use crate::integrator::transparent_ray::{Decisions, MOST_CROSSINGS, TransparentRay};
use noisefall_base::math::{F, M, One, V};
use noisefall_scene::scene::{Camera, Scene};

/// For every vertex of a path, whether nothing opaque lies between it and the middle of the camera's lens, at the time when the shutter
/// opens. What leaves the scene is not seen.
pub fn seen_by_camera(scene: &Scene, camera: &Camera, replay: &Replay) -> Vec<bool> {
    let is_seen = |position: [f32; 3]| sees(scene, camera, Vec3::from(position).as_dvec3());
    replay.vertices.iter().map(|vertex| vertex.surface.as_ref().is_some_and(|surface| is_seen(surface.position))).collect()
}

fn sees(scene: &Scene, camera: &Camera, point: DVec3) -> bool {
    // The point itself must not hide it.
    const NEARLY: f32 = 0.999;
    let [_, _, forward] = camera.axes();
    let way = point - camera.eye;
    let depth = way.dot(forward);
    let place = way - (forward - camera.projection.middle(forward)) * depth;
    let [eye, forward, place, to] = [camera.eye, forward, place, point].map(|v| v.as_vec3().to_array());
    let (o, d) = camera.projection.rays(One, V::splat(One, place), eye, forward);
    let distance = (V::splat(One, to) - o).length_squared().0.sqrt();
    depth > 0.0 && first_opaque(scene, [o, d], scene.rays(camera).moment(One), NEARLY * distance) >= NEARLY * distance
}

/// Distance to the first surface along a ray that lets no light pass, or to any surface beyond `limit`.
fn first_opaque(scene: &Scene, [o, d]: [V<One>; 2], time: F<One>, limit: f32) -> f32 {
    let all = M(true);
    let mut transparent_ray = TransparentRay::new(One, [o, d], time, scene.shapes.closest(One, all, o, d, time));
    if scene.surfaces.are_opaque() {
        return transparent_ray.nearest().t.0;
    }
    for _ in 0..MOST_CROSSINGS {
        if transparent_ray.nearest().t.0 >= limit || !transparent_ray.layered(One, scene, all).0 {
            break;
        }
        let crossing = transparent_ray.crossing(One, scene, all);
        let (alpha, _) = crossing.opacity(One, scene, all, F(0.5), Decisions::Middle);
        if alpha.0 >= 1.0 {
            break;
        }
        transparent_ray.cross(One, scene, all, &crossing);
    }
    transparent_ray.nearest().t.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrator::replay;
    use noisefall_scene::scene::{Projection, parse};

    /// A wall behind a small screen, both seen from the front, and light from everywhere.
    const SCENE: &str = "format = 1\nenvironment.radiance = 1\n\
        [camera]\neye = [0, 0, 4]\nlook_at = [0, 0, 0]\nfov = 60\nresolution = [32, 32]\n\
        [materials.white]\nlambertian.albedo = 0.8\n\
        [[objects]]\nshape.rectangle = { origin = [-9, -9, 0], edge_u = [18, 0, 0], edge_v = [0, 18, 0] }\nmaterial = \"white\"\n\
        [[objects]]\nshape.rectangle = { origin = [-1, -1, 1], edge_u = [2, 0, 0], edge_v = [0, 2, 0] }\nmaterial = \"white\"\n";

    #[test]
    fn points_behind_a_screen_or_the_camera_are_hidden() {
        let scene = parse("scene.toml", SCENE.to_owned()).expect("it is a scene");
        for projection in [Projection::default(), Projection::orthographic(6.0)] {
            let camera = Camera { projection, ..scene.camera };
            let sees = |x: f64, y: f64, z: f64| sees(&scene, &camera, DVec3::new(x, y, z));
            assert!(sees(0.5, 0.5, 1.0) && sees(2.0, 0.0, 0.0), "{projection:?}");
            assert!(!sees(0.0, 0.0, 0.0) && !sees(0.7, 0.7, 0.0) && !sees(0.0, 0.0, 5.0), "{projection:?}");
        }
        // A cone of rays: the shadow of the screen is larger than the screen.
        assert!(!sees(&scene, &scene.camera, DVec3::new(1.2, 0.0, 0.0)));
    }

    #[test]
    fn the_first_surface_of_a_pinhole_is_seen_and_the_sky_is_not() {
        let scene = parse("scene.toml", SCENE.to_owned()).expect("it is a scene");
        let rays = scene.rays(&scene.camera);
        for pixel in [[3, 4], [16, 16], [31, 0]] {
            let replay = replay(&scene, &rays, &scene.settings, pixel, 0);
            let seen = seen_by_camera(&scene, &scene.camera, &replay);
            assert_eq!(seen.len(), replay.vertices.len());
            assert!(seen[0], "{pixel:?}");
            assert!(replay.vertices.iter().zip(&seen).all(|(vertex, seen)| vertex.surface.is_some() || !seen));
        }
    }
}
