//! Tests of editing.
mod dropping;
mod edits;
mod history;
mod importing;
mod kinds;
mod meanings;
mod outside;
mod placing;
mod random;
mod random_edits;
mod round_trips;
mod saving;
mod templates;
mod view;

use std::path::Path as FilePath;

use glam::DVec3;

use super::{Document, Edit, tree::Tree};
use noisefall_base::declare::{OwnedValue, Path, Problem};
use noisefall_scene::scene::{Scene, description::SceneDescription};

/// A small scene in the style of those that come with the program.
const ROOM: &str = r#"# A room.
format = 1
title = "Room"

[camera]
eye = [0.0, 1.0, 4.0] # at the door
look_at = [0.0, 1.0, 0]
fov = 40
resolution = [640, 480]

[textures.tiles]
checker = { even = 0.8, odd = 0.1, scale = 8.0 }

# What things are made of.
[materials.white]
lambertian = { albedo = [0.73, 0.73, 0.730] }
[materials.gold]
conductor = { f0 = [1.0, 0.78, 0.34], roughness = 0.30 } # worn
[materials.floor]
lambertian = { albedo = { texture = "tiles" } }

# The shell.

# Below.
[[objects]]
name = "floor"
shape = { rectangle = { origin = [-2.0, 0.0, 2.0], edge_u = [4.0, 0.0, 0.0], edge_v = [0.0, 0.0, -4.0] } }
material = "floor"

[[objects]]
name = "ball"
shape = { sphere = { center = [0.0, 0.5, 0.0], radius = 0.5 } } # the subject
material = "gold"

# Above.
[[objects]]
name = "light"
shape = { disk = { center = [0.0, 2.5, 0.0], normal = [0.0, -1.0, 0.0], radius = 0.4 } }
emission = { radiance = [17.0, 12.0, 4.0] }
"#;

fn room() -> Document {
    Document::open("room.toml", ROOM).unwrap_or_else(|error| panic!("{}", error.report()))
}

fn path(text: &str) -> Path {
    Path::of(text)
}

fn number(at: &str, value: f64) -> Edit {
    Edit::set(path(at), OwnedValue::Number(value))
}

fn text(at: &str, value: &str) -> Edit {
    Edit::set(path(at), OwnedValue::Text(value.to_owned()))
}

/// All bits of a description.
fn bits(description: &SceneDescription) -> Tree {
    Tree::of(&mut description.clone())
}

#[track_caller]
fn does(document: &mut Document, edit: &Edit) -> Edit {
    document.apply(edit).unwrap_or_else(|problem| panic!("{edit:?}: {problem:?}"))
}

#[track_caller]
fn refuses(document: &mut Document, edit: &Edit) -> Problem {
    let (before, version) = (bits(document.description()), document.version());
    let problem = document.apply(edit).expect_err("the edit is impossible");
    assert!(bits(document.description()).is_identical(&before), "a refused edit changes nothing");
    assert_eq!(document.version(), version);
    problem
}

/// Does an edit, shows the result, and holds its inverse against what was before.
#[track_caller]
fn there_and_back(edit: &Edit, look: impl FnOnce(&SceneDescription)) {
    let mut document = room();
    let before = bits(document.description());
    let inverse = does(&mut document, edit);
    let after = bits(document.description());
    assert!(!after.is_identical(&before), "{edit:?} changes something");
    look(document.description());
    let again = does(&mut document, &inverse);
    assert!(bits(document.description()).is_identical(&before), "{inverse:?}");
    assert_eq!(document.text(), ROOM);
    does(&mut document, &again);
    assert!(bits(document.description()).is_identical(&after), "{again:?}");
}

fn compiled(document: &Document) -> Scene {
    document.description().build(FilePath::new("")).unwrap_or_else(|error| panic!("{}", error.report()))
}

/// The box of the object with a name.
fn extent(document: &Document, name: &str) -> [DVec3; 2] {
    let scene = compiled(document);
    let of_name = |object: &&noisefall_scene::scene::Object| object.name == name || object.name.starts_with(&format!("{name} "));
    let corners = scene.objects.iter().filter(of_name).map(|object| object.shape.corners());
    corners.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]).expect("there is such an object")
}
