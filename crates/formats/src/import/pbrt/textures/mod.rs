//! Textures, and parameters that a texture can replace.
//!
//! | textures | file |
//! |---|---|
//! | `constant`, `scale`, `mix`, `directionmix` | here |
//! | `imagemap` | `images.rs` |
//! | cuts at 1 | `limits.rs` |
//! | `checkerboard`, `bilerp` | `patterns.rs`, as small images |
//! | `fbm`, `windy`, `wrinkled`, `marble`, `dots`, `ptex` | `substitutes.rs` |
mod images;
mod limits;
mod patterns;
mod substitutes;

use std::rc::Rc;

use super::{
    import::Import,
    parameters::{Entity, Type},
    spectra::{Role, luminance},
};
use noisefall_base::declare::Textured;
use noisefall_scene::{
    scene::{SceneError, description::TextureKind},
    texture::{mix::Mix, product::Product},
};

/// Type of the values of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    Numbers,
    Colours(Role),
}

impl Import {
    /// `Texture`.
    pub fn declare_texture(&mut self, name: String, of_type: &str, entity: Entity) -> Result<(), SceneError> {
        let is_numbers = match of_type {
            "float" => true,
            "spectrum" => false,
            "color" => {
                self.remark_old(&entity.place, "a texture of `color`");
                false
            }
            _ => return Err(entity.error(format!("`{of_type}` is not a type of textures"), "float or spectrum")),
        };
        self.textures.insert((is_numbers, name), Rc::new(entity));
        Ok(())
    }

    /// A colour, or a texture in its place.
    pub fn colour(&mut self, entity: &Entity, name: &str, default: [f64; 3], role: Role) -> Result<Textured, SceneError> {
        let found = self.part(|import| import.found_colour(entity, name, default, role))?;
        let found = found.unwrap_or(Textured::Constant(default));
        Ok(if role == Role::Reflectance { self.cut_reflectance(entity, found) } else { found })
    }

    fn found_colour(&mut self, entity: &Entity, name: &str, default: [f64; 3], role: Role) -> Result<Textured, SceneError> {
        if let Some(parameter) = entity.find(&[Type::Texture], name) {
            return self.texture_of(parameter.text().unwrap_or_default(), Content::Colours(role), parameter);
        }
        if let Some(colour) = self.constant_colour(entity, name, role)? {
            return Ok(Textured::Constant(colour));
        }
        let grey = if entity.has(name) { entity.optional_float(name)? } else { None };
        Ok(Textured::Constant(grey.map_or(default, |grey| [grey; 3])))
    }

    /// A number, or a texture in its place.
    pub fn number_or_texture(&mut self, entity: &Entity, name: &str, default: f64) -> Result<Textured<f64>, SceneError> {
        if let Some(parameter) = entity.find(&[Type::Texture], name) {
            let name = parameter.text().unwrap_or_default();
            let found = self.part(|import| import.texture_of(name, Content::Numbers, parameter))?;
            return Ok(found.map_or(Textured::Constant(default), number));
        }
        entity.float(name, default).map(Textured::Constant)
    }

    /// The values of a texture: colours, numbers, or what is given for either.
    fn values(&mut self, entity: &Entity, name: &str, default: f64, content: Content) -> Result<Textured, SceneError> {
        match content {
            Content::Colours(role) => self.colour(entity, name, [default; 3], role),
            Content::Numbers => self.number_or_texture(entity, name, default).map(colour),
        }
    }

    /// A texture by its name in the file; it is translated when it is used first.
    fn texture_of(
        &mut self,
        name: &str,
        content: Content,
        parameter: &super::parameters::Parameter,
    ) -> Result<Textured, SceneError> {
        let key = format!("{content:?} {name}");
        if let Some(known) = self.known_textures.get(&key) {
            return Ok(known.clone());
        }
        let is_numbers = content == Content::Numbers;
        let Some(entity) = self.textures.get(&(is_numbers, name.to_owned())).cloned() else {
            let label = if is_numbers { "no float texture has this name" } else { "no spectrum texture has this name" };
            return Err(parameter.place.error(format!("there is no texture `{name}`"), label));
        };
        let shown = format!("texture `{name}`");
        let texture = self.nested(&shown, &entity.place, |import| import.texture(&entity, name, content))?;
        self.remark_unused(&entity);
        self.known_textures.insert(key, texture.clone());
        Ok(texture)
    }

    fn texture(&mut self, entity: &Entity, name: &str, content: Content) -> Result<Textured, SceneError> {
        match entity.kind.as_str() {
            "constant" => self.values(entity, "value", 1.0, content),
            "scale" if entity.has("tex1") || entity.has("tex2") => self.product(entity, name, content),
            "scale" => {
                let texture = self.values(entity, "tex", 1.0, content)?;
                match self.number_or_texture(entity, "scale", 1.0)? {
                    Textured::Constant(scale) => self.scaled(&texture, scale, name),
                    scale @ Textured::Texture(_) => Ok(self.new_texture(name, Product { a: texture, b: colour(scale) })),
                }
            }
            "mix" | "directionmix" => {
                let [a, b] = [self.values(entity, "tex1", 0.0, content)?, self.values(entity, "tex2", 1.0, content)?];
                let mut weight = self.number_or_texture(entity, "amount", 0.5)?;
                if entity.kind == "directionmix" {
                    entity.ignore(&["dir"]);
                    self.remark(entity, "both textures in equal parts", "the mixture does not depend on the direction");
                    weight = Textured::Constant(0.5);
                }
                let weight = match (&a, &b, weight) {
                    // A mixture of constants is computed, beyond them as well.
                    (Textured::Constant(_), Textured::Constant(_), weight @ Textured::Constant(_)) => weight,
                    (_, _, weight) => self.part_of_whole(entity, weight),
                };
                Ok(self.mixed(name, a, b, weight))
            }
            "imagemap" => self.image_map(entity, name, content),
            "checkerboard" => self.checkerboard(entity, name, content),
            "bilerp" => self.bilerp(entity, name, content),
            _ => self.substitute(entity, name, content),
        }
    }

    /// The product of two textures, of pbrt-v3.
    fn product(&mut self, entity: &Entity, name: &str, content: Content) -> Result<Textured, SceneError> {
        self.remark_old(&entity.place, "`tex1` and `tex2` of a scaled texture");
        let [a, b] = [self.values(entity, "tex1", 1.0, content)?, self.values(entity, "tex2", 1.0, content)?];
        Ok(self.times(&a, b, name))
    }

    /// The product of two colours or textures.
    pub fn times(&mut self, a: &Textured, b: Textured, name: &str) -> Textured {
        match (a, b) {
            (Textured::Constant(a), Textured::Constant(b)) => {
                Textured::Constant([0, 1, 2].map(|channel| a[channel] * b[channel]))
            }
            (a, b) => self.new_texture(name, Product { a: positive(a.clone()), b: positive(b) }),
        }
    }

    /// A mixture, which is constant if its parts are.
    fn mixed(&mut self, name: &str, a: Textured, b: Textured, weight: Textured<f64>) -> Textured {
        if let (Textured::Constant(a), Textured::Constant(b), Textured::Constant(weight)) = (&a, &b, &weight) {
            return Textured::Constant([0, 1, 2].map(|channel| a[channel] + (b[channel] - a[channel]) * weight));
        }
        let weight = weight.map(|weight| weight.clamp(0.0, 1.0));
        self.new_texture(name, Mix { a: positive(a), b: positive(b), weight })
    }

    /// A colour or texture times a number.
    pub fn scaled(&mut self, texture: &Textured, scale: f64, name: &str) -> Result<Textured, SceneError> {
        Ok(match texture {
            Textured::Constant(colour) => Textured::Constant(colour.map(|x| x * scale)),
            texture if scale == 1.0 => texture.clone(),
            texture => {
                let key = format!("{texture:?} times {scale}");
                if let Some(known) = self.known_textures.get(&key) {
                    return Ok(known.clone());
                }
                if scale < 0.0 {
                    let place = format!("texture `{name}`");
                    self.remarks.add(place, format!("a factor of {scale}"), format!("{}", -scale), "heights are inverted");
                }
                let product = Product { a: texture.clone(), b: Textured::grey(scale.abs()) };
                let scaled = self.new_texture(name, product);
                self.known_textures.insert(key, scaled.clone());
                scaled
            }
        })
    }

    fn new_texture(&mut self, name: &str, kind: impl Into<TextureKind>) -> Textured {
        Textured::Texture(self.add_texture(name, kind))
    }

    /// Adds a texture to the description, and returns its name there.
    pub fn add_texture(&mut self, name: &str, kind: impl Into<TextureKind>) -> String {
        let name = self.texture_names.unique(name, "texture");
        self.description.textures.insert(name.clone(), kind.into());
        name
    }
}

/// A number or texture as a grey colour.
fn colour(number: Textured<f64>) -> Textured {
    number.map(|number| [number; 3])
}

/// A colour or texture as its luminance.
pub fn number(colour: Textured) -> Textured<f64> {
    // Equal channels give their own value without rounding.
    colour.map(|[r, g, b]| if r == g && g == b { r } else { luminance([r, g, b]) })
}

/// Parts of textures have no negative values.
fn positive(texture: Textured) -> Textured {
    texture.map(|colour| colour.map(|x| x.max(0.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn greys_keep_their_value() {
        assert_eq!(number(colour(Textured::Constant(0.3))), Textured::Constant(0.3));
    }
}
