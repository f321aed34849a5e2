//! The materials and the textures that something in a scene uses, directly or through others.
use std::collections::BTreeSet;

use super::description::SceneDescription;
use crate::declare::{Declare, Family, Parameter, Parameters, Textured, Value};

/// Names of materials and textures.
#[derive(Default)]
pub struct Used {
    materials: BTreeSet<String>,
    textures: BTreeSet<String>,
    /// Those whose own references are still to be followed.
    waiting: Vec<(Family, String)>,
}

impl Used {
    /// What the objects and the background of a scene use.
    pub fn by(scene: &SceneDescription) -> Used {
        let mut used = Used::default();
        for object in &scene.objects {
            object.material.iter().for_each(|name| used.add(Family::Material, name));
            object.emission.clone().iter_mut().for_each(|emission| emission.parameters(&mut used));
        }
        scene.background.clone().iter_mut().for_each(|background| background.parameters(&mut used));
        while let Some((family, name)) = used.waiting.pop() {
            match family {
                Family::Material => {
                    scene.materials.get(&name).cloned().iter_mut().for_each(|material| material.parameters(&mut used));
                }
                Family::Texture => {
                    scene.textures.get(&name).cloned().iter_mut().for_each(|texture| texture.parameters(&mut used));
                }
            }
        }
        used
    }

    /// Whether two scenes have the same materials and textures under these names.
    pub fn are_same(&self, a: &SceneDescription, b: &SceneDescription) -> bool {
        self.materials.iter().all(|name| a.materials.get(name) == b.materials.get(name))
            && self.textures.iter().all(|name| a.textures.get(name) == b.textures.get(name))
    }

    fn add(&mut self, family: Family, name: &str) {
        let names = match family {
            Family::Material => &mut self.materials,
            Family::Texture => &mut self.textures,
        };
        if names.insert(name.to_owned()) {
            self.waiting.push((family, name.to_owned()));
        }
    }
}

impl Parameters for Used {
    fn value(&mut self, _: &Parameter, value: Value<'_>) {
        match value {
            Value::Name(name, family) => self.add(family, name),
            Value::Textured(Textured::Texture(name), _) | Value::TexturedNumber(Textured::Texture(name), _) => {
                self.add(Family::Texture, name);
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
    fn what_is_used_is_found_through_blends_and_mixtures() {
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
        let used = Used::by(&scene);
        assert_eq!(Vec::from_iter(&used.materials), ["a", "b", "top"]);
        assert_eq!(Vec::from_iter(&used.textures), ["clouds", "glow", "squares"]);
        let changed = |change: fn(&mut SceneDescription)| {
            let mut other = scene.clone();
            change(&mut other);
            used.are_same(&scene, &other)
        };
        assert!(changed(|scene| _ = scene.materials.remove("c")) && changed(|scene| _ = scene.textures.remove("spare")));
        assert!(!changed(|scene| _ = scene.materials.remove("a")) && !changed(|scene| _ = scene.textures.remove("clouds")));
    }
}
