//! Scale, shear, rotation and offset of texture coordinates.
use super::Image;
use noisefall_base::{
    declare::Problem,
    math::{F, Lanes},
};

/// An affine map from the coordinates of a surface to those of an image: rows (∂/∂u, ∂/∂v, offset) of each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UvMap(pub [[f64; 3]; 2]);

impl UvMap {
    /// The map of an image's settings: first its scale, then its shear, its rotation from u towards v,
    /// and its offset. Fails for numbers that
    /// f32 has no room for.
    pub fn new(image: &Image) -> Result<UvMap, Problem> {
        /// The lookup resolves a thousandth of an image beyond this distance from it.
        const MOST: f64 = 1e4;
        for (key, pair) in [("scale", image.scale), ("offset", image.offset)] {
            if pair.iter().any(|x| x.is_nan() || x.abs() > MOST) {
                return Err(Problem::at(
                    key,
                    format!("`{key}` is out of range"),
                    format!("expected numbers from −{MOST} to {MOST}"),
                ));
            }
        }
        let ([scale_u, scale_v], [u, v]) = (image.scale, image.offset);
        let (sin, cos) = sin_cos_degrees(image.rotate);
        let [along_u, along_v] = [cos * image.shear - sin, sin * image.shear + cos];
        Ok(UvMap([[cos * scale_u, along_u * scale_v, u], [sin * scale_u, along_v * scale_v, v]]))
    }

    /// The coordinates in the image.
    #[inline(always)]
    pub fn apply<L: Lanes>(&self, u: F<L>, v: F<L>) -> [F<L>; 2] {
        let [[a, b, c], [d, e, f]] = self.0;
        [u * a as f32 + v * b as f32 + c as f32, u * d as f32 + v * e as f32 + f as f32]
    }

    /// The intervals of both coordinates of the image over the unit square, if each depends on only one of u and v. Their product is
    /// then the image of the unit square.
    pub fn intervals(&self) -> Option<[[f64; 2]; 2]> {
        let [[a, b, c], [d, e, f]] = self.0;
        let is_aligned = (b == 0.0 && d == 0.0) || (a == 0.0 && e == 0.0);
        is_aligned.then_some([[c, a + b + c], [f, d + e + f]])
    }
}

/// Exact for quarters of a turn.
fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        degrees => degrees.to_radians().sin_cos(),
    }
}
