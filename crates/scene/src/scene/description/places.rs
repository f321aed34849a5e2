//! Places in a description as a person names them.
use super::SceneDescription;
use noisefall_base::declare::{Path, Step, key_in_words};

impl SceneDescription {
    /// The part of the scene that contains a path: "gold", "object 6", "camera".
    pub fn part_name(&self, path: &Path) -> String {
        let or_number = |name: Option<&String>, what: &str, place: usize| match name {
            Some(name) if !name.is_empty() => name.clone(),
            _ => format!("{what} {}", place + 1),
        };
        match &path.0[..] {
            [Step::Key(list), Step::Item(place), ..] if list == "objects" => {
                or_number(self.objects.get(*place).map(|object| &object.name), "object", *place)
            }
            [Step::Key(list), Step::Item(place), ..] if list == "lights" => {
                or_number(self.punctual_lights.get(*place).map(|punctual_light| &punctual_light.name), "light", *place)
            }
            [Step::Key(map), Step::Key(name), ..] if map == "materials" || map == "textures" => name.clone(),
            [Step::Key(table), ..] if table == "camera" || table == "environment" => table.clone(),
            [Step::Key(table), ..] if table == "render" => "settings".to_owned(),
            _ => "scene".to_owned(),
        }
    }

    /// A place in words: "gold: roughness", "object 6: centre", "camera".
    pub fn place_name(&self, path: &Path) -> String {
        let (part, parameter) = (self.part_name(path), parameter_name(path));
        if parameter.is_empty() { part } else { format!("{part}: {parameter}") }
    }
}

/// The parameter at the end of a path, without the part that has it: "roughness", "degrees of transform 2". Empty for a whole part.
pub fn parameter_name(path: &Path) -> String {
    let inner = &path.0[steps_of_part(path).min(path.0.len())..];
    let item = |at: usize| match (&inner[at], at.checked_sub(1).map(|list| &inner[list])) {
        (Step::Item(place), Some(Step::Key(list))) => Some(format!("{} {}", key_in_words(list), place + 1)),
        _ => None,
    };
    let of_list = (0..inner.len()).rev().find_map(item);
    match (inner.last(), of_list) {
        (Some(Step::Key(key)), Some(of)) => format!("{} of {of}", key_in_words(key)),
        (Some(Step::Key(key)), None) => key_in_words(key),
        (_, of) => of.unwrap_or_default(),
    }
}

/// The steps of a path that lead to a part of the scene.
fn steps_of_part(path: &Path) -> usize {
    match path.0.first() {
        Some(Step::Key(key)) if ["objects", "lights", "materials", "textures"].contains(&key.as_str()) => 2,
        Some(Step::Key(key)) if ["camera", "environment", "render"].contains(&key.as_str()) => 1,
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Sphere;

    #[test]
    fn a_place_is_named_by_its_part_and_its_parameter() {
        let mut scene = SceneDescription::default();
        scene.add_object("ball", Sphere::default());
        scene.add_object("", Sphere::default());
        for (path, name) in [
            ("objects.0.shape.sphere.radius", "ball: radius"),
            ("objects.1.shape.sphere.center", "object 2: centre"),
            ("objects.1", "object 2"),
            ("objects.5.flip", "object 6: flip"),
            ("objects.0.transform.1", "ball: transform 2"),
            ("objects.0.transform.1.rotate.degrees", "ball: degrees of transform 2"),
            ("lights.0.spot.angle", "light 1: angle"),
            ("materials.gold.conductor.roughness", "gold: roughness"),
            ("textures.wood", "wood"),
            ("camera.lens.radius", "camera: radius"),
            ("render.max_bounces", "settings: max bounces"),
            ("title", "scene: title"),
            ("", "scene"),
        ] {
            assert_eq!(scene.place_name(&Path::of(path)), name);
        }
    }
}
