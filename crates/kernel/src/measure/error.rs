//! Error metrics between images.
use std::fmt;

use serde::Serialize;

/// The constant that relMSE adds to the squared reference, so that dark pixels do not dominate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Floor {
    /// This fraction of the reference's mean squared radiance: relMSE does not depend on the unit of radiance.
    Relative(f64),
    /// A number for all images, as in some other programs.
    Absolute(f64),
}

/// Errors of an image against a reference.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// Root of the mean over pixels and channels of (x − ref)².
    pub rmse: f64,
    /// Mean over pixels and channels of (x − ref)² / (ref² + floor): see [`Floor`]. Infinite against a black reference with a
    /// relative floor.
    pub rel_mse: f64,
    /// Mean over pixels and channels of x − ref.
    pub bias: f64,
}

impl Floor {
    /// The default floor.
    pub const DEFAULT: Floor = Floor::Relative(0.01);

    /// The number to add for a reference with this mean squared radiance.
    pub fn of(self, mean_square: f64) -> f64 {
        match self {
            Floor::Relative(part) => part * mean_square,
            Floor::Absolute(floor) => floor,
        }
    }

    /// The number to add for this reference.
    pub fn of_picture(self, reference: &[[f32; 3]]) -> f64 {
        self.of(mean_square(reference))
    }

    /// The formula of relMSE, for display.
    pub fn formula(self) -> String {
        match self {
            Floor::Relative(part) => format!("(x − r)²/(r² + {part} · mean r²)"),
            Floor::Absolute(floor) => format!("(x − r)²/(r² + {floor})"),
        }
    }
}

/// In a word, for tables and other programs: a number, or a fraction of the reference's mean squared radiance.
impl fmt::Display for Floor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Floor::Relative(part) => write!(f, "{part} of mean square"),
            Floor::Absolute(floor) => write!(f, "{floor}"),
        }
    }
}

/// Mean over pixels and channels of the squared radiance.
pub fn mean_square(picture: &[[f32; 3]]) -> f64 {
    let sum: f64 = picture.as_flattened().iter().map(|x| f64::from(*x).powi(2)).sum();
    sum / (3 * picture.len()).max(1) as f64
}

/// A squared error, or a variance, relative to the squared radiance plus a floor; 0 if there is no error.
pub fn relative(squared: f64, radiance: f64, floor: f64) -> f64 {
    if squared == 0.0 { 0.0 } else { squared / (radiance * radiance + floor) }
}

/// Compares two images of linear radiance pixel by pixel. They must have the same length.
pub fn compare(picture: &[[f32; 3]], reference: &[[f32; 3]], floor: Floor) -> Comparison {
    assert_eq!(picture.len(), reference.len(), "images of different sizes have no error");
    let floor = floor.of_picture(reference);
    let (mut squared, mut rel_mse, mut bias) = (0.0, 0.0, 0.0);
    for (x, r) in picture.as_flattened().iter().zip(reference.as_flattened()) {
        let (x, r) = (f64::from(*x), f64::from(*r));
        let difference = x - r;
        squared += difference * difference;
        rel_mse += relative(difference * difference, r, floor);
        bias += difference;
    }
    let n = (3 * picture.len()).max(1) as f64;
    Comparison { rmse: (squared / n).sqrt(), rel_mse: rel_mse / n, bias: bias / n }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: [[f32; 3]; 2] = [[2.0, 1.0, 0.5], [0.0, 3.0, 0.25]];
    const B: [[f32; 3]; 2] = [[1.0, 1.0, 0.0], [0.5, 2.0, 1.0]];
    /// Mean over the six values of B.
    const MEAN_SQUARE: f64 = (1.0 + 1.0 + 0.25 + 4.0 + 1.0) / 6.0;

    #[test]
    fn equal_pictures_have_no_error() {
        for picture in [&A[..], &[[0.0; 3]; 4], &[]] {
            let none = Comparison { rmse: 0.0, rel_mse: 0.0, bias: 0.0 };
            assert_eq!(compare(picture, picture, Floor::DEFAULT), none);
            assert_eq!(compare(picture, picture, Floor::Absolute(0.01)), none);
        }
    }

    #[test]
    fn a_known_difference_gives_its_errors() {
        let squares = [(1.0, 1.0), (0.0, 1.0), (0.25, 0.0), (0.25, 0.25), (1.0, 4.0), (0.5625, 1.0)];
        for (floor, number) in [(Floor::DEFAULT, 0.01 * MEAN_SQUARE), (Floor::Absolute(0.02), 0.02)] {
            let c = compare(&A, &B, floor);
            assert!((c.rmse - (3.0625f64 / 6.0).sqrt()).abs() < 1e-12);
            let rel_mse = squares.iter().map(|(error, reference)| error / (reference + number)).sum::<f64>() / 6.0;
            assert!((c.rel_mse - rel_mse).abs() < 1e-12, "{floor:?}: {} {rel_mse}", c.rel_mse);
            assert!((c.bias - 1.25 / 6.0).abs() < 1e-12);
        }
    }

    #[test]
    fn the_unit_of_radiance_does_not_matter() {
        let scaled = |picture: &[[f32; 3]], scale: f32| picture.iter().map(|rgb| rgb.map(|c| c * scale)).collect::<Vec<_>>();
        let rel_mse = |scale: f32| compare(&scaled(&A, scale), &scaled(&B, scale), Floor::DEFAULT).rel_mse;
        assert_eq!([rel_mse(2f32.powi(-40)), rel_mse(2f32.powi(30))], [rel_mse(1.0); 2]);
        assert!([1e-3, 1e3].into_iter().all(|scale| (rel_mse(scale) / rel_mse(1.0) - 1.0).abs() < 1e-6));
    }

    #[test]
    fn a_black_reference_has_no_relative_error() {
        let black = [[0.0; 3]; 2];
        assert_eq!(compare(&A, &black, Floor::DEFAULT).rel_mse, f64::INFINITY);
        assert!(
            (compare(&A, &black, Floor::Absolute(0.5)).rel_mse - 2.0 * (4.0 + 1.0 + 0.25 + 9.0 + 0.0625) / 6.0).abs() < 1e-12
        );
    }

    #[test]
    fn formulas_say_their_floor() {
        assert_eq!(Floor::DEFAULT.formula(), "(x − r)²/(r² + 0.01 · mean r²)");
        assert_eq!(Floor::Absolute(0.01).formula(), "(x − r)²/(r² + 0.01)");
        assert_eq!([Floor::DEFAULT, Floor::Absolute(0.02)].map(|floor| floor.to_string()), ["0.01 of mean square", "0.02"]);
    }
}
