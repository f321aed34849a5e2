//! White balance: adapts colours from the white of the light in the scene to that of the display.
//!
//! Whites are the reference illuminants of CIE 224:2017 (ANSI/IES TM-30): black bodies below 4000 K, daylight above 5000 K, and mixtures
//! between. The adaptation is that of Bradford (Lam 1985; ICC.1:2022, annex E).
use glam::{DMat3, DVec3};
use serde::Serialize;

use noisefall_base::math::temperature::{REC_709, XYZ, planck, uv};

/// The light that appears white.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct WhiteBalance {
    /// Its correlated colour temperature, kelvin, within [`Self::KELVIN`]. Lower ones make the image bluer.
    pub kelvin: f32,
    /// Its distance from the locus of whites, in units of 1/3000 of CIE 1960 u, v as in the Adobe DNG SDK, within [`Self::TINT`].
    /// Positive ones are green light, and make the image more magenta.
    pub tint: f32,
}

/// From CIE XYZ to the responses of cones, row by row.
const BRADFORD: [[f64; 3]; 3] = [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]];
/// Units of tint in a distance of 1.
const TINT_SCALE: f64 = 3000.0;
/// Largest factor of a cone's response. Warm green whites would lie outside the colours that exist.
const LARGEST_FACTOR: f64 = 20.0;

impl Default for WhiteBalance {
    fn default() -> Self {
        WhiteBalance::NEUTRAL
    }
}

impl WhiteBalance {
    /// The white of the display, D65: colours stay as they are, bit for bit.
    pub const NEUTRAL: WhiteBalance = WhiteBalance { kelvin: 6504.0, tint: 0.0 };
    /// The range of temperatures: up to the end of the daylight series.
    pub const KELVIN: [f32; 2] = [2000.0, 25_000.0];
    /// The range of tints.
    pub const TINT: [f32; 2] = [-150.0, 150.0];

    /// The matrix of linear Rec. 709 colours, row by row; `None` if they stay as they are.
    pub fn matrix(&self) -> Option<[[f32; 3]; 3]> {
        if *self == WhiteBalance::NEUTRAL {
            return None;
        }
        let cones = rows(&BRADFORD);
        let [from, to] = [self, &WhiteBalance::NEUTRAL].map(|balance| cones * balance.white());
        let factors = (to / from.max(to / LARGEST_FACTOR)).max(DVec3::ZERO);
        let adapted = cones.inverse() * DMat3::from_diagonal(factors) * cones;
        let matrix = rows(&REC_709) * adapted * rows(&XYZ);
        Some(matrix.transpose().to_cols_array_2d().map(|row| row.map(|x| x as f32)))
    }

    /// CIE XYZ of the white, with Y = 1.
    fn white(&self) -> DVec3 {
        let kelvin = f64::from(self.kelvin);
        let [u, v] = on_locus(kelvin);
        // Along the locus, by a hundredth of the temperature to both sides.
        let ([u0, v0], [u1, v1]) = (on_locus(1.01 * kelvin), on_locus(0.99 * kelvin));
        let length = (u1 - u0).hypot(v1 - v0);
        let duv = f64::from(self.tint) / TINT_SCALE;
        let (u, v) = (u - duv * (v1 - v0) / length, v + duv * (u1 - u0) / length);
        // CIE 15:2018, section 9: x and y of u and v.
        let scale = 2.0 * u - 8.0 * v + 4.0;
        of_chromaticity(3.0 * u / scale, 2.0 * v / scale)
    }
}

/// CIE 1960 u and v of the white of a temperature.
fn on_locus(kelvin: f64) -> [f64; 2] {
    let daylight = ((kelvin - 4000.0) / 1000.0).clamp(0.0, 1.0);
    let black_body = DVec3::from(planck(kelvin));
    let white = (black_body / black_body.y).lerp(daylight_white(kelvin.max(4000.0)), daylight);
    uv(white.to_array()).unwrap_or_default()
}

/// CIE XYZ of daylight from 4000 K on, with Y = 1 (CIE 15:2018, equations 4.5 to 4.7).
fn daylight_white(kelvin: f64) -> DVec3 {
    let t = 1000.0 / kelvin;
    let x = if kelvin <= 7000.0 {
        ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244_063
    } else {
        ((-2.0064 * t + 1.9018) * t + 0.24748) * t + 0.237_040
    };
    of_chromaticity(x, (-3.0 * x + 2.870) * x - 0.275)
}

fn of_chromaticity(x: f64, y: f64) -> DVec3 {
    DVec3::new(x / y, 1.0, (1.0 - x - y) / y)
}

fn rows(rows: &[[f64; 3]; 3]) -> DMat3 {
    DMat3::from_cols_array_2d(rows).transpose()
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_base::math::{colour::luminance, temperature::black_body};

    fn balanced(balance: WhiteBalance, rgb: [f64; 3]) -> [f32; 3] {
        let matrix = balance.matrix().expect("it is not neutral");
        matrix.map(|row| (0..3).map(|i| row[i] * rgb[i] as f32).sum())
    }

    #[test]
    fn the_neutral_one_has_no_matrix_and_those_beside_it_hardly_change_anything() {
        assert_eq!(WhiteBalance::default().matrix(), None);
        for (kelvin, tint) in [(6504.01, 0.0), (6504.0, 0.001)] {
            let matrix = WhiteBalance { kelvin, tint }.matrix().expect("it is not neutral");
            let far = |row: usize, column: usize| (matrix[row][column] - f32::from(u8::from(row == column))).abs();
            assert!((0..9).all(|i| far(i / 3, i % 3) < 1e-4), "{matrix:?}");
        }
    }

    #[test]
    fn the_neutral_white_is_d65() {
        // CIE 15:2018, table T.3: x = 0.31272, y = 0.32903.
        let white = WhiteBalance::NEUTRAL.white();
        let sum = white.element_sum();
        assert!((white.x / sum - 0.31272).abs() < 1e-4 && (white.y / sum - 0.32903).abs() < 1e-4, "{white}");
    }

    #[test]
    fn a_light_of_its_temperature_becomes_grey() {
        for kelvin in [2000.0, 2700.0, 3200.0, 3999.0] {
            let found = balanced(WhiteBalance { kelvin: kelvin as f32, tint: 0.0 }, black_body(kelvin));
            assert!(found.iter().all(|c| (c / found[1] - 1.0).abs() < 2e-3), "{kelvin} K: {found:?}");
            assert!((luminance(found) - 1.0).abs() < 2e-3);
        }
    }

    #[test]
    fn low_temperatures_make_white_bluer_and_green_light_makes_it_more_magenta() {
        let white = |kelvin, tint| balanced(WhiteBalance { kelvin, tint }, [1.0; 3]);
        let ([r, _, b], [r2, _, b2]) = (white(4000.0, 0.0), white(12_000.0, 0.0));
        assert!(b > 1.2 && r < 0.9 && b2 < 0.9 && r2 > 1.05, "{r} {b} {r2} {b2}");
        let ([r, g, b], [r2, g2, b2]) = (white(6504.0, 30.0), white(6504.0, -30.0));
        assert!(g < r.min(b) && g2 > r2.max(b2), "{r} {g} {b}; {r2} {g2} {b2}");
    }

    /// Illuminant A is a black body; D50 and D75 are daylight (CIE 15:2018, table T.3).
    #[test]
    fn whites_are_the_illuminants_of_the_standard() {
        for (kelvin, x, y) in [(2856.0, 0.44758, 0.40745), (5003.0, 0.34567, 0.35851), (7504.0, 0.29903, 0.31488)] {
            let white = WhiteBalance { kelvin, tint: 0.0 }.white();
            let sum = white.element_sum();
            assert!((white.x / sum - x).abs() < 2e-3 && (white.y / sum - y).abs() < 2e-3, "{kelvin}: {white}");
        }
    }

    #[test]
    fn all_factors_are_finite_and_continuous_over_the_whole_range() {
        for tint in [-150.0, -20.0, 0.0, 20.0, 150.0] {
            let matrix = |kelvin| WhiteBalance { kelvin, tint }.matrix().expect("it is not neutral");
            let mut last = matrix(2000.0);
            for step in 1..=1200u16 {
                let next = matrix(2000.0 + 10.0 * f32::from(step));
                let is_near = |(a, b): (&f32, &f32)| (a - b).abs() < 0.1 * (1.0 + b.abs());
                let pairs = || last.as_flattened().iter().zip(next.as_flattened());
                assert!(next.as_flattened().iter().all(|x| x.is_finite()) && pairs().all(is_near), "{tint} at {step}: {next:?}");
                last = next;
            }
        }
    }
}
