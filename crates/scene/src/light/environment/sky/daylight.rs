//! The radiance of a clear sky: Preetham, Shirley and Smits 1999, appendix A.2.
use std::f64::consts::PI;

use glam::DVec3;

use noisefall_base::math::temperature::{REC_709, times};

/// Lumens of a watt of light whose spectrum is constant over the visible range: it makes radiances, W·sr⁻¹·m⁻², of luminances, cd/m²
/// (G. Ward, "The RADIANCE Lighting Simulation and Rendering System", SIGGRAPH 1994).
pub const LUMENS_PER_WATT: f64 = 179.0;

/// A clear sky without its sun.
pub struct Daylight {
    sun: DVec3,
    /// Luminance, cd/m², and CIE x and y of the zenith, over the values of their distributions there.
    zenith: [f64; 3],
    /// Coefficients A to E of the distributions of luminance, x and y.
    coefficients: [[f64; 5]; 3],
}

impl Daylight {
    /// The sky of a turbidity, with the sun in a unit direction. A sun below the horizon counts as one on it.
    pub fn new(sun: DVec3, turbidity: f64) -> Daylight {
        let sun = sun.with_y(sun.y.max(0.0)).try_normalize().unwrap_or(DVec3::X);
        let theta = sun.y.clamp(0.0, 1.0).acos();
        let t = turbidity;
        let coefficients = [
            [0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771, -0.0670 * t + 0.3703],
            [-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989, -0.0033 * t + 0.0452],
            [-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537, -0.0109 * t + 0.0529],
        ];
        let chi = (4.0 / 9.0 - t / 120.0) * (PI - 2.0 * theta);
        let luminance = 1000.0 * ((4.0453 * t - 4.9710) * chi.tan() - 0.2155 * t + 2.4192);
        let x = chromaticity(
            t,
            theta,
            [[0.00166, -0.00375, 0.00209, 0.0], [-0.02903, 0.06377, -0.03202, 0.00394], [0.11693, -0.21196, 0.06052, 0.25886]],
        );
        let y = chromaticity(
            t,
            theta,
            [[0.00275, -0.00610, 0.00317, 0.0], [-0.04214, 0.08970, -0.04153, 0.00516], [0.15346, -0.26756, 0.06670, 0.26688]],
        );
        let values = [luminance, x, y];
        let zenith = [0, 1, 2].map(|i| values[i] / perez(&coefficients[i], 1.0, theta));
        Daylight { sun, zenith, coefficients }
    }

    /// The radiance from a unit direction above the horizon, W·sr⁻¹·m⁻², linear Rec. 709. Channels outside the gamut are 0.
    pub fn radiance(&self, direction: DVec3) -> [f64; 3] {
        /// Cosine to the zenith of the lowest direction that is distinguished from the horizon.
        const LOWEST: f64 = 1e-4;
        let gamma = direction.dot(self.sun).clamp(-1.0, 1.0).acos();
        let cos = direction.y.max(LOWEST);
        let [luminance, x, y] = [0, 1, 2].map(|i| self.zenith[i] * perez(&self.coefficients[i], cos, gamma));
        let scale = luminance / (y * LUMENS_PER_WATT);
        times(&REC_709, [x * scale, y * scale, (1.0 - x - y) * scale]).map(|channel| channel.max(0.0))
    }
}

/// The distribution of Perez, Seals and Michalsky 1993, with the cosine to the zenith and the angle to the sun.
fn perez([a, b, c, d, e]: &[f64; 5], cos: f64, gamma: f64) -> f64 {
    (1.0 + a * (b / cos).exp()) * (1.0 + c * (d * gamma).exp() + e * gamma.cos().powi(2))
}

/// A chromaticity of the zenith: polynomials of the turbidity, whose coefficients are polynomials of the sun's angle to the zenith.
fn chromaticity(turbidity: f64, theta: f64, rows: [[f64; 4]; 3]) -> f64 {
    let of_theta = |row: [f64; 4]| row.iter().fold(0.0, |sum, x| sum * theta + x);
    rows.into_iter().fold(0.0, |sum, row| sum * turbidity + of_theta(row))
}
