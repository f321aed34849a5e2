//! Textures without counterpart, and their substitutes.
use super::Content;
use crate::import::pbrt::{import::Import, parameters::Entity};
use noisefall_base::declare::Textured;
use noisefall_scene::{scene::SceneError, texture::noise::Noise};

/// Range of the noise's scale and number of octaves.
const SCALES: [f64; 2] = [1e-6, 1e5];
const OCTAVES: [i64; 2] = [1, 16];

impl Import {
    pub(super) fn substitute(&mut self, entity: &Entity, name: &str, content: Content) -> Result<Textured, SceneError> {
        const EFFECT: &str = "the pattern has another form and another place";
        match entity.kind.as_str() {
            "fbm" | "windy" | "wrinkled" => {
                entity.ignore(&["roughness"]);
                self.remark(entity, "noise", EFFECT);
                self.noise(entity, name, 1.0, [[0.0; 3], [1.0; 3]])
            }
            "marble" => {
                entity.ignore(&["roughness", "variation"]);
                self.remark(entity, "noise between two colours of marble", EFFECT);
                let scale = entity.float("scale", 1.0)?;
                self.noise(entity, name, scale, [[0.2, 0.2, 0.3], [0.58, 0.58, 0.6]])
            }
            "dots" => {
                let outside = self.values(entity, "outside", 0.0, content)?;
                self.values(entity, "inside", 1.0, content)?;
                self.mapping(entity)?;
                self.remark(entity, "the texture outside of the dots", "there are no dots");
                Ok(outside)
            }
            "ptex" => {
                entity.ignore(&["filename", "encoding", "scale"]);
                self.remark(entity, "grey", "Ptex files are not supported");
                Ok(Textured::grey(0.5))
            }
            other => {
                Err(entity.error(format!("`{other}` is not a texture of pbrt-v4"), "such as imagemap, scale, mix or constant"))
            }
        }
    }

    fn noise(&mut self, entity: &Entity, name: &str, scale: f64, [low, high]: [[f64; 3]; 2]) -> Result<Textured, SceneError> {
        let octaves = entity.integer("octaves", 8)?.clamp(OCTAVES[0], OCTAVES[1]) as u32;
        let scale = scale.abs().clamp(SCALES[0], SCALES[1]);
        Ok(self.new_texture(name, Noise { scale, octaves, low, high }))
    }
}
