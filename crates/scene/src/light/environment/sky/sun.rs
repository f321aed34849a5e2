//! The radiance of the sun after its way through the air: Preetham, Shirley and Smits 1999, appendix A.1, with data of M. Iqbal, "An
//! Introduction to Solar Radiation", 1983.
//!
//! Rayleigh scattering, aerosols and ozone attenuate the light at each wavelength. Mixed gases and water vapour absorb above 690 nm,
//! where the eye hardly sees; they are left out.
use glam::DVec3;

use super::daylight::LUMENS_PER_WATT;
use noisefall_base::math::temperature::{REC_709, matching, times};

/// Solid angle of the sun, sr: a disk with a diameter of 1.39·10⁹ m at 1.5·10¹¹ m.
pub const SOLID_ANGLE: f64 = 6.7443e-5;

/// Wavelengths of the tables from 380 nm on, nm apart.
const FIRST: f64 = 380.0;
const STEP: f64 = 10.0;

/// Radiance of the sun outside of the air, 100 W/(m² sr nm).
const SUN: [f64; 38] = [
    165.59, 162.337, 211.275, 258.882, 258.291, 242.323, 267.605, 296.583, 305.454, 300.575, 306.637, 288.304, 287.121, 278.25,
    271.006, 272.336, 263.613, 255.038, 250.602, 253.116, 253.559, 251.342, 246.315, 241.732, 236.853, 232.121, 228.277, 223.398,
    219.702, 215.267, 210.979, 207.284, 202.404, 198.708, 194.272, 190.724, 186.289, 182.592,
];

/// Absorption of ozone, 1/cm.
const OZONE: [f64; 38] = [
    0.0, 0.0, 0.0, 0.001, 0.001, 0.002, 0.003, 0.003, 0.006, 0.009, 0.014, 0.021, 0.030, 0.040, 0.048, 0.063, 0.075, 0.085,
    0.103, 0.120, 0.120, 0.115, 0.125, 0.120, 0.105, 0.090, 0.079, 0.067, 0.057, 0.048, 0.036, 0.028, 0.023, 0.018, 0.014, 0.011,
    0.010, 0.009,
];

/// Lumens of a watt at the maximum of the eye's sensitivity.
const MOST_LUMENS: f64 = 683.0;

/// The radiance of the sun in a unit direction, W·sr⁻¹·m⁻², linear Rec. 709. Channels outside the gamut are 0. A sun below the horizon
/// counts as one on it.
pub fn radiance(sun: DVec3, turbidity: f64) -> [f64; 3] {
    let cos = sun.y.clamp(0.0, 1.0);
    let air = air_mass(cos);
    let wavelengths = SUN.iter().zip(&OZONE).zip(0..);
    let xyz = wavelengths.fold([0.0; 3], |sum, ((light, ozone), step)| {
        let nm = FIRST + STEP * f64::from(step);
        let light = 100.0 * light * (-air * attenuation(nm, turbidity, *ozone)).exp() * STEP;
        let weights = matching(nm);
        [0, 1, 2].map(|i| sum[i] + weights[i] * light)
    });
    times(&REC_709, xyz).map(|x| (x * MOST_LUMENS / LUMENS_PER_WATT).max(0.0))
}

/// The way through the air, relative to that of a sun in the zenith (F. Kasten 1965).
fn air_mass(cos: f64) -> f64 {
    1.0 / (cos + 0.15 * (93.885 - cos.acos().to_degrees()).powf(-1.253))
}

/// Optical depth of the air above, for light from the zenith.
fn attenuation(nm: f64, turbidity: f64, ozone: f64) -> f64 {
    /// Height of the ozone at normal pressure, cm.
    const HEIGHT: f64 = 0.35;
    let micrometres = nm / 1000.0;
    let rayleigh = 0.008735 * micrometres.powf(-4.08);
    let aerosols = (0.04608 * turbidity - 0.04586) * micrometres.powf(-1.3);
    rayleigh + aerosols + ozone * HEIGHT
}
