//! The scenes that can be opened with one click: the files of the nearest `scenes/` folder.
use std::path::{Path, PathBuf};

/// Scene files by name, sorted.
pub fn find() -> Vec<(String, PathBuf)> {
    let mut scenes = folder().map_or_else(Vec::new, |folder| list(&folder));
    scenes.sort();
    scenes
}

/// `scenes/` in the current folder, or in one above the program's own (a build lies in `target/release` of its project).
fn folder() -> Option<PathBuf> {
    let program = std::env::current_exe().ok();
    let above = program.iter().flat_map(|program| program.ancestors().skip(1));
    let candidates = std::iter::once(Path::new(".")).chain(above);
    candidates.map(|folder| folder.join("scenes")).find(|folder| folder.is_dir())
}

fn list(folder: &Path) -> Vec<(String, PathBuf)> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let scenes = paths.filter(|path| path.extension().is_some_and(|extension| extension == "toml"));
    scenes.map(|path| (name(&path), path)).collect()
}

/// A file's name as a title: `tiny_lamp.toml` is "tiny lamp".
pub fn name(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().replace('_', " ")
}
