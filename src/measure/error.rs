//! How far a picture is from another.
use serde::Serialize;

/// Added to the squared reference in relMSE, so that black pixels do not divide by zero.
pub const REL_MSE_FLOOR: f64 = 0.01;

/// Errors of a picture against a reference.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// Root of the mean over pixels and channels of (x − ref)².
    pub rmse: f64,
    /// Mean over pixels and channels of (x − ref)² / (ref² + 0.01).
    pub rel_mse: f64,
    /// Mean over pixels and channels of x − ref.
    pub bias: f64,
}

/// Compares pixel by pixel. `reference` gives linear radiance; the two must be equally long.
pub fn compare(picture: &[[f32; 3]], reference: &[[f32; 3]]) -> Comparison {
    assert_eq!(picture.len(), reference.len(), "pictures of different sizes have no error");
    let (mut squared, mut relative, mut bias) = (0.0, 0.0, 0.0);
    for (x, r) in picture.iter().flatten().zip(reference.iter().flatten()) {
        let (x, r) = (f64::from(*x), f64::from(*r));
        let difference = x - r;
        squared += difference * difference;
        relative += difference * difference / (r * r + REL_MSE_FLOOR);
        bias += difference;
    }
    let n = (3 * picture.len()).max(1) as f64;
    Comparison { rmse: (squared / n).sqrt(), rel_mse: relative / n, bias: bias / n }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_pictures_have_no_error() {
        let picture = [[0.5, 0.0, 2.0], [1.0, 1.0, 1.0]];
        assert_eq!(compare(&picture, &picture), Comparison { rmse: 0.0, rel_mse: 0.0, bias: 0.0 });
    }

    #[test]
    fn a_known_difference_gives_its_errors() {
        let c = compare(&[[2.0, 1.0, 0.5]], &[[1.0, 1.0, 0.0]]);
        assert!((c.rmse - (1.25f64 / 3.0).sqrt()).abs() < 1e-12);
        assert!((c.rel_mse - (1.0 / 1.01 + 0.25 / 0.01) / 3.0).abs() < 1e-12);
        assert!((c.bias - 0.5).abs() < 1e-12);
    }
}
