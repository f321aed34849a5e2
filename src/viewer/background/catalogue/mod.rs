//! The scenes of the list and the gallery: those that come with the program, those of a user in a `scenes/` folder, and files opened
//! from elsewhere.
use std::{
    io::Read,
    path::{Path, PathBuf},
};

use noisefall_base::file::open_regular;
use noisefall_scene::scene::ShippedScene;

/// Number of bytes that are read to find a title, which is at the beginning of a file.
const LONGEST_HEAD: u64 = 16 << 10;

/// The name of the built-in scene.
pub const BUILT_IN_NAME: &str = "Cornell box of spheres (built-in)";
/// The name of the file with the same scene, without extension.
pub const BUILT_IN_STEM: &str = "cornell_spheres";

/// A scene file and its title.
pub struct CatalogueEntry {
    pub name: String,
    /// Its description for the list.
    pub notes: String,
    /// Canonical path, so each file has one; the name of a scene in the program.
    pub path: PathBuf,
    /// The chapter of the gallery.
    pub chapter: &'static str,
}

impl CatalogueEntry {
    /// Whether it is the scene that is also built in.
    fn is_built_in(&self) -> bool {
        self.chapter != OTHERS && self.path.file_stem().is_some_and(|stem| stem == BUILT_IN_STEM)
    }
}

/// The chapters of the gallery and their scenes, in an order that teaches.
const CHAPTERS: [(&str, &[&str]); 6] = [
    ("The box", &["cornell_box", "cornell_spheres"]),
    ("Noise", &["bright_sky", "tiny_lamp", "room_window", "sky_lit"]),
    (
        "Estimators",
        &[
            "veach_plates",
            "glass_and_mirror",
            "glass_ball_caustic",
            "lamp_behind_glass",
            "keyhole_room",
            "water_pool",
            "caustic_in_mirror",
            "many_small_lamps",
            "five_hundred_lamps",
            "lights",
        ],
    ),
    ("Materials", &["gloss_row", "principled", "tinted_glass", "thin_panes", "leaves", "nested_glass", "textures_and_bump"]),
    (
        "Geometry",
        &["shapes", "isosurfaces", "sphere_field", "instanced_field", "million_triangles", "depth_of_field", "motion_blur"],
    ),
    (
        "Limits",
        &["truncation", "furnace", "inside_lit_inside", "outside_lit_outside", "inside_lit_outside", "outside_lit_inside"],
    ),
];
/// The chapter of all other scenes.
const OTHERS: &str = "More scenes";

/// An action that a list of scenes asks for.
#[derive(Debug, PartialEq)]
pub enum SceneRequest {
    /// Opens a file, or the built-in scene.
    Open(Option<PathBuf>),
    Browse,
    Gallery,
}

/// Scenes of a user in the current folder.
const FOLDER: &str = "scenes";

/// The shipped scenes in the order of their chapters. Those of a user in the current folder come last, sorted by name.
pub fn find() -> Vec<CatalogueEntry> {
    entries(project_folder().as_deref(), Path::new(FOLDER))
}

/// The scenes of the project, or else those in the program and the `own` ones of a user.
fn entries(project: Option<&Path>, own: &Path) -> Vec<CatalogueEntry> {
    let mut scenes = project.map_or_else(shipped, list);
    if project.is_none() {
        scenes.extend(list(own).into_iter().map(|entry| CatalogueEntry { chapter: OTHERS, ..entry }));
    }
    let lesson = |entry: &CatalogueEntry| lesson(&entry.path).filter(|_| entry.chapter != OTHERS).unwrap_or(usize::MAX);
    scenes.sort_by_cached_key(|entry| (lesson(entry), entry.name.to_lowercase()));
    scenes
}

/// The scenes in the program.
fn shipped() -> Vec<CatalogueEntry> {
    let entry = |scene: ShippedScene| {
        let path = PathBuf::from(scene.name);
        let [title, notes] = texts(&mut scene.text.as_bytes());
        CatalogueEntry { name: name(&title, &path), notes, chapter: chapter(&path), path }
    };
    ShippedScene::all().into_iter().map(entry).collect()
}

/// The place of a scene in the chapters.
fn lesson(path: &Path) -> Option<usize> {
    CHAPTERS.iter().flat_map(|(_, names)| *names).position(|name| path.file_stem().is_some_and(|stem| stem == *name))
}

fn chapter(path: &Path) -> &'static str {
    let holds = |names: &[&str]| names.iter().any(|name| path.file_stem().is_some_and(|stem| stem == *name));
    CHAPTERS.iter().find(|(_, names)| holds(names)).map_or(OTHERS, |(chapter, _)| chapter)
}

/// Adds a scene that was opened to the list, or updates its name. Returns the name, with that of the file if another scene has the same.
pub fn remember(scenes: &mut Vec<CatalogueEntry>, name: &str, path: &Path) -> String {
    let path = in_full(path);
    let is_taken = scenes.iter().any(|entry| entry.name == name && entry.path != path);
    let file = path.file_name().unwrap_or_default().display();
    let name = if is_taken { format!("{name} ({file})") } else { name.to_owned() };
    match scenes.iter_mut().find(|entry| entry.path == path) {
        Some(entry) => name.clone_into(&mut entry.name),
        None => scenes.push(CatalogueEntry { name: name.clone(), notes: String::new(), path, chapter: OTHERS }),
    }
    name
}

/// The scene of the list that is open: that of a file, or the one that is also built in.
pub fn open_entry<'a>(scenes: &'a [CatalogueEntry], open: Option<&Path>) -> Option<&'a CatalogueEntry> {
    let open = open.map(in_full);
    scenes.iter().find(|entry| open.as_ref().map_or_else(|| entry.is_built_in(), |open| *open == entry.path))
}

/// Whether a file with this text is a scene that comes with the program, as it came.
pub fn is_shipped(scenes: &[CatalogueEntry], path: &Path, text: &str) -> bool {
    let path = in_full(path);
    let is_listed = || scenes.iter().any(|entry| entry.chapter != OTHERS && entry.path == path);
    ShippedScene::of_text(text).is_some() && is_listed()
}

pub fn in_full(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_owned())
}

/// The folder of the shipped scenes: in the current folder, or in an ancestor of the program's folder, because a build is in
/// `target/release` of its project.
fn project_folder() -> Option<PathBuf> {
    let program = std::env::current_exe().ok();
    let above = program.iter().flat_map(|program| program.ancestors().skip(1));
    let candidates = std::iter::once(Path::new(".")).chain(above);
    candidates.map(|folder| folder.join(FOLDER)).find(|folder| folder.join(BUILT_IN_STEM).with_extension("toml").is_file())
}

fn list(folder: &Path) -> Vec<CatalogueEntry> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let scenes = paths.filter(|path| path.is_file() && path.extension().is_some_and(|extension| extension == "toml"));
    let entry = |path: PathBuf| {
        let [title, notes] = open_regular(&path).map_or_else(|_| Default::default(), |mut file| texts(&mut file));
        CatalogueEntry { name: name(&title, &path), notes, path: in_full(&path), chapter: chapter(&path) }
    };
    scenes.map(entry).collect()
}

/// Reads the title and the notes of a scene file, which come before the first table. They are empty if it has none.
fn texts(file: &mut dyn Read) -> [String; 2] {
    let mut head = Vec::new();
    let read = file.take(LONGEST_HEAD).read_to_end(&mut head);
    let head = String::from_utf8_lossy(&head);
    let end = head.find("\n[").unwrap_or(head.len());
    let table = read.ok().and_then(|_| head[..end].parse::<toml::Table>().ok()).unwrap_or_default();
    ["title", "notes"].map(|key| table.get(key).and_then(toml::Value::as_str).unwrap_or_default().to_owned())
}

/// The name of a scene: its title, or else its file name (`tiny_lamp.toml` is "tiny light").
pub fn name(title: &str, path: &Path) -> String {
    if title.is_empty() { path.file_stem().unwrap_or_default().to_string_lossy().replace('_', " ") } else { title.to_owned() }
}

/// The name of a scene with this text, in a file of this name.
pub fn name_in(mut text: &[u8], file: &str) -> String {
    name(&texts(&mut text)[0], Path::new(file))
}

/// The name of a file for a scene of this name, without extension.
pub fn file_stem(name: &str) -> String {
    if name == BUILT_IN_NAME {
        return BUILT_IN_STEM.to_owned();
    }
    let name = name.to_lowercase();
    let words = name.split(|letter: char| !letter.is_alphanumeric()).filter(|word| !word.is_empty());
    let stem = words.collect::<Vec<_>>().join("_");
    if stem.is_empty() { "scene".to_owned() } else { stem }
}

#[cfg(test)]
mod tests;
