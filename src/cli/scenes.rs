//! `noisefall scenes`: lists the scenes that are part of the program, or writes their files.
use std::path::{Path, PathBuf};

use noisefall_base::{declare::nearest, file::replace};
use noisefall_scene::scene::{ShippedScene, describe};

use super::{
    folder,
    messages::{Failure, print},
};

const NOTES: &str = "\
Every command takes the name of such a scene in place of a file, if there is no file of that name.

Examples:
  noisefall scenes
  noisefall cornell_box
  noisefall render veach_plates -o veach.png
  noisefall scenes -o scenes sky_lit furnace";

#[derive(clap::Args)]
#[command(after_help = NOTES)]
pub struct Arguments {
    /// Names of scenes [default: all]
    names: Vec<String>,
    /// Folder for the scene files and the images that they name; created if it does not exist
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let scenes = if arguments.names.is_empty() {
        ShippedScene::all()
    } else {
        arguments.names.iter().map(|name| named(name)).collect::<Result<_, _>>()?
    };
    match &arguments.output {
        Some(folder) => scenes.iter().try_for_each(|scene| write(folder, scene)),
        None => scenes.iter().try_for_each(|scene| print(&format!("{:<20} {}", scene.name, title(scene)?))),
    }
}

fn named(name: &str) -> Result<ShippedScene, Failure> {
    let scenes = ShippedScene::all();
    let found = scenes.iter().find(|scene| scene.name == name).copied();
    found.ok_or_else(|| match nearest(name, scenes.iter().map(|scene| scene.name)) {
        Some(meant) => format!("there is no scene `{name}`; did you mean `{meant}`?"),
        None => format!("there is no scene `{name}`; `noisefall scenes` lists them"),
    })
}

fn title(scene: &ShippedScene) -> Result<String, Failure> {
    describe(scene.name, scene.text.to_owned()).map(|scene| scene.title).map_err(|error| error.report())
}

/// Writes the file of a scene and those that it names.
fn write(folder: &Path, scene: &ShippedScene) -> Result<(), Failure> {
    let name = format!("{}.toml", scene.name);
    folder::make(folder, &name)?;
    for (path, bytes) in scene.files() {
        let file = folder.join(path);
        file.parent().map_or(Ok(()), |parent| folder::make(parent, path.rsplit('/').next().unwrap_or(path)))?;
        replace(&file, bytes).map_err(|error| error.to_string())?;
    }
    folder::write(folder, &name, scene.text, "scene")
}
