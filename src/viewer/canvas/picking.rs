//! The object and the surface under a pixel.
use glam::DVec3;
use noisefall_kernel::integrator::{Vertex, replay};
use noisefall_scene::{
    sampling::Filter,
    scene::{Camera, RenderSettings, Scene, Shutter},
};

/// The place in the description of the object at the centre of a pixel, seen through a pinhole as the shutter opens. It takes one
/// path of a single surface.
pub fn object_at(scene: &Scene, camera: &Camera, pixel: [u32; 2]) -> Option<usize> {
    let object = first_vertex(scene, camera, pixel)?.object?;
    Some(scene.objects[object as usize].described as usize)
}

/// The point on the surface at the centre of a pixel, and the geometric normal there, on the camera's side. `None` if there is no
/// surface.
pub fn surface_at(scene: &Scene, camera: &Camera, pixel: [u32; 2]) -> Option<[DVec3; 2]> {
    let vertex = first_vertex(scene, camera, pixel)?;
    let [origin, direction] = [vertex.origin, vertex.direction].map(|v| DVec3::from_array(v.map(f64::from)));
    let normal = DVec3::from_array(vertex.surface?.geometric_normal.map(f64::from));
    Some([origin + direction * f64::from(vertex.distance?), normal])
}

fn first_vertex(scene: &Scene, camera: &Camera, pixel: [u32; 2]) -> Option<Vertex> {
    let shutter = camera.shutter.map(Shutter::at_opening);
    let rays = scene.rays(&Camera { lens: None, shutter, filter: Filter::tent(0.0), ..*camera });
    let settings = RenderSettings { max_bounces: Some(0), ..RenderSettings::default() };
    replay(scene, &rays, &settings, pixel, 0).vertices.into_iter().next()
}

#[cfg(test)]
mod tests {
    use noisefall_scene::scene::parse;

    use super::*;

    /// A field of balls, and a light that is described last and compiled first.
    fn scene() -> Scene {
        let text = r#"format = 1
            camera = { eye = [0.0, 0.0, 10.0], look_at = [0.0, 0.0, 0.0], projection.orthographic.width = 4.0, resolution = [40, 40] }
            [[objects]]
            shape.sphere = { center = [-1.0, 0.0, 0.0], radius = 0.5 }
            [[objects]]
            shape.rectangle = { origin = [0.5, 0.5, 0.0], edge_u = [1.0, 0.0, 0.0], edge_v = [0.0, 1.0, 0.0] }
            [[objects]]
            shape.sphere = { center = [1.0, -1.0, 0.0], radius = 0.5 }
            emission = { radiance = 1.0 }
        "#;
        parse("scene.toml", text.to_owned()).expect("it is a scene")
    }

    #[test]
    fn a_pixel_shows_the_object_at_its_centre() {
        let scene = scene();
        let at = |pixel| object_at(&scene, &scene.camera, pixel);
        assert_eq!([at([10, 20]), at([30, 10]), at([30, 30]), at([20, 20])], [Some(0), Some(1), Some(2), None]);
        // Pixels of 0.1 m, whose centres lie 0.45 m and 0.55 m from the middle of the ball.
        assert_eq!([at([14, 20]), at([15, 20])], [Some(0), None]);
    }

    #[test]
    fn a_pixel_has_the_point_and_the_normal_of_its_surface() {
        let scene = scene();
        let [at, normal] = surface_at(&scene, &scene.camera, [30, 10]).expect("the rectangle is there");
        assert!(at.distance(DVec3::new(1.05, 0.95, 0.0)) < 1e-4 && normal.distance(DVec3::Z) < 1e-4, "{at} {normal}");
        assert_eq!(surface_at(&scene, &scene.camera, [20, 20]), None);
    }

    /// The normal does not depend on where the camera is, but on which side of the surface.
    #[test]
    fn the_normal_of_a_surface_seen_from_the_side_is_not_the_direction_to_the_camera() {
        let scene = scene();
        for (eye, expected) in [(DVec3::new(8.0, 1.0, 6.0), DVec3::Z), (DVec3::new(-5.0, 4.0, -6.0), DVec3::NEG_Z)] {
            let camera = Camera { eye, look_at: DVec3::new(1.0, 1.0, 0.0), ..scene.camera };
            let [_, normal] = surface_at(&scene, &camera, [20, 20]).expect("the rectangle is there");
            assert!(normal.distance(expected) < 1e-6, "{eye}: {normal}");
        }
    }

    #[test]
    fn an_object_is_found_among_the_compiled_ones() {
        let scene = scene();
        assert_eq!([0, 1, 2].map(|described| scene.objects_of(described)), [1..2, 2..3, 0..1]);
        assert!(scene.objects_of(7).is_empty());
    }
}
