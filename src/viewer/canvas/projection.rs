//! Projects points and lines of the scene to the image.
use egui::{Pos2, Rect};
use glam::DVec3;
use noisefall_scene::scene::Camera;

/// In pixels from the upper left corner, as a pinhole in the middle of the lens sees it; `None` behind the camera.
pub fn project(camera: &Camera, p: DVec3) -> Option<[f32; 2]> {
    let [right, up, forward] = camera.axes();
    let [width, height] = camera.resolution.map(f64::from);
    let way = p - camera.eye;
    let depth = way.dot(forward);
    let (half, scale) = (camera.projection.half_width(camera.fov), camera.projection.scale(depth)?);
    let (x, y) = (way.dot(right) * scale / half, way.dot(up) * scale / half);
    let [x, y] = [x - 2.0 * camera.shift[0], y - 2.0 * camera.shift[1]];
    Some([(width * (1.0 + x) / 2.0) as f32, ((height - width * y) / 2.0) as f32])
}

/// The half-line of points that [`project`] puts at a place of the image: origin and unit direction.
pub fn ray(camera: &Camera, [x, y]: [f32; 2]) -> [DVec3; 2] {
    let [right, up, forward] = camera.axes();
    let [width, height] = camera.resolution.map(f64::from);
    let half = camera.projection.half_width(camera.fov);
    let [shift_right, shift_up] = camera.shift.map(|shift| 2.0 * width * shift);
    let (x, y) = (2.0 * f64::from(x) - width + shift_right, height - 2.0 * f64::from(y) + shift_up);
    let across = (right * x + up * y) * (half / width);
    // Points at a depth lie across by the inverse of the scale, which is linear in the depth.
    let at = |depth: f64| camera.eye + forward * depth + across / camera.projection.scale(depth).unwrap_or(1.0);
    let (near, way) = (at(1.0), at(2.0) - at(1.0));
    [near - way, way.normalize()]
}

/// Metres at a point of the scene that a pixel is wide; infinite behind the camera.
pub fn pixel_width(camera: &Camera, p: DVec3) -> f64 {
    let [_, _, forward] = camera.axes();
    let depth = (p - camera.eye).dot(forward);
    let wide = camera.projection.scale(depth).map(|scale| 2.0 * camera.projection.half_width(camera.fov) / scale);
    wide.map_or(f64::INFINITY, |wide| wide / f64::from(camera.resolution[0]))
}

/// The part of a line that lies in a rectangle (Liang and Barsky 1984). What ends near the plane of the camera is endless, nearly.
pub fn clip(rect: Rect, [from, to]: [Pos2; 2]) -> Option<[Pos2; 2]> {
    let way = to - from;
    let (mut enters, mut leaves) = (0f32, 1f32);
    for (at, step, low, high) in [(from.x, way.x, rect.left(), rect.right()), (from.y, way.y, rect.top(), rect.bottom())] {
        if step == 0.0 && !(low..=high).contains(&at) {
            return None;
        } else if step != 0.0 {
            let (a, b) = ((low - at) / step, (high - at) / step);
            (enters, leaves) = (enters.max(a.min(b)), leaves.min(a.max(b)));
        }
    }
    (enters <= leaves && from.is_finite() && to.is_finite()).then(|| [from + way * enters, from + way * leaves])
}

#[cfg(test)]
mod tests {
    use noisefall_base::math::{F, One};
    use noisefall_scene::scene::{Projection, built_in};

    use super::*;

    #[test]
    fn lines_are_cut_where_they_leave_the_rectangle() {
        let rect = Rect::from_min_max(Pos2::new(0.0, 0.0), Pos2::new(10.0, 10.0));
        let clip = |from: [f32; 2], to: [f32; 2]| clip(rect, [from.into(), to.into()]).map(|ends| ends.map(|p| [p.x, p.y]));
        assert_eq!(clip([5.0, 5.0], [5.0, 1e7]), Some([[5.0, 5.0], [5.0, 10.0]]));
        assert_eq!(clip([-5.0, 5.0], [15.0, 5.0]), Some([[0.0, 5.0], [10.0, 5.0]]));
        assert_eq!(clip([2.0, 3.0], [4.0, 4.0]), Some([[2.0, 3.0], [4.0, 4.0]]));
        assert_eq!((clip([-1.0, 5.0], [-1.0, 9.0]), clip([-9.0, 5.0], [5.0, 30.0])), (None, None));
        assert_eq!(clip([f32::NAN, 5.0], [5.0, 5.0]), None);
    }

    fn camera(projection: Projection) -> Camera {
        let (eye, look_at) = (DVec3::new(1.0, 2.0, 3.0), DVec3::ZERO);
        Camera { eye, look_at, fov: 40.0, projection, shift: [0.25, -0.5], resolution: [300, 200], ..built_in().camera }
    }

    #[test]
    fn a_hit_of_a_camera_ray_projects_to_the_point_of_the_ray() {
        for projection in [Projection::Perspective, Projection::orthographic(3.0)] {
            let camera = camera(projection);
            let (o, d) = built_in().rays(&camera).through(One, F(30.0), F(170.0));
            let met = o + d * 5.0;
            let met = DVec3::new(met.x.0.into(), met.y.0.into(), met.z.0.into());
            let [x, y] = project(&camera, met).expect("it is in front");
            assert!((x - 30.0).abs() < 1e-2 && (y - 170.0).abs() < 1e-2, "{projection:?}: {x} {y}");
        }
    }

    #[test]
    fn every_point_of_a_ray_lies_where_the_ray_goes_through() {
        for projection in [Projection::Perspective, Projection::orthographic(3.0)] {
            let camera = camera(projection);
            let [origin, direction] = ray(&camera, [30.0, 170.0]);
            for distance in [0.5, 7.0] {
                let [x, y] = project(&camera, origin + direction * distance).expect("it is in front");
                assert!((x - 30.0).abs() < 1e-3 && (y - 170.0).abs() < 1e-3, "{projection:?}: {x} {y}");
            }
        }
    }

    #[test]
    fn a_step_of_a_pixel_is_a_pixel_wide() {
        for projection in [Projection::Perspective, Projection::orthographic(3.0)] {
            let camera = camera(projection);
            let step = camera.axes()[0] * pixel_width(&camera, DVec3::ZERO);
            let [x, _] = project(&camera, step).expect("it is in front");
            // A quarter of the width to the left of the middle.
            assert!((x - 76.0).abs() < 1e-3, "{projection:?}: {x}");
        }
        assert_eq!(pixel_width(&camera(Projection::Perspective), DVec3::splat(1e3)), f64::INFINITY);
    }

    #[test]
    fn the_look_at_point_lies_in_the_middle_and_edges_at_the_edge() {
        let camera = Camera { shift: [0.0; 2], ..camera(Projection::Perspective) };
        let [x, y] = project(&camera, DVec3::ZERO).expect("it is in front");
        assert!((x - 150.0).abs() < 1e-3 && (y - 100.0).abs() < 1e-3);
        let [right, _, forward] = camera.axes();
        let edge = camera.eye + forward + right * 20f64.to_radians().tan();
        assert!((project(&camera, edge).expect("it is in front")[0] - 300.0).abs() < 1e-3);
        assert!(project(&camera, camera.eye - forward).is_none());
    }
}
