//! Rounds the moves of the pointer to invisible steps, so that the numbers in a scene file stay short.
use noisefall_scene::shape::{Rotation, Transform};

/// Decimals of an angle in degrees.
const ANGLE: usize = 2;
/// Decimals of a factor.
const FACTOR: usize = 4;

/// The change in decimal steps: a move in steps of at most a tenth of `pixel`, the width of a pixel at the pivot in metres.
pub fn rounded(change: Transform, pixel: f64) -> Transform {
    match change {
        Transform::Translate(by) if pixel.is_finite() => {
            let decimals = -(0.1 * pixel).log10().floor();
            let decimals = decimals.clamp(0.0, 12.0) as usize;
            Transform::Translate(by.map(|x| to_decimals(x, decimals)))
        }
        Transform::Rotate(turn) => Transform::Rotate(Rotation { degrees: to_decimals(turn.degrees, ANGLE), ..turn }),
        Transform::Scale(factors) => Transform::Scale(factors.map(|x| to_decimals(x, FACTOR))),
        other => other,
    }
}

fn to_decimals(x: f64, decimals: usize) -> f64 {
    format!("{x:.decimals$}").parse().unwrap_or(x) + 0.0
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn a_move_has_no_more_decimals_than_a_tenth_of_a_pixel() {
        let by = DVec3::new(0.570_000_000_000_000_1, -1e-17, -12.345_678);
        let moved = |pixel: f64| match rounded(Transform::Translate(by), pixel) {
            Transform::Translate(by) => by,
            other => panic!("it is no move: {other:?}"),
        };
        assert_eq!(moved(0.012), DVec3::new(0.57, 0.0, -12.346));
        assert!(moved(0.012).y.is_sign_positive());
        assert_eq!(moved(30.0), DVec3::new(1.0, 0.0, -12.0));
        assert_eq!(moved(f64::INFINITY), by, "behind the camera nothing has a width");
    }

    #[test]
    fn angles_and_factors_have_few_decimals() {
        let turn = Rotation { axis: DVec3::Y, degrees: 12.345_678 };
        assert_eq!(rounded(Transform::Rotate(turn), 0.01), Transform::Rotate(Rotation { axis: DVec3::Y, degrees: 12.35 }));
        let scaled = rounded(Transform::Scale(DVec3::splat(1.1 * 1.1)), 0.01);
        assert_eq!(scaled, Transform::Scale(DVec3::splat(1.21)));
    }
}
