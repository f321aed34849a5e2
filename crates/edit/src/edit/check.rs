//! The checks of the reader, for a part of a description.
use super::{
    references::references,
    walk::{Walk, follows_walk},
};
use noisefall_base::declare::{Declare, Family, Parameter, Parameters, Path, Problem, Step, Value, check_value};
use noisefall_scene::scene::{check_blend, check_camera, check_object, check_punctual, description::SceneDescription};

/// Largest number of places that a message names.
const MOST_PLACES: usize = 5;

/// Problems at a path or below it: values out of range, undefined names, and invalid cameras, transforms and shapes. Reads no
/// files.
pub fn check(description: &mut SceneDescription, path: &Path) -> Option<Problem> {
    let mut checker = PartCheck { walk: Walk::to(path), problem: None };
    description.parameters(&mut checker);
    checker.problem.or_else(|| names(description, path)).or_else(|| part(description, path))
}

fn names(description: &mut SceneDescription, path: &Path) -> Option<Problem> {
    let mut unknown = None;
    let mut used = Vec::new();
    references(description, path, |at, family, name| used.push((at.clone(), family, name.clone())));
    for (at, family, name) in used {
        let problem = match family {
            Family::Texture if !description.textures.contains_key(&name) => {
                Problem::not_defined("", family, &name, description.textures.keys())
            }
            Family::Material if !description.materials.contains_key(&name) => {
                Problem::not_defined("", family, &name, description.materials.keys())
            }
            _ => continue,
        };
        unknown = unknown.or(Some(problem.within(&at)));
    }
    unknown
}

/// The camera, the object, the light or the material that contains a path.
fn part(description: &SceneDescription, path: &Path) -> Option<Problem> {
    match &path.0[..] {
        [Step::Key(table), ..] if table == "camera" => {
            check_camera(&description.camera).err().map(|problem| problem.within(&Path::of("camera")))
        }
        [Step::Key(list), Step::Item(place), ..] if list == "objects" => {
            let problem = check_object(description.objects.get(*place)?).err()?;
            Some(problem.within(&Path::of("objects").item(*place)))
        }
        [Step::Key(list), Step::Item(place), ..] if list == "lights" => {
            let problem = check_punctual(description.punctual_lights.get(*place)?).err()?;
            Some(problem.within(&Path::of("lights").item(*place)))
        }
        [Step::Key(table), Step::Key(name), ..] if table == "materials" => {
            let values = description.materials.get(name)?.kind.check().err();
            let within = |problem: Problem| problem.within(&Path::of("materials").key(name));
            values.map(within).or_else(|| check_blend(&description.materials, name).err())
        }
        _ => None,
    }
}

/// The problem of removing a material or a texture that is in use.
pub fn in_use(description: &mut SceneDescription, path: &Path) -> Option<Problem> {
    let (family, what, name) = match &path.0[..] {
        [Step::Key(map), Step::Key(name)] if map == "materials" => (Family::Material, "material", name),
        [Step::Key(map), Step::Key(name)] if map == "textures" => (Family::Texture, "texture", name),
        _ => return None,
    };
    let mut users = Vec::new();
    references(description, &Path::default(), |at, used, known| {
        if used == family && known == name && !path.holds(at) {
            users.push(at.clone());
        }
    });
    let first = users.first()?.clone();
    let message = match users.len() {
        1 => format!("the {what} `{name}` is in use"),
        count => format!("the {what} `{name}` is used in {count} places"),
    };
    let mut places: Vec<String> = users.iter().map(|user| format!("`{}`", description.part_name(user))).collect();
    places.dedup();
    let others = places.len().saturating_sub(MOST_PLACES);
    places.truncate(MOST_PLACES);
    let more = if others > 0 { format!(" and {others} more") } else { String::new() };
    let problem = Problem::at("", message, "it is used here");
    Some(problem.within(&first).help(format!("use another {what} for {}{more} first", places.join(", "))))
}

struct PartCheck<'p> {
    walk: Walk<'p>,
    problem: Option<Problem>,
}

impl Parameters for PartCheck<'_> {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        if self.problem.is_none() && self.walk.takes(parameter.key) {
            let at = self.walk.path_of(parameter.key);
            self.problem = check_value(parameter, &value).map(|problem| problem.within(&at));
        }
    }

    follows_walk!();
}
