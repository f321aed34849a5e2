//! Textures whose values exceed 1 where they must not, and are cut there.
use super::number;
use crate::import::{
    pbrt::{import::Import, parameters::Entity},
    unit::{self, Limiter},
};
use noisefall_base::declare::Textured;

/// The part of a texture with values above 1 that is used.
const CUT: &str = "values up to 1";

impl Import {
    /// A part of a whole: a number, or a texture that is cut at 1.
    pub fn part_of_whole(&mut self, entity: &Entity, value: Textured<f64>) -> Textured<f64> {
        let Textured::Texture(name) = value else { return value.map(|number| number.clamp(0.0, 1.0)) };
        let most = unit::largest(&self.description, &self.new_files.assets, self.files.folder.root(), &name);
        if most <= 1.0 {
            return Textured::Texture(name);
        }
        let key = format!("{name} cut");
        if let Some(known) = self.known_textures.get(&key) {
            return number(known.clone());
        }
        self.remark(entity, CUT, "its texture has values above 1, which are cut");
        let (scaled, ramp) = unit::cut(name.clone(), most);
        let scaled = self.add_texture(&format!("{name} scaled"), scaled);
        let cut = Textured::Texture(self.add_texture(&key, ramp(scaled)));
        self.known_textures.insert(key, cut.clone());
        number(cut)
    }

    /// A reflectance: a colour, or a texture that is cut at 1 in each channel, as in pbrt.
    pub(super) fn cut_reflectance(&mut self, entity: &Entity, value: Textured) -> Textured {
        let Textured::Texture(name) = value else { return value };
        let key = format!("reflectance {name}");
        if let Some(known) = self.known_textures.get(&key) {
            return known.clone();
        }
        let root = self.files.folder.root();
        let mut limited = name.clone();
        if unit::largest(&self.description, &self.new_files.assets, root, &name) > 1.0 {
            let (description, assets, names) = (&mut self.description, &mut self.new_files.assets, &mut self.texture_names);
            limited = Limiter { description, assets, root, names }.texture(&name, 1.0);
        }
        if limited != name {
            self.remark(entity, CUT, "its texture has values above 1, which are cut");
        }
        self.known_textures.insert(key, Textured::Texture(limited.clone()));
        Textured::Texture(limited)
    }
}
