//! Converts pointer positions to distances along axes, points on planes, and angles.
use std::f64::consts::TAU;

use glam::DVec3;

/// Lines and planes that are nearer to parallel than this have no useful intersection.
const PARALLEL: f64 = 1e-4;

/// The point on the axis through a pivot that is nearest to a ray: metres along the unit axis. `None` if both are parallel.
pub fn nearest_on_axis(pivot: DVec3, axis: DVec3, [origin, direction]: [DVec3; 2]) -> Option<f64> {
    let (way, cos) = (pivot - origin, axis.dot(direction));
    let sin_squared = 1.0 - cos * cos;
    (sin_squared > PARALLEL * PARALLEL).then(|| (cos * direction.dot(way) - axis.dot(way)) / sin_squared)
}

/// Intersection of a ray with the plane through a pivot. `None` if the ray is parallel to the plane or points away from it.
pub fn on_plane(pivot: DVec3, normal: DVec3, [origin, direction]: [DVec3; 2]) -> Option<DVec3> {
    let cos = direction.dot(normal);
    let distance = (pivot - origin).dot(normal) / cos;
    (cos.abs() > PARALLEL && distance > 0.0).then(|| origin + direction * distance)
}

/// The angle of a point of the image about a centre, radians, counter-clockwise from the right; y points down.
pub fn angle_about(center: [f32; 2], at: [f32; 2]) -> f64 {
    f64::from(center[1] - at[1]).atan2(f64::from(at[0] - center[0]))
}

/// The angle that differs from `angle` by whole turns and is nearest to `last`.
pub fn unwrapped(last: f64, angle: f64) -> f64 {
    angle + TAU * ((last - angle) / TAU).round()
}

/// The nearest multiple of a step.
pub fn snapped(x: f64, step: f64) -> f64 {
    (x / step).round() * step
}

/// The step of a grid in a scene of this size: a power of ten of metres, about a fiftieth of the size.
pub fn grid_step(size: f64) -> f64 {
    10f64.powf((size.max(1e-9) / 50.0).log10().round())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    #[test]
    fn a_ray_that_crosses_the_axis_finds_where() {
        let (pivot, axis) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.6, 0.8, 0.0));
        for along in [-2.5, 0.0, 4.0] {
            let origin = DVec3::new(-3.0, 7.0, 11.0);
            let direction = (pivot + axis * along - origin).normalize();
            let found = nearest_on_axis(pivot, axis, [origin, direction]).expect("they are not parallel");
            assert!((found - along).abs() < 1e-9, "{along}: {found}");
        }
        assert_eq!(nearest_on_axis(pivot, axis, [DVec3::ZERO, axis]), None);
    }

    #[test]
    fn the_nearest_point_of_the_axis_is_nearer_than_its_neighbours() {
        let (pivot, axis) = (DVec3::new(0.3, -1.0, 0.2), DVec3::Y);
        let [origin, direction] = [DVec3::new(4.0, 1.0, 5.0), DVec3::new(-0.5, 0.2, -0.7).normalize()];
        let distance = |along: f64| {
            let way = pivot + axis * along - origin;
            (way - direction * way.dot(direction)).length()
        };
        let found = nearest_on_axis(pivot, axis, [origin, direction]).expect("they are not parallel");
        assert!(distance(found) < distance(found + 1e-3) && distance(found) < distance(found - 1e-3));
    }

    #[test]
    fn a_ray_meets_a_plane_in_front_of_it_only() {
        let (pivot, normal) = (DVec3::new(0.0, 1.0, 0.0), DVec3::Y);
        let down = DVec3::new(1.0, -1.0, 0.0).normalize();
        let met = on_plane(pivot, normal, [DVec3::new(0.0, 3.0, 5.0), down]).expect("it meets the plane");
        assert!(met.distance(DVec3::new(2.0, 1.0, 5.0)) < 1e-12);
        assert_eq!(on_plane(pivot, normal, [DVec3::new(0.0, 3.0, 5.0), -down]), None);
        assert_eq!(on_plane(pivot, normal, [DVec3::new(0.0, 3.0, 5.0), DVec3::X]), None);
    }

    #[test]
    fn angles_grow_counter_clockwise_and_go_on_beyond_a_turn() {
        let at = |x: f32, y: f32| angle_about([10.0, 10.0], [x, y]);
        assert_eq!([at(20.0, 10.0), at(10.0, 0.0), at(10.0, 20.0)], [0.0, FRAC_PI_2, -FRAC_PI_2]);
        // Twice around, in steps of an eighth.
        let mut last = 0.0;
        for step in 0..=16 {
            let turned = f64::from(step) * PI / 4.0;
            let [x, y] = [10.0 + 5.0 * turned.cos(), 10.0 - 5.0 * turned.sin()];
            last = unwrapped(last, at(x as f32, y as f32));
            assert!((last - turned).abs() < 1e-6, "{step}: {last}");
        }
    }

    #[test]
    fn snapping_goes_to_the_nearest_multiple_and_grids_fit_the_scene() {
        assert_eq!([snapped(0.37, 0.25), snapped(-0.4, 0.25), snapped(52.0, 15.0)], [0.25, -0.5, 45.0]);
        assert_eq!([grid_step(5.0), grid_step(500.0)], [0.1, 10.0]);
    }
}
