//! Where points of the scene lie in the picture.
use glam::DVec3;
use noisefall::scene::Camera;

/// In pixels from the upper left corner, as a pinhole in the middle of the lens sees it; `None` behind the camera.
pub fn project(camera: &Camera, p: DVec3) -> Option<[f32; 2]> {
    let [right, up, forward] = camera.axes();
    let [width, height] = camera.resolution.map(f64::from);
    let way = p - camera.eye;
    let depth = way.dot(forward);
    let (half, scale) = match camera.orthographic {
        Some(width) => (width / 2.0, 1.0),
        None => ((camera.fov.to_radians() / 2.0).tan(), 1.0 / depth),
    };
    if camera.orthographic.is_none() && depth <= 1e-9 {
        return None;
    }
    let (x, y) = (way.dot(right) * scale / half, way.dot(up) * scale / half);
    Some([(width * (1.0 + x) / 2.0) as f32, ((height - width * y) / 2.0) as f32])
}

#[cfg(test)]
mod tests {
    use noisefall::scene::built_in;

    use super::*;

    #[test]
    fn what_is_looked_at_lies_in_the_middle_and_edges_at_the_edge() {
        let camera = Camera {
            eye: DVec3::new(1.0, 2.0, 3.0),
            look_at: DVec3::ZERO,
            fov: 40.0,
            resolution: [300, 200],
            ..built_in().camera
        };
        let [x, y] = project(&camera, DVec3::ZERO).expect("it is in front");
        assert!((x - 150.0).abs() < 1e-3 && (y - 100.0).abs() < 1e-3);
        let [right, _, forward] = camera.axes();
        let edge = camera.eye + forward + right * 20f64.to_radians().tan();
        assert!((project(&camera, edge).expect("it is in front")[0] - 300.0).abs() < 1e-3);
        assert!(project(&camera, camera.eye - forward).is_none());
    }
}
