//! Moves the camera so that an object fills the image.
use glam::DVec3;
use noisefall_scene::scene::Camera;

use super::projection::pixel_width;

/// Fraction of the image's shorter side that a framed sphere fills.
const PART: f64 = 0.7;

/// The camera that looks at the middle of a sphere from the same direction, and sees all of it. Radius in metres.
pub fn look_at(camera: &Camera, center: DVec3, radius: f64) -> Camera {
    let [_, _, forward] = camera.axes();
    let [width, height] = camera.resolution.map(f64::from);
    let shorter = (height / width).min(1.0);
    let radius = radius.max(1e-9);
    let distance = if camera.projection.has_angle() {
        // The half angle of a cone that fits into the image.
        radius / (camera.projection.half_width(camera.fov) * shorter * PART).atan().sin()
    } else {
        camera.eye.distance(camera.look_at).max(2.0 * radius)
    };
    let projection = camera.projection.with_width((2.0 * radius / (PART * shorter)).clamp(1e-9, 1e9));
    Camera { eye: center - forward * distance, look_at: center, projection, ..*camera }
}

/// The extent of what the camera sees at a point, metres: the longer side of the image there. At a wide angle it is what two distances
/// from the camera see, so that a part of it does not reach the camera.
pub fn extent_at(camera: &Camera, p: DVec3) -> f64 {
    let [width, height] = camera.resolution.map(f64::from);
    let extent = pixel_width(camera, p) * width.max(height);
    if camera.projection.has_angle() { extent.min(2.0 * camera.eye.distance(p)) } else { extent }
}

/// A sphere around several spheres, each with its centre and radius; `None` if there are none.
pub fn around(spheres: impl Iterator<Item = (DVec3, f64)> + Clone) -> Option<(DVec3, f64)> {
    let boxes = spheres.clone().map(|(center, radius)| [center - radius, center + radius]);
    let [min, max] = boxes.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])?;
    let middle = 0.5 * (min + max);
    Some((middle, spheres.map(|(center, radius)| center.distance(middle) + radius).fold(0.0, f64::max)))
}

#[cfg(test)]
mod tests {
    use noisefall_scene::scene::{Projection, built_in};

    use super::*;
    use crate::viewer::canvas::projection::project;

    /// Distance of the outermost points of a sphere from the middle of the image, as a fraction of half its shorter side.
    fn reach(camera: &Camera, center: DVec3, radius: f64) -> f64 {
        let [right, up, forward] = camera.axes();
        let [width, height] = camera.resolution.map(f64::from);
        // The tangent cone touches the sphere a little before its middle.
        let sine: f64 = if camera.projection.has_angle() { radius / camera.eye.distance(center) } else { 0.0 };
        let edge = |side: DVec3| center - forward * (radius * sine) + side * (radius * (1.0 - sine * sine).sqrt());
        [right, -right, up, -up]
            .iter()
            .map(|side| {
                let [x, y] = project(camera, edge(*side)).expect("it is in front").map(f64::from);
                (x - width / 2.0).hypot(y - height / 2.0) / (width.min(height) / 2.0)
            })
            .fold(0.0, f64::max)
    }

    #[test]
    fn one_sphere_is_around_itself_and_several_lie_within() {
        let ball = (DVec3::new(1.0, 2.0, 3.0), 0.5);
        let (center, radius) = around([ball].into_iter()).expect("there is one");
        assert!(center.distance(ball.0) < 1e-12 && (radius - 0.5).abs() < 1e-12);
        let other = (DVec3::new(-4.0, 0.0, 3.0), 1.0);
        let (center, radius) = around([ball, other].into_iter()).expect("there are two");
        assert!([ball, other].iter().all(|(at, size)| at.distance(center) + size <= radius + 1e-12));
        assert_eq!(around(std::iter::empty()), None);
    }

    #[test]
    fn the_extent_of_a_view_is_its_longer_side_and_no_more_than_two_distances() {
        let camera = |projection, fov, resolution| {
            let (eye, look_at) = (DVec3::new(0.0, 0.0, 10.0), DVec3::ZERO);
            Camera { eye, look_at, fov, projection, resolution, lens: None, ..built_in().camera }
        };
        let of = |projection, fov, resolution| extent_at(&camera(projection, fov, resolution), DVec3::ZERO);
        let wide = 20.0 * 20f64.to_radians().tan();
        assert!((of(Projection::Perspective, 40.0, [300, 200]) - wide).abs() < 1e-9);
        assert!((of(Projection::Perspective, 40.0, [100, 200]) - 2.0 * wide).abs() < 1e-9);
        assert!((of(Projection::Perspective, 170.0, [300, 200]) - 20.0).abs() < 1e-9);
        assert!((of(Projection::orthographic(3.0), 40.0, [300, 200]) - 3.0).abs() < 1e-9);
    }

    #[test]
    fn a_framed_sphere_fills_its_part_of_the_picture() {
        let center = DVec3::new(3.0, -2.0, 1.0);
        let parallel = Projection::orthographic(2.0);
        for (projection, resolution) in [
            (Projection::Perspective, [300, 200]),
            (Projection::Perspective, [100, 400]),
            (parallel, [300, 200]),
            (parallel, [100, 400]),
        ] {
            let before = Camera { projection, resolution, lens: None, ..built_in().camera };
            for radius in [1e-3, 0.5, 40.0] {
                let framed = look_at(&before, center, radius);
                assert_eq!(framed.check(), Ok(()));
                assert!(framed.axes()[2].distance(before.axes()[2]) < 1e-9, "the direction stays");
                let reach = reach(&framed, center, radius);
                assert!((reach - PART).abs() < 1e-3, "{projection:?} {resolution:?} {radius}: {reach}");
            }
        }
    }
}
