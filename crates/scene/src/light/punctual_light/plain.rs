//! The light of the simplest kind with the power of another one, for formats that do not know its kind.
use std::f64::consts::PI;

use glam::DVec3;

use super::{PunctualLight, PunctualLightKind, PunctualLights, directional::Directional, point::Point};
use noisefall_base::math::{One, U, V};

/// Directions of a mean. A cone of 1° contains ten of them.
const DIRECTIONS: u32 = 1 << 17;

impl PunctualLight {
    /// A point light with the mean intensity over all directions, or a directional light with the same irradiance.
    pub fn plain(self) -> PunctualLightKind {
        if let Some((towards, irradiance)) = self.far_light() {
            return Directional { direction: -towards, irradiance: irradiance.map(f64::from) }.into();
        }
        let position = self.position().unwrap_or_default();
        Point { position, intensity: mean_intensity(self) }.into()
    }
}

/// The mean of the radiant intensity over all directions, W/sr.
fn mean_intensity(punctual_light: PunctualLight) -> [f64; 3] {
    let punctual_lights = PunctualLights::new(&[punctual_light.at_origin()]);
    let mut sum = DVec3::ZERO;
    for i in 0..DIRECTIONS {
        let d = spiral(i).as_vec3().to_array();
        // At a distance of 1 m, the irradiance is the intensity.
        let [r, g, b] = punctual_lights.sample(One, U(0), V::splat(One, d)).irradiance.lane(0).map(f64::from);
        sum += DVec3::new(r, g, b);
    }
    (sum / f64::from(DIRECTIONS)).to_array()
}

/// The `i`-th of [`DIRECTIONS`] points that are spread evenly over the unit sphere along a spiral (Swinbank and Purser, "Fibonacci
/// grids", 2006).
fn spiral(i: u32) -> DVec3 {
    let golden_angle = PI * (3.0 - 5.0_f64.sqrt());
    let z = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(DIRECTIONS);
    let (sin, cos) = (golden_angle * f64::from(i)).sin_cos();
    let r = (1.0 - z * z).sqrt();
    DVec3::new(r * cos, r * sin, z)
}

#[cfg(test)]
mod tests {
    use glam::DAffine3;

    use super::*;
    use crate::light::punctual_light::spot::{Falloff, Spot};
    use noisefall_base::declare::Resources;

    fn plain(kind: impl Into<PunctualLightKind>) -> PunctualLightKind {
        let place = DAffine3::from_translation(DVec3::new(3.0, -1.0, 2.0));
        kind.into().kind().compile(&place, &Resources::new("")).unwrap_or_else(|problem| panic!("{problem}")).plain()
    }

    #[test]
    fn a_light_without_a_position_stays_as_it_is() {
        let sun = Directional { direction: DVec3::new(0.0, -2.0, 0.0), irradiance: [3.0, 2.0, 1.0] };
        assert_eq!(plain(sun.clone()), Directional { direction: DVec3::NEG_Y, ..sun }.into());
    }

    #[test]
    fn a_point_light_has_the_power_of_a_spot() {
        for angle in [10.0, 40.0, 120.0_f64] {
            let spot = Spot { intensity: [4.0, 2.0, 1.0], angle, inner: angle, falloff: Falloff::Smooth, ..Spot::default() };
            let PunctualLightKind::Point(point) = plain(spot.clone()) else { panic!("a point light") };
            assert_eq!(point.position, spot.position + DVec3::new(3.0, -1.0, 2.0));
            let share = 0.5 * (1.0 - angle.to_radians().cos());
            for (found, intensity) in point.intensity.iter().zip(spot.intensity) {
                assert!((found / (intensity * share) - 1.0).abs() < 0.01, "{angle}°: {found}");
            }
        }
    }
}
