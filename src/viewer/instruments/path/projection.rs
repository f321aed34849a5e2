//! Where points and lines of the scene lie in the picture.
use egui::{Pos2, Rect};
use glam::DVec3;
use noisefall::scene::Camera;

/// In pixels from the upper left corner, as a pinhole in the middle of the lens sees it; `None` behind the camera.
pub fn project(camera: &Camera, p: DVec3) -> Option<[f32; 2]> {
    let [right, up, forward] = camera.axes();
    let [width, height] = camera.resolution.map(f64::from);
    let way = p - camera.eye;
    let depth = way.dot(forward);
    let (half, scale) = (camera.projection.half_width(camera.fov), camera.projection.scale(depth)?);
    let (x, y) = (way.dot(right) * scale / half, way.dot(up) * scale / half);
    Some([(width * (1.0 + x) / 2.0) as f32, ((height - width * y) / 2.0) as f32])
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
    use noisefall::{
        math::{F, One},
        scene::{Projection, built_in},
    };

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
        Camera { eye, look_at, fov: 40.0, projection, resolution: [300, 200], ..built_in().camera }
    }

    #[test]
    fn what_a_ray_of_the_camera_meets_lies_where_it_went_through() {
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
    fn what_is_looked_at_lies_in_the_middle_and_edges_at_the_edge() {
        let camera = camera(Projection::Perspective);
        let [x, y] = project(&camera, DVec3::ZERO).expect("it is in front");
        assert!((x - 150.0).abs() < 1e-3 && (y - 100.0).abs() < 1e-3);
        let [right, _, forward] = camera.axes();
        let edge = camera.eye + forward + right * 20f64.to_radians().tan();
        assert!((project(&camera, edge).expect("it is in front")[0] - 300.0).abs() < 1e-3);
        assert!(project(&camera, camera.eye - forward).is_none());
    }
}
