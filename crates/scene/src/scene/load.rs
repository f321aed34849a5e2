//! Reading a scene file.
use std::{io::Read, path::Path};

use super::{
    Scene,
    diagnostic::{SceneError, SourceText},
    embedded::load_embedded,
    parse::parse_watched,
    shipped::ShippedScene,
};
use crate::image::{PNG, looks_like};
use noisefall_base::{file::open_regular, progress::Progress};

/// Maximum size of a scene file, bytes. Larger files are rejected before they are read.
pub const LARGEST_FILE: u64 = 64 << 20;

/// Files that can be opened in place of a scene file, for messages.
const OPENABLE: &str = "scenes are TOML, glTF, GLB, Mitsuba XML or PBRT files; meshes (OBJ, PLY, STL) and images that Noisefall has \
                        saved (PNG, EXR) open too";

/// Reads and compiles a scene file, the scene in an image file, or the scene of the program that has this name.
pub fn load(path: &Path) -> Result<Scene, SceneError> {
    load_watched(path, &Progress::default())
}

/// Reads and compiles a scene as [`load`] does, with progress and cancellation.
pub fn load_watched(path: &Path, progress: &Progress) -> Result<Scene, SceneError> {
    if let Some(embedded) = load_embedded(path) {
        return embedded;
    }
    if let Some(shipped) = ShippedScene::of(path) {
        return shipped.load(progress);
    }
    parse_watched(&path.display().to_string(), read_text(path)?, progress)
}

/// The text of a scene file, which is not parsed.
pub fn read_text(path: &Path) -> Result<String, SceneError> {
    let bytes = read(path)?;
    if let Some(what) = no_scene(path, &bytes) {
        return Err(SceneError::of_file(path, what, OPENABLE));
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let text = String::from_utf8_lossy(&error.into_bytes()).into_owned();
        let source = SourceText { name: path.display().to_string(), text };
        source.error(valid..valid + 1, "the file is not UTF-8 text", "this byte is not UTF-8").with_help("save the file as UTF-8")
    })
}

/// Says that a file is no scene file, and what it looks like; `None` if it could be one.
fn no_scene(path: &Path, bytes: &[u8]) -> Option<String> {
    let start = &bytes[..bytes.len().min(4096)];
    let is_control = |byte: &u8| *byte < 0x20 && !b"\t\n\r\x0c".contains(byte);
    // In TOML, the first line of a script is a comment.
    let is_toml = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
    if let Some(kind) = looks_like(start).filter(|_| !(is_toml && start.starts_with(b"#!"))) {
        let and = if kind == PNG { " without a scene in it" } else { "" };
        return Some(format!("this looks like {kind}{and}, not like a scene"));
    }
    if start.starts_with(b"\xff\xfe") || start.starts_with(b"\xfe\xff") {
        return Some("this is not UTF-8 text: it looks like UTF-16; save the scene as UTF-8".to_owned());
    }
    let is_named = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
    let is_text = !start.iter().any(is_control);
    (!is_text || (!is_named && !begins_as_scene(bytes))).then(|| "this is not a scene".to_owned())
}

/// Whether a line gives the format of a scene file, or begins its camera.
fn begins_as_scene(bytes: &[u8]) -> bool {
    let begins = |line: &[u8]| [&b"format"[..], b"[camera", b"camera"].iter().any(|key| line.trim_ascii_start().starts_with(key));
    bytes.split(|byte| *byte == b'\n').any(begins)
}

fn read(path: &Path) -> Result<Vec<u8>, SceneError> {
    let unreadable = |error: std::io::Error| {
        let help = match error.kind() {
            std::io::ErrorKind::NotFound => "check the path; `noisefall scenes` lists the scenes that come with Noisefall",
            std::io::ErrorKind::PermissionDenied => "check the permissions of the file",
            _ => OPENABLE,
        };
        let reason = match error.kind() {
            std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
            _ => format!("cannot be read: {error}"),
        };
        SceneError::of_file(path, reason, help)
    };
    let file = open_regular(path).map_err(unreadable)?;
    let mut bytes = Vec::new();
    // Reading stops at the limit even if the file is smaller now, because it may grow meanwhile.
    file.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > LARGEST_FILE {
        let message = format!("the file is larger than {} MB", LARGEST_FILE >> 20);
        return Err(SceneError::of_file(path, message, "a scene file is short text; keep large data in files of their own"));
    }
    Ok(bytes)
}
