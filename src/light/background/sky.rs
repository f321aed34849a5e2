//! A clear sky with a sun: A. Preetham, P. Shirley and B. Smits, "A Practical Analytic Model for Daylight", SIGGRAPH 1999.
//!
//! Up is +y. Below the horizon the background is black, and a sun that is below it shines only as far as its disk is above. The sky of
//! a sun below the horizon is that of a sun on the horizon: the model knows no twilight. It is meant for turbidities from 2 to 6;
//! smaller ones count as 2.
//!
//! | file | holds |
//! |---|---|
//! | `daylight.rs` | the radiance of the sky |
//! | `sun.rs` | the radiance of the sun after its way through the air |
//! | `raster.rs` | the image of both |
mod daylight;
mod raster;
mod sun;
#[cfg(test)]
mod tests;

use glam::DVec3;

use self::{daylight::Daylight, raster::Raster};
use super::{
    Surrounding,
    image::{ImageBackground, SkyTables},
};
use crate::declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Resources, Value};

/// The smallest turbidity of the model.
const CLEAREST: f64 = 2.0;

/// A clear sky with a sun, in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct Sky {
    /// Direction towards the sun, of any length.
    pub sun: DVec3,
    /// Haze: 2 is very clear, 10 is hazy.
    pub turbidity: f64,
    /// Factor of the radiance of the sky.
    pub sky_scale: f64,
    /// Factor of the radiance of the sun; 0 shows the sky alone.
    pub sun_scale: f64,
}

impl Default for Sky {
    fn default() -> Self {
        Sky { sun: DVec3::new(1.0, 1.0, 1.0), turbidity: 3.0, sky_scale: 1.0, sun_scale: 1.0 }
    }
}

impl Kind for Sky {
    const KIND: Parameter =
        Parameter::new("sky", "A clear sky with a sun; black below the horizon.").aliases("sunsky preetham hosek");
}

impl Declare for Sky {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const SUN: Parameter = Parameter::new("sun", "Direction towards the sun, of any length.");
        const TURBIDITY: Parameter = Parameter::new("turbidity", "Haze: 2 is very clear, 10 is hazy.").symbol("T");
        const SKY_SCALE: Parameter = Parameter::new("sky_scale", "Factor of the radiance of the sky.");
        const SUN_SCALE: Parameter = Parameter::new("sun_scale", "Factor of the radiance of the sun; 0 shows the sky alone.");
        p.value(&SUN, Value::Vector(&mut self.sun));
        p.number(&TURBIDITY, &mut self.turbidity, Range::linear(1.7, 10.0));
        p.number(&SKY_SCALE, &mut self.sky_scale, Range::log(0.0, 1e12));
        p.number(&SUN_SCALE, &mut self.sun_scale, Range::log(0.0, 1e12));
    }
}

impl Surrounding for Sky {
    type Radiant = ImageBackground;

    fn compile(&self, resources: &Resources) -> Result<Option<ImageBackground>, Problem> {
        let no_direction = || Problem::at("sky.sun", "the sun is in no direction", "it must not be zero");
        let sun = self.sun.try_normalize().ok_or_else(no_direction)?;
        let numbers = [sun.x, sun.y, sun.z, self.turbidity, self.sky_scale, self.sun_scale].map(f64::to_bits);
        let tables = resources.once("skies", format!("clear sky {numbers:x?}"), || {
            resources.reserve("sky", "the texels and cells of a sky", SkyTables::bytes([raster::WIDTH, raster::HEIGHT]))?;
            Ok(SkyTables::new(self.raster(sun).into_texels(), 1.0, false))
        })?;
        Ok((tables.mean_luminance() > 0.0).then(|| ImageBackground::new(tables, 0.0)))
    }
}

impl Sky {
    /// The image for the unit direction `sun`.
    fn raster(&self, sun: DVec3) -> Raster {
        let turbidity = self.turbidity.max(CLEAREST);
        let sky = Daylight::new(sun, turbidity);
        let mut raster = Raster::of(|direction| sky.radiance(direction).map(|x| x * self.sky_scale));
        raster.add_sun(sun, sun::radiance(sun, turbidity).map(|x| x * self.sun_scale));
        raster
    }
}
