//! Lights.
//!
//! A light of RGB L has radiance L: pbrt divides light by the luminance of its illuminant, and its sensor does not scale it back. All
//! other spectra have luminance 1. `scale` and `power` multiply that, and so does the film.
//!
//! | lights | file |
//! |---|---|
//! | `point`, `spot`, `distant`, `goniometric`, `projection` | `lamps.rs` |
//! | `infinite` | `infinite.rs`, images in `octahedron.rs` |
//! | `diffuse` of surfaces | `area.rs` |
mod area;
mod infinite;
mod lamps;
mod octahedron;

use glam::DAffine3;

use super::{import::Import, parameters::Entity, spectra::Role};
use crate::scene::SceneError;

/// The largest number of a light that a description allows.
const BRIGHTEST: f64 = 1e15;

impl Import {
    /// `LightSource`, with the transform to the world.
    pub fn light(&mut self, entity: &Entity, map: DAffine3) -> Result<(), SceneError> {
        let map = self.mirror * map;
        match entity.kind.as_str() {
            "point" => self.point_lamp(entity, &map)?,
            "spot" => self.spot_lamp(entity, &map)?,
            "distant" => self.distant_lamp(entity, &map)?,
            "goniometric" => self.goniometric_lamp(entity, &map)?,
            "projection" => self.projection_lamp(entity, &map)?,
            "infinite" => self.infinite(entity, &map)?,
            other => {
                return Err(entity.error(format!("`{other}` is not a light of pbrt-v4"), "such as point, distant or infinite"));
            }
        }
        self.remark_unused(entity);
        Ok(())
    }

    /// The colour of a light times its scale, without its power; `name` is `L` or `I`.
    fn light_colour(&mut self, entity: &Entity, name: &str) -> Result<[f64; 3], SceneError> {
        let colour = self.constant_colour(entity, name, Role::Light)?.unwrap_or([1.0; 3]);
        let scale = entity.float("scale", 1.0)? * self.gain;
        Ok(times(colour, scale))
    }
}

/// A colour times a number, within the limits of a description.
fn times(colour: [f64; 3], factor: f64) -> [f64; 3] {
    colour.map(|x| (x * factor).clamp(0.0, BRIGHTEST))
}

/// The factor of a power in lumens over that of a light without scale; 1 without power.
fn power(entity: &Entity, emitted: f64) -> Result<f64, SceneError> {
    Ok(match entity.float("power", -1.0)? {
        power if power > 0.0 && emitted > 0.0 => power / emitted,
        _ => 1.0,
    })
}
