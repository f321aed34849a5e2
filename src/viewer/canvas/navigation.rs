//! Moving the camera: orbit, pan, dolly and flight, as pure functions of the camera.
use std::f64::consts::FRAC_PI_2;

use glam::{DQuat, DVec3};
use noisefall_scene::scene::Camera;

/// Smallest angle between the view and the vertical, radians.
const POLE: f64 = 0.02;

// A move by nothing returns the camera to the bit: `look_at + (eye - look_at)` is not always `eye`, and another eye is another image.

/// Turns the eye around the point it looks at; radians to the right and upwards.
pub fn orbit(camera: &Camera, right: f64, up: f64) -> Camera {
    if [right, up] == [0.0; 2] {
        return *camera;
    }
    let turn = turn(camera, right, up);
    Camera { eye: camera.look_at + turn * (camera.eye - camera.look_at), ..*camera }
}

/// Turns the view about the eye; radians to the right and upwards.
pub fn look(camera: &Camera, right: f64, up: f64) -> Camera {
    if [right, up] == [0.0; 2] {
        return *camera;
    }
    let turn = turn(camera, -right, -up);
    Camera { look_at: camera.eye + turn * (camera.look_at - camera.eye), ..*camera }
}

fn turn(camera: &Camera, right: f64, up: f64) -> DQuat {
    let [side, _, forward] = camera.axes();
    let vertical = camera.up.normalize();
    let elevation = FRAC_PI_2 - (-forward).angle_between(vertical);
    let limit = FRAC_PI_2 - POLE;
    let up = up.clamp((-limit - elevation).min(0.0), (limit - elevation).max(0.0));
    DQuat::from_axis_angle(vertical, right) * DQuat::from_axis_angle(side, -up)
}

/// Moves eye and look-at together, metres to the right, upwards and forwards.
pub fn fly(camera: &Camera, by: DVec3) -> Camera {
    if by == DVec3::ZERO {
        return *camera;
    }
    let [right, up, forward] = camera.axes();
    let step = right * by.x + up * by.y + forward * by.z;
    Camera { eye: camera.eye + step, look_at: camera.look_at + step, ..*camera }
}

/// Moves the camera in its own plane, in widths of the image, so that the scene at the look-at point follows the pointer.
pub fn pan(camera: &Camera, right: f64, up: f64) -> Camera {
    let width = camera.width_at_look_at();
    fly(camera, DVec3::new(-right * width, -up * width, 0.0))
}

/// Multiplies the distance to the look-at point, or the width of the image for an orthographic camera.
pub fn dolly(camera: &Camera, factor: f64) -> Camera {
    if factor == 1.0 {
        return *camera;
    }
    match camera.projection.widened(factor) {
        Some(projection) => Camera { projection, ..*camera },
        None => Camera { eye: camera.look_at + (camera.eye - camera.look_at) * factor, ..*camera },
    }
}

#[cfg(test)]
mod tests {
    use noisefall_scene::scene::built_in;

    use super::*;

    fn camera() -> Camera {
        Camera { eye: DVec3::new(0.0, 1.0, 4.0), look_at: DVec3::Y, fov: 40.0, ..built_in().camera }
    }

    #[test]
    fn an_orbit_keeps_the_distance_and_never_flips_over() {
        let mut moved = camera();
        for step in 0..200 {
            moved = orbit(&moved, 0.1, if step < 100 { 0.2 } else { -0.2 });
            assert!((moved.eye.distance(moved.look_at) - 4.0).abs() < 1e-9);
            assert_eq!(moved.check(), Ok(()));
            assert!(moved.axes()[1].y > 0.0);
        }
    }

    #[test]
    fn a_move_by_nothing_keeps_every_bit_of_the_camera() {
        let places = (1..200).map(|i| f64::from(i) * 0.37).map(|x| DVec3::new(x.sin(), (3.1 * x).cos(), (7.3 * x).sin()));
        for eye in places {
            let camera = Camera { eye: 4.1 * eye, look_at: DVec3::new(0.1, 0.7, -0.3), ..camera() };
            for moved in [orbit(&camera, 0.0, 0.0), look(&camera, 0.0, 0.0), pan(&camera, 0.0, 0.0), dolly(&camera, 1.0)] {
                assert_eq!(moved, camera);
            }
        }
    }

    #[test]
    fn a_positive_orbit_goes_right_and_up() {
        let moved = orbit(&camera(), 0.3, 0.3);
        assert!(moved.eye.x > 0.0 && moved.eye.y > 1.0);
        let turned = look(&camera(), 0.3, 0.3);
        assert!(turned.look_at.x > 0.0 && turned.look_at.y > 1.0);
    }

    #[test]
    fn a_dolly_there_and_back_is_no_move() {
        let moved = dolly(&dolly(&camera(), 0.8), 1.25);
        assert!(moved.eye.distance(camera().eye) < 1e-12);
    }

    #[test]
    fn panning_by_the_width_of_the_picture_moves_the_look_at_point_to_its_edge() {
        let moved = pan(&camera(), 0.5, 0.0);
        let [right, _, forward] = moved.axes();
        let to_old = camera().look_at - moved.eye;
        let tangent = to_old.dot(right) / to_old.dot(forward);
        assert!((tangent - (20f64.to_radians()).tan()).abs() < 1e-12);
    }
}
