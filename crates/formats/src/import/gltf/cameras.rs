//! The camera.
use glam::{DAffine3, DVec3};

use super::document::Camera;
use noisefall_scene::scene::{Projection, description::CameraDescription};

/// Longer side of the image, pixels.
const LONGER: f64 = 1280.0;
/// Width over height where the file does not say it.
const USUAL_ASPECT: f64 = 4.0 / 3.0;

/// A camera of the file at a place, for an image of this size or of its own; `None` if it makes no image. The camera of glTF looks along
/// −z, with y up.
pub fn camera(camera: &Camera, world: &DAffine3, size: Option<[u32; 2]>) -> Option<CameraDescription> {
    let eye = world.translation;
    let forward = (world.matrix3 * DVec3::NEG_Z).try_normalize()?;
    let up = (world.matrix3 * DVec3::Y).try_normalize().filter(|up| up.cross(forward).length() > 1e-6)?;
    // The exporter may have stated +y with errors of rounding.
    let up = (up.dot(DVec3::Y) < 1.0 - 1e-12).then_some(up);
    let (projection, fov, aspect) = match (camera.perspective, camera.orthographic) {
        (Some(perspective), _) => {
            let of_file = usable(perspective.aspect_ratio.unwrap_or(USUAL_ASPECT))?;
            // The angle is across the height, whatever the width.
            let of_image = size.map(|[width, height]| f64::from(width) / f64::from(height));
            let aspect = of_image.and_then(usable).unwrap_or(of_file);
            let slope = (usable(perspective.yfov)? / 2.0).tan();
            let fov = 2.0 * (slope * aspect).atan().to_degrees();
            (Projection::Perspective, Some(fov).filter(|fov| *fov > 0.0)?.clamp(0.001, 179.9).into(), aspect)
        }
        (None, Some(orthographic)) => {
            let (x, y) = (usable(orthographic.xmag.abs())?, usable(orthographic.ymag.abs())?);
            (Projection::orthographic((2.0 * x).clamp(1e-9, 1e9)), None, x / y)
        }
        (None, None) => return None,
    };
    Some(CameraDescription {
        eye,
        look_at: eye + forward,
        up,
        fov,
        resolution: resolution(aspect),
        projection,
        ..CameraDescription::default()
    })
    .filter(|camera| camera.eye.is_finite() && camera.eye != camera.look_at)
}

fn usable(x: f64) -> Option<f64> {
    (x.is_finite() && x > 0.0).then_some(x)
}

/// The resolution that is taken for an aspect, width over height.
pub fn resolution(aspect: f64) -> [u32; 2] {
    let side = |length: f64| length.round().clamp(1.0, LONGER) as u32;
    if aspect >= 1.0 { [side(LONGER), side(LONGER / aspect)] } else { [side(LONGER * aspect), side(LONGER)] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::gltf::document::{Orthographic, Perspective};

    #[test]
    fn the_field_of_view_is_that_across_the_width() {
        let perspective = |yfov: f64, aspect_ratio| {
            let described = Camera { perspective: Some(Perspective { yfov, aspect_ratio }), ..Camera::default() };
            camera(&described, &DAffine3::from_translation(DVec3::new(1.0, 2.0, 3.0)), None)
        };
        let wide = perspective(60f64.to_radians(), Some(2.0)).expect("a camera");
        let expected = 2.0 * (2.0 * 30f64.to_radians().tan()).atan().to_degrees();
        assert!((wide.fov.expect("an angle") - expected).abs() < 1e-9);
        assert_eq!((wide.resolution, wide.eye, wide.up), ([1280, 640], DVec3::new(1.0, 2.0, 3.0), None));
        assert!((wide.look_at - DVec3::new(1.0, 2.0, 2.0)).length() < 1e-12);
        assert_eq!(perspective(1.0, Some(0.5)).map(|camera| camera.resolution), Some([640, 1280]));
        assert_eq!(perspective(1.0, None).map(|camera| camera.resolution), Some([1280, 960]));
        for (yfov, aspect) in [(0.0, None), (-1.0, None), (1.0, Some(0.0)), (4.0, None)] {
            assert_eq!(perspective(yfov, aspect), None, "{yfov} {aspect:?}");
        }
    }

    #[test]
    fn images_of_any_size_have_the_angle_across_the_height() {
        for (aspect_ratio, size) in [(None, [64, 64]), (None, [96, 32]), (Some(2.0), [30, 40]), (None, [5, 0])] {
            let described = Camera { perspective: Some(Perspective { yfov: 0.8, aspect_ratio }), ..Camera::default() };
            let found = camera(&described, &DAffine3::IDENTITY, Some(size)).expect("a camera");
            let aspect = if size[1] > 0 { f64::from(size[0]) / f64::from(size[1]) } else { USUAL_ASPECT };
            let slope = (found.fov.expect("an angle").to_radians() / 2.0).tan() / aspect;
            assert!((slope - 0.4f64.tan()).abs() < 1e-12, "{size:?}: {slope}");
        }
    }

    #[test]
    fn parallel_rays_show_twice_the_magnification() {
        let described = Camera { orthographic: Some(Orthographic { xmag: 3.0, ymag: 1.5 }), ..Camera::default() };
        let found = camera(&described, &DAffine3::from_rotation_x(-1.0), None).expect("a camera");
        assert_eq!((found.projection, found.fov, found.resolution), (Projection::orthographic(6.0), None, [1280, 640]));
        let up = found.up.expect("it is tilted");
        assert!((up - DVec3::new(0.0, 1f64.cos(), -(1f64.sin()))).length() < 1e-12);
        assert_eq!(camera(&described, &DAffine3::from_scale(DVec3::ZERO), None), None);
    }
}
