//! A turntable: cameras around the look-at point.
use std::f64::consts::TAU;

use glam::DQuat;

use super::Camera;

impl Camera {
    /// The cameras of a full turn around the axis through the look-at point along `up`, counterclockwise as seen from above. The first
    /// one is this camera. Whatever else the camera has stays the same.
    pub fn turntable(&self, frames: u32) -> impl Iterator<Item = Camera> + use<> {
        let camera = *self;
        let arm = camera.eye - camera.look_at;
        let turned = move |frame: u32| {
            let turn = DQuat::from_axis_angle(camera.up.normalize(), TAU * f64::from(frame) / f64::from(frames));
            // The first frame is the camera itself, without rounding.
            if frame == 0 { camera } else { Camera { eye: camera.look_at + turn * arm, ..camera } }
        };
        (0..frames).map(turned)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::scene::built_in;

    #[test]
    fn a_turn_begins_at_the_camera_and_keeps_height_and_distance() {
        let camera = Camera { up: DVec3::new(0.0, 2.0, 0.0), ..built_in().camera };
        let all: Vec<Camera> = camera.turntable(8).collect();
        assert_eq!((all.len(), all[0]), (8, camera));
        for (i, turned) in all.iter().enumerate() {
            assert_eq!(turned.check(), Ok(()));
            assert_eq!(Camera { eye: camera.eye, ..*turned }, camera);
            assert!((turned.eye.y - camera.eye.y).abs() < 1e-12);
            assert!((turned.eye.distance(camera.look_at) - camera.eye.distance(camera.look_at)).abs() < 1e-12, "{i}");
            let next = all[(i + 1) % 8].eye;
            let [from, to] = [turned.eye, next].map(|eye| (eye - camera.look_at).with_y(0.0).normalize());
            assert!((from.dot(to) - (TAU / 8.0).cos()).abs() < 1e-12 && from.cross(to).y > 0.0, "{i}");
        }
    }
}
