//! The materials and the textures that something in a scene uses, directly or through others.
use std::collections::{BTreeMap, BTreeSet};

use super::description::{EmissionDescription, MaterialDescription, SceneDescription};
use crate::{light::environment::EnvironmentDescription, texture::TextureKind};
use noisefall_base::declare::{Declare, Family, Parameter, Parameters, Textured, Value};

type Named<T> = BTreeMap<String, T>;

/// Replaces the names that are used by numbers, in the order of their first use.
#[derive(Default)]
pub struct Used {
    materials: Named<String>,
    textures: Named<String>,
    /// Those whose own references are still to be followed, with their numbers.
    waiting: Vec<(Family, String, String)>,
}

/// The names of the textures that a scene uses.
pub fn used_textures(scene: &SceneDescription) -> BTreeSet<String> {
    if scene.textures.is_empty() {
        return BTreeSet::new();
    }
    let mut surfaces: Vec<_> = scene.objects.iter().map(|object| (object.material.clone(), object.emission.clone())).collect();
    let mut used = Used::default();
    surfaces.iter_mut().for_each(|(material, emission)| used.number_surface(material, emission));
    used.number_environment(&mut scene.environment.clone());
    used.follow(&scene.materials, &scene.textures);
    used.textures.into_keys().collect()
}

/// Gives the used materials and textures of a scene numbers for names, and drops the others. Scenes that differ only in such names and in
/// what nothing uses become equal.
pub fn number_names(scene: &mut SceneDescription) {
    let mut used = Used::default();
    scene.objects.iter_mut().for_each(|object| used.number_surface(&mut object.material, &mut object.emission));
    used.number_environment(&mut scene.environment);
    (scene.materials, scene.textures) = used.follow(&scene.materials, &scene.textures);
}

impl Used {
    fn number_surface(&mut self, material: &mut Option<String>, emission: &mut Option<EmissionDescription>) {
        material.iter_mut().for_each(|name| self.number(Family::Material, name));
        emission.iter_mut().for_each(|emission| emission.parameters(self));
    }

    fn number_environment(&mut self, environment: &mut Option<EnvironmentDescription>) {
        environment.iter_mut().for_each(|environment| environment.parameters(self));
    }

    /// The used materials and textures under their numbers.
    fn follow(
        &mut self,
        materials: &Named<MaterialDescription>,
        textures: &Named<TextureKind>,
    ) -> (Named<MaterialDescription>, Named<TextureKind>) {
        let (mut used_materials, mut used_textures) = (Named::new(), Named::new());
        while let Some((family, name, number)) = self.waiting.pop() {
            match family {
                Family::Material => self.take(&name, number, materials, &mut used_materials),
                Family::Texture => self.take(&name, number, textures, &mut used_textures),
            }
        }
        (used_materials, used_textures)
    }

    fn take<T: Declare + Clone>(&mut self, name: &str, number: String, from: &Named<T>, to: &mut Named<T>) {
        let Some(mut one) = from.get(name).cloned() else { return };
        one.parameters(self);
        to.insert(number, one);
    }

    fn number(&mut self, family: Family, name: &mut String) {
        let names = match family {
            Family::Material => &mut self.materials,
            Family::Texture => &mut self.textures,
        };
        let next = names.len().to_string();
        let number = names.entry(name.clone()).or_insert_with(|| {
            self.waiting.push((family, name.clone(), next.clone()));
            next
        });
        name.clone_from(number);
    }
}

impl Parameters for Used {
    fn value(&mut self, _: &Parameter, value: Value<'_>) {
        match value {
            Value::Name(name, family) => self.number(family, name),
            Value::Textured(Textured::Texture(name), _) | Value::TexturedNumber(Textured::Texture(name), _) => {
                self.number(Family::Texture, name);
            }
            _ => {}
        }
    }

    fn reads_outlines(&self) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::describe;

    #[test]
    fn used_textures_and_materials_are_found_through_blends_and_mixtures() {
        let text = "format = 1\ncamera = { eye = [0, 0, 4], look_at = [0, 0, 0], fov = 40, resolution = [8, 8] }\n\
                    textures.squares.checker = { even = 0.1, odd = { texture = 'clouds' }, scale = 4 }\n\
                    textures.clouds.noise = { scale = 4, octaves = 2, low = 0, high = 1 }\n\
                    textures.glow.noise = { scale = 4, octaves = 2, low = 0, high = 1 }\n\
                    textures.spare.noise = { scale = 4, octaves = 2, low = 0, high = 1 }\n\
                    materials.top.blend = { first = 'a', second = 'b', weight = 0.5 }\n\
                    materials.a.lambertian.albedo.texture = 'squares'\n\
                    materials.b.mirror.reflectance = 0.9\n\
                    materials.c.mirror.reflectance = 0.9\n\
                    [[objects]]\nshape.sphere = { center = [0, 0, 0], radius = 1 }\nmaterial = 'top'\nemission.texture = 'glow'\n";
        let scene = describe("test.toml", text.to_owned()).unwrap_or_else(|error| panic!("{}", error.report()));
        assert_eq!(Vec::from_iter(used_textures(&scene)), ["clouds", "glow", "squares"]);
        let numbered = |change: fn(&mut SceneDescription)| {
            let mut scene = scene.clone();
            change(&mut scene);
            number_names(&mut scene);
            scene
        };
        let before = numbered(|_| {});
        assert_eq!(Vec::from_iter(before.materials.keys()), ["0", "1", "2"]);
        assert_eq!(before, numbered(|scene| _ = scene.materials.remove("c")), "nothing uses it");
        assert_eq!(before, numbered(|scene| _ = scene.textures.remove("spare")), "nothing uses it");
        assert_ne!(before, numbered(|scene| _ = scene.materials.remove("a")));
        assert_ne!(before, numbered(|scene| _ = scene.textures.remove("clouds")));
    }

    #[test]
    fn other_names_leave_the_numbers_as_they_are_and_other_uses_do_not() {
        let numbered = |materials: &str| {
            let text = format!(
                "format = 1\ncamera = {{ eye = [0, 0, 4], look_at = [0, 0, 0], fov = 40, resolution = [8, 8] }}\n{materials}\n\
                 [[objects]]\nshape.sphere = {{ center = [0, 0, 0], radius = 1 }}\nmaterial = 'top'\n"
            );
            let mut scene = describe("test.toml", text).unwrap_or_else(|error| panic!("{}", error.report()));
            number_names(&mut scene);
            scene
        };
        let blend = |first: &str, second: &str| {
            numbered(&format!(
                "materials.top.blend = {{ first = '{first}', second = '{second}', weight = 0.5 }}\n\
                 materials.{first}.mirror.reflectance = 0.9\nmaterials.{second}.mirror.reflectance = 0.5"
            ))
        };
        assert_eq!(blend("a", "b"), blend("z", "0"));
        assert_eq!(blend("1", "0"), blend("0", "1"), "names may be numbers");
        let swapped = "materials.top.blend = { first = 'b', second = 'a', weight = 0.5 }\n\
                       materials.a.mirror.reflectance = 0.9\nmaterials.b.mirror.reflectance = 0.5";
        assert_ne!(blend("a", "b"), numbered(swapped));
    }
}
