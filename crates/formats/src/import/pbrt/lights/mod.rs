//! Lights.
//!
//! A light of RGB L has radiance L: pbrt divides light by the luminance of its illuminant, and its sensor does not scale it back. All
//! other spectra have luminance 1. `scale` and `power` multiply that, and so does the film.
//!
//! | lights | file |
//! |---|---|
//! | `point`, `spot`, `distant`, `goniometric`, `projection` | `lights.rs` |
//! | `infinite` | `infinite.rs`, images in `octahedron.rs` |
//! | `diffuse` of surfaces | `area.rs` |
mod area;
mod infinite;
mod octahedron;
mod punctual_lights;

use glam::DAffine3;

use super::{import::Import, parameters::Entity, spectra::Role};
use noisefall_scene::scene::SceneError;

/// The largest number of a light that a description allows.
const BRIGHTEST: f64 = 1e15;

impl Import {
    /// `LightSource`, with the transform to the world.
    pub fn light(&mut self, entity: &Entity, map: DAffine3) -> Result<(), SceneError> {
        let map = self.mirror * map;
        match entity.kind.as_str() {
            "point" => self.point_light(entity, &map)?,
            "spot" => self.spot_light(entity, &map)?,
            "distant" => self.distant_light(entity, &map)?,
            "goniometric" => self.goniometric_light(entity, &map)?,
            "projection" => self.projection_light(entity, &map)?,
            "infinite" => self.infinite(entity, &map)?,
            other => {
                return Err(entity.error(format!("`{other}` is not a light of pbrt-v4"), "such as point, distant or infinite"));
            }
        }
        entity.ignore(&["samples", "nsamples"]);
        self.remark_unused(entity);
        Ok(())
    }

    /// The colour of a light times its scale, without its power; `name` is `L` or `I`.
    fn light_colour(&mut self, entity: &Entity, name: &str) -> Result<[f64; 3], SceneError> {
        let colour = self.constant_colour(entity, name, Role::Light)?.unwrap_or([1.0; 3]);
        let scale = self.light_scale(entity)?;
        Ok([0, 1, 2].map(|channel| (colour[channel] * scale[channel]).clamp(0.0, BRIGHTEST)))
    }

    /// The factors of a light, and of the film. `scale` is a colour in pbrt-v3.
    fn light_scale(&mut self, entity: &Entity) -> Result<[f64; 3], SceneError> {
        let factors = match self.constant_colour(entity, "scale", Role::Unbounded)? {
            Some(colour) => {
                self.remark_old(&entity.place, "a colour as `scale` of a light");
                colour
            }
            None => [entity.float("scale", 1.0)?; 3],
        };
        Ok(factors.map(|x| x * self.gain))
    }

    /// The factor of light of an image, equal for all channels. In pbrt-v3, its colour is another factor.
    fn image_scale(&mut self, entity: &Entity, name: &str) -> Result<f64, SceneError> {
        let scale = self.light_scale(entity)?;
        let colour = match entity.has("mapname") {
            true => self.constant_colour(entity, name, Role::Unbounded)?.unwrap_or([1.0; 3]),
            false => [1.0; 3],
        };
        let factors = [0, 1, 2].map(|channel| scale[channel] * colour[channel]);
        if factors.iter().any(|factor| *factor != factors[0]) {
            self.remark(entity, "its mean factor for all colours", "the light has another colour");
        }
        Ok((factors.iter().sum::<f64>() / 3.0).clamp(0.0, 1e12))
    }

    /// The remark on a light that is left out.
    fn remark_black(&mut self, entity: &Entity) {
        self.remark(entity, "nothing", "it is black, and gives no light");
    }
}

/// The name of the parameter with the image of a light, which has another one in pbrt-v3.
fn image_name(entity: &Entity) -> &'static str {
    entity.named(&["filename", "mapname"])
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
