//! A clear sky with a sun, by one of two models.
//!
//! A. Preetham, P. Shirley and B. Smits, "A Practical Analytic Model for Daylight", SIGGRAPH 1999: of a sun at the horizon, only the part
//! of the disk above it shines. The sky of a sun below the horizon is that of a sun on the horizon: the model knows no twilight. It is
//! meant for turbidities from 2 to 6; smaller ones count as 2. Hosek and Wilkie: see `hosek.rs`. Below the horizon the environment is
//! black.
//!
//! | file | holds |
//! |---|---|
//! | `daylight.rs` | the radiance of Preetham's sky |
//! | `sun.rs` | the radiance of his sun after its way through the air |
//! | `hosek.rs` | the radiance of sky and sun by Hosek and Wilkie |
//! | `raster.rs` | the image of both |
mod daylight;
mod hosek;
mod raster;
mod sun;
#[cfg(test)]
mod tests;

use std::f64::consts::TAU;

use glam::{DMat3, DQuat, DVec3};

use self::{daylight::Daylight, hosek::Dome, raster::Raster};
use super::{
    Surrounding,
    image::{EnvironmentImage, SkyTables},
};
use noisefall_base::declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Resources, Value, words};

/// The smallest turbidity of the model.
const CLEAREST: f64 = 2.0;

/// A clear sky with a sun, in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct Sky {
    /// Direction towards the sun, of any length.
    pub sun: DVec3,
    /// Haze: 2 is very clear, 10 is hazy.
    pub turbidity: f64,
    /// Factor that multiplies the radiance of the sky.
    pub sky_scale: f64,
    /// Factor that multiplies the radiance of the sun; 0 shows the sky alone.
    pub sun_scale: f64,
    /// Where its radiance is from.
    pub model: SkyModel,
    /// Albedo of the ground, which brightens the sky of [`SkyModel::Hosek`].
    pub ground_albedo: [f64; 3],
    /// Diameter of the sun in degrees; `None` is that of the model. The irradiance stays.
    pub sun_diameter: Option<f64>,
    /// Direction upwards.
    pub zenith: DVec3,
}

words! {
    /// Models of a clear sky.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum SkyModel {
        Preetham: "preetham", "Preetham", "Preetham, Shirley and Smits 1999, in W/(m² sr).";
        Hosek: "hosek", "Hosek", "Hosek and Wilkie 2012 and 2013, in the unit of Mitsuba 3.";
    }
}

impl Default for Sky {
    fn default() -> Self {
        Sky {
            sun: DVec3::new(1.0, 1.0, 1.0),
            turbidity: 3.0,
            sky_scale: 1.0,
            sun_scale: 1.0,
            model: SkyModel::Preetham,
            ground_albedo: [0.3; 3],
            sun_diameter: None,
            zenith: DVec3::Y,
        }
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
        const SKY_SCALE: Parameter = Parameter::new("sky_scale", "Factor that multiplies the radiance of the sky.");
        const MODEL: Parameter = Parameter::new("model", "Model of the radiance.");
        const ALBEDO: Parameter = Parameter::new("ground_albedo", "Albedo of the ground, which brightens the sky of `hosek`.");
        const DIAMETER: Parameter = Parameter::new(
            "sun_diameter",
            "Angular diameter of the sun. Changing it keeps the irradiance. Default: that of the model.",
        )
        .unit("degrees");
        const ZENITH: Parameter = Parameter::new("zenith", "Direction of the zenith, of any length.");
        const SUN_SCALE: Parameter =
            Parameter::new("sun_scale", "Factor that multiplies the radiance of the sun; 0 shows the sky alone.");
        p.value(&SUN, Value::Vector(&mut self.sun));
        p.number(&TURBIDITY, &mut self.turbidity, Range::linear(1.0, 10.0));
        p.number(&SKY_SCALE, &mut self.sky_scale, Range::log(0.0, 1e12));
        p.number(&SUN_SCALE, &mut self.sun_scale, Range::log(0.0, 1e12));
        p.word(&MODEL, &mut self.model);
        p.colour(&ALBEDO, &mut self.ground_albedo, Range::UNIT);
        p.optional(
            &DIAMETER,
            &mut self.sun_diameter,
            || hosek::SUN_DIAMETER,
            |p, diameter| p.number(&DIAMETER, diameter, Range::log(0.05, 90.0)),
        );
        p.value(&ZENITH, Value::Vector(&mut self.zenith));
    }
}

impl Surrounding for Sky {
    type Radiant = EnvironmentImage;

    fn compile(&self, resources: &Resources) -> Result<Option<EnvironmentImage>, Problem> {
        let no_direction = || Problem::at("sky.sun", "the sun has no direction", "it must not be zero");
        let sun = self.sun.try_normalize().ok_or_else(no_direction)?;
        let no_zenith = || Problem::at("sky.zenith", "the zenith has no direction", "it must not be zero");
        let zenith = self.zenith.try_normalize().ok_or_else(no_zenith)?;
        // The image has its zenith at +y.
        let turn = (zenith != DVec3::Y).then(|| DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Y, zenith)));
        let sun = turn.map_or(sun, |turn| turn.transpose() * sun);
        let albedo = self.ground_albedo;
        let numbers = [sun.x, sun.y, sun.z, self.turbidity, self.sky_scale, self.sun_scale, albedo[0], albedo[1], albedo[2]];
        let key = format!("clear sky {:?} {:x?} {:?}", self.model, numbers.map(f64::to_bits), self.sun_diameter);
        let tables = resources.once("skies", key, || {
            resources.reserve("sky", "the texels and cells of a sky", SkyTables::bytes([raster::WIDTH, raster::HEIGHT]))?;
            Ok(SkyTables::new(self.raster(sun).into_texels(), 1.0, false))
        })?;
        Ok((tables.mean_luminance() > 0.0).then(|| EnvironmentImage::new(tables, 0.0).turned(turn)))
    }
}

impl Sky {
    /// The image for the unit direction `sun`, with its zenith at +y.
    fn raster(&self, sun: DVec3) -> Raster {
        match self.model {
            SkyModel::Preetham => self.preetham(sun),
            SkyModel::Hosek => self.hosek(sun),
        }
    }

    fn preetham(&self, sun: DVec3) -> Raster {
        let turbidity = self.turbidity.max(CLEAREST);
        let sky = Daylight::new(sun, turbidity);
        let mut raster = Raster::of(|direction| sky.radiance(direction).map(|x| x * self.sky_scale));
        self.add_sun(&mut raster, sun, sun::radiance(sun, turbidity), sun::SOLID_ANGLE);
        raster
    }

    fn hosek(&self, sun: DVec3) -> Raster {
        let dome = Dome::new(sun, self.turbidity, self.ground_albedo);
        let mut raster = Raster::of(|direction| {
            let radiance = dome.as_ref().map_or([0.0; 3], |dome| dome.radiance(direction));
            radiance.map(|x| x * self.sky_scale)
        });
        self.add_sun(&mut raster, sun, hosek::sun_radiance(sun, self.turbidity), disk(hosek::SUN_DIAMETER));
        raster
    }

    /// Adds the sun of a radiance and a solid angle, with the diameter that is wanted and the same irradiance.
    fn add_sun(&self, raster: &mut Raster, sun: DVec3, radiance: [f64; 3], solid_angle: f64) {
        let wanted = self.sun_diameter.map_or(solid_angle, disk);
        raster.add_sun(sun, radiance.map(|x| x * self.sun_scale * (solid_angle / wanted)), wanted);
    }
}

/// The solid angle of a disk of a diameter in degrees.
fn disk(diameter: f64) -> f64 {
    TAU * (1.0 - (0.5 * diameter).to_radians().cos())
}
