//! The radiance of a clear sky and of its sun: L. Hosek and A. Wilkie, "An Analytic Model for Full Spectral Sky-Dome Radiance",
//! SIGGRAPH 2012, and "Adding a Solar-Radiance Function to the Hošek–Wilkie Skylight Model", IEEE CG&A 33(3), 2013.
//!
//! `hosek.bin` holds little-endian numbers of 32 bits in linear Rec. 709: for each turbidity from 1 to 10, albedo of the ground of 0 and
//! 1, control point of the sun's elevation and channel the nine parameters of the sky's distribution and its mean radiance; then for each
//! turbidity, elevation of the sun from 2° to 88° and channel the mean radiance of the sun. They are those of Mitsuba 3, with its unit of
//! radiance: 1/106.75 of W/(m² sr) times the luminous efficacy.
use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

/// Diameter of the sun in the data, degrees.
pub const SUN_DIAMETER: f64 = 0.5358;

/// Divides the numbers of the file: the integral of the CIE 1931 curve ȳ, nm.
const UNIT: f64 = 106.750_259;
const TURBIDITIES: usize = 10;
const CONTROL_POINTS: usize = 6;
/// Parameters of the distribution and its mean, of three channels.
const COLUMNS: usize = 30;
/// Parameters of an albedo.
const OF_ALBEDO: usize = CONTROL_POINTS * COLUMNS;
const ELEVATIONS: usize = 30;
/// Elevations of the first and of the last sun, degrees.
const LOWEST: f64 = 2.0;
const HIGHEST: f64 = 88.0;
/// Numbers before those of the sun.
const OF_SKY: usize = TURBIDITIES * 2 * OF_ALBEDO;
static DATA: &[u8; 4 * (OF_SKY + TURBIDITIES * ELEVATIONS * 3)] = include_bytes!("hosek.bin");

fn number(index: usize) -> f64 {
    let bytes = DATA[4 * index..4 * index + 4].try_into().unwrap_or_default();
    f64::from(f32::from_le_bytes(bytes))
}

/// The two of `count` entries around a place, and the fraction from the first to the second.
fn between(place: f64, count: usize) -> ([usize; 2], f64) {
    let place = place.clamp(0.0, (count - 1) as f64);
    let first = (place as usize).min(count - 2);
    ([first, first + 1], place - first as f64)
}

fn mix(a: f64, b: f64, fraction: f64) -> f64 {
    a + (b - a) * fraction
}

/// A clear sky without its sun.
pub struct Dome {
    sun: DVec3,
    /// Nine parameters and the mean radiance of each channel.
    channels: [[f64; 10]; 3],
}

impl Dome {
    /// The sky of a turbidity over ground of an albedo, with the sun in a unit direction. `None` if the sun is below the horizon: the model
    /// knows no night.
    pub fn new(sun: DVec3, turbidity: f64, albedo: [f64; 3]) -> Option<Dome> {
        if sun.y < 0.0 {
            return None;
        }
        let elevation = sun.y.clamp(0.0, 1.0).asin();
        let x = (elevation / FRAC_PI_2).cbrt();
        const BINOMIALS: [f64; CONTROL_POINTS] = [1.0, 5.0, 10.0, 10.0, 5.0, 1.0];
        let weight = |i: usize| BINOMIALS[i] * x.powi(i as i32) * (1.0 - x).powi((CONTROL_POINTS - 1 - i) as i32);
        let (turbidities, hazier) = between(turbidity - 1.0, TURBIDITIES);
        let value = |channel: usize, parameter: usize| {
            let of_ground = |turbidity: usize, albedo: usize| {
                let start = (turbidity * 2 + albedo) * OF_ALBEDO + channel * 10 + parameter;
                (0..CONTROL_POINTS).map(|i| weight(i) * number(start + i * COLUMNS)).sum::<f64>()
            };
            let [a, b] = turbidities.map(|turbidity| mix(of_ground(turbidity, 0), of_ground(turbidity, 1), albedo[channel]));
            mix(a, b, hazier)
        };
        let channels = [0, 1, 2].map(|channel| std::array::from_fn(|parameter| value(channel, parameter)));
        Some(Dome { sun, channels })
    }

    /// The radiance from a unit direction above the horizon. Channels outside the gamut are 0.
    pub fn radiance(&self, direction: DVec3) -> [f64; 3] {
        let cos = direction.y.max(0.0);
        let cos_gamma = direction.dot(self.sun).clamp(-1.0, 1.0);
        let gamma = cos_gamma.acos();
        self.channels.map(|[a, b, c, d, e, f, g, h, i, mean]| {
            let chi = (1.0 + cos_gamma * cos_gamma) / (1.0 + i * i - 2.0 * i * cos_gamma).powf(1.5);
            let of_zenith = 1.0 + a * (b / (cos + 0.01)).exp();
            let of_sun = c + d * (e * gamma).exp() + f * cos_gamma * cos_gamma + g * chi + h * cos.sqrt();
            (of_zenith * of_sun * mean / UNIT).max(0.0)
        })
    }
}

/// The mean radiance of a sun of [`SUN_DIAMETER`] in a unit direction, which is 0 below the horizon. Channels outside the gamut are 0.
pub fn sun_radiance(sun: DVec3, turbidity: f64) -> [f64; 3] {
    if sun.y < 0.0 {
        return [0.0; 3];
    }
    let degrees = sun.y.clamp(0.0, 1.0).asin() * 180.0 / PI;
    let (turbidities, hazier) = between(turbidity - 1.0, TURBIDITIES);
    let (elevations, higher) = between((degrees - LOWEST) / (HIGHEST - LOWEST) * (ELEVATIONS - 1) as f64, ELEVATIONS);
    [0, 1, 2].map(|channel| {
        let [a, b] = turbidities.map(|turbidity| {
            let [low, high] = elevations.map(|elevation| number(OF_SKY + (turbidity * ELEVATIONS + elevation) * 3 + channel));
            mix(low, high, higher)
        });
        (mix(a, b, hazier) / UNIT).max(0.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn direction([x, y, z]: [f64; 3]) -> DVec3 {
        DVec3::new(x, y, z).normalize()
    }

    fn sun(elevation: f64) -> DVec3 {
        let (sin, cos) = elevation.to_radians().sin_cos();
        DVec3::new(cos, sin, 0.0)
    }

    fn assert_near(found: [f64; 3], expected: [f64; 3], tolerance: f64) {
        let same = found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= tolerance * b.abs());
        assert!(same, "{found:?} {expected:?}");
    }

    /// Turbidity, albedo, elevation of the sun, direction, and the radiance of `sunsky` in Mitsuba 3.9 without its sun.
    type Sky = (f64, f64, f64, [f64; 3], [f64; 3]);
    const SKIES: [Sky; 4] = [
        (3.0, 0.3, 30.0, [1.0, 0.5, 0.3], [0.170_177_24, 0.201_216_35, 0.228_313_25]),
        (4.4, 0.0, 51.0, [-1.0, 0.5, 0.3], [0.036_058_49, 0.064_781_52, 0.118_627_31]),
        (3.0, 0.6, 5.0, [0.0, 0.1, 1.0], [0.059_352_43, 0.063_948_91, 0.045_480_14]),
        (1.0, 0.3, 89.0, [0.1, 1.0, 0.1], [0.030_341_96, 0.066_433_98, 0.115_052_6]),
    ];

    #[test]
    fn the_sky_is_that_of_mitsuba() {
        for (turbidity, albedo, elevation, place, expected) in SKIES {
            let dome = Dome::new(sun(elevation), turbidity, [albedo; 3]).expect("the sun is above the horizon");
            assert_near(dome.radiance(direction(place)), expected, 1e-5);
        }
    }

    #[test]
    fn the_sun_is_that_of_mitsuba() {
        assert_near(sun_radiance(sun(30.0), 3.0), [20_274.44, 15_949.582, 10_618.099], 1e-3);
        assert_near(sun_radiance(sun(51.0), 4.4), [20_631.02, 17_021.17, 12_847.756], 1e-3);
        assert_near(sun_radiance(sun(1.0), 1.0), [7058.031, 2011.4851, 0.0], 1e-3);
    }

    #[test]
    fn all_skies_are_finite_and_there_is_none_at_night() {
        for turbidity in [-1.0, 1.0, 5.5, 10.0, 99.0] {
            for elevation in [0.0, 1e-6, 0.5, 45.0, 90.0] {
                let dome = Dome::new(sun(elevation), turbidity, [0.0, 0.5, 1.0]).expect("the sun is above the horizon");
                for place in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.1, 0.3]] {
                    let radiance = dome.radiance(direction(place));
                    assert!(radiance.iter().all(|x| x.is_finite() && *x >= 0.0), "{turbidity} {elevation} {radiance:?}");
                }
                assert!(sun_radiance(sun(elevation), turbidity).iter().all(|x| x.is_finite() && *x >= 0.0));
            }
        }
        assert!(Dome::new(sun(-1.0), 3.0, [0.3; 3]).is_none());
        assert_eq!(sun_radiance(sun(-1.0), 3.0), [0.0; 3]);
    }
}
