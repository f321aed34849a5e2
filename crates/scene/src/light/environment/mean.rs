//! The mean colour of an environment.
use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::Environment;
use noisefall_base::math::{One, V, colour::luminance};

/// Bands from pole to pole; each has twice as many directions.
const BANDS: u32 = 64;

impl Environment {
    /// The mean radiance over all directions. Its luminance is that of [`Environment::luminance`]; its hue is that of a grid of
    /// directions, which may miss a sun.
    pub fn mean(&self) -> [f32; 3] {
        let mut sum = DVec3::ZERO;
        for (band, step) in (0..BANDS).flat_map(|band| (0..2 * BANDS).map(move |step| (band, step))) {
            let (sin, cos) = (PI * (f64::from(band) + 0.5) / f64::from(BANDS)).sin_cos();
            let (y, x) = (TAU * (f64::from(step) + 0.5) / f64::from(2 * BANDS)).sin_cos();
            let d = DVec3::new(sin * x, cos, sin * y).as_vec3().to_array();
            let [r, g, b] = self.radiance(One, V::splat(One, d)).lane(0).map(f64::from);
            sum += DVec3::new(r, g, b) * sin;
        }
        let hue = sum.as_vec3().to_array();
        let (of_hue, exact) = (luminance(hue), self.luminance());
        if of_hue > 0.0 { hue.map(|x| x * (exact / of_hue)) } else { [exact; 3] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::environment::{EnvironmentDescription, constant::Constant, sky::Sky};
    use noisefall_base::declare::Resources;

    fn compiled(kind: impl Into<EnvironmentDescription>) -> Environment {
        kind.into().compile(&Resources::new("")).unwrap_or_else(|problem| panic!("{problem}")).expect("it is not black")
    }

    #[test]
    fn the_mean_of_a_constant_is_the_constant_and_that_of_a_sky_is_blue() {
        let constant = compiled(Constant { radiance: [0.5, 0.25, 2.0] }).mean();
        assert!([0.5, 0.25, 2.0].iter().zip(constant).all(|(exact, found)| (found / exact - 1.0).abs() < 1e-5), "{constant:?}");
        let sky = compiled(Sky::default());
        let [r, g, b] = sky.mean();
        assert!((luminance([r, g, b]) / sky.luminance() - 1.0).abs() < 1e-5);
        assert!(b > r, "{r} {g} {b}");
    }
}
