//! The object under a pixel, and the primitives of an object of the description.
use std::ops::Range;

use noisefall::{
    integrator::replay,
    sampling::Filter,
    scene::{Camera, RenderSettings, Scene, Shutter},
};

/// The place in the description of the object at the centre of a pixel, seen through a pinhole as the shutter opens. It takes one
/// path of a single surface.
pub fn object_at(scene: &Scene, camera: &Camera, pixel: [u32; 2]) -> Option<usize> {
    let shutter = camera.shutter.map(Shutter::at_opening);
    let rays = scene.rays(&Camera { lens: None, shutter, filter: Filter::tent(0.0), ..*camera });
    let settings = RenderSettings { max_bounces: Some(0), ..RenderSettings::default() };
    let object = replay(scene, &rays, &settings, pixel, 0).vertices.first()?.object?;
    Some(scene.objects[object as usize].described as usize)
}

/// The indices of the compiled objects that an object of the description was compiled to. They follow each other.
pub fn compiled(scene: &Scene, described: usize) -> Range<u32> {
    let is_of = |object: &noisefall::scene::Object| object.described as usize == described;
    let first = scene.objects.iter().position(is_of).unwrap_or(0);
    let count = scene.objects[first..].iter().take_while(|object| is_of(object)).count();
    first as u32..(first + count) as u32
}

#[cfg(test)]
mod tests {
    use noisefall::scene::parse;

    use super::*;

    /// A field of balls, and a lamp that is described last and compiled first.
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
    fn an_object_is_found_among_the_compiled_ones() {
        let scene = scene();
        assert_eq!([0, 1, 2].map(|described| compiled(&scene, described)), [1..2, 2..3, 0..1]);
        assert!(compiled(&scene, 7).is_empty());
    }
}
