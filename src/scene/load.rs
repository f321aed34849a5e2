//! Reading a scene file.
use std::{io::Read, path::Path};

use super::{
    Scene,
    carried::load_carried,
    diagnostic::{SceneError, SourceText},
    parse::parse_watched,
};
use crate::{file::open_regular, image::looks_like, progress::Progress};

/// Maximum size of a scene file, bytes. Larger files are rejected before they are read.
pub const LARGEST_FILE: u64 = 64 << 20;

/// Reads and compiles a scene file, or the scene in an image file.
pub fn load(path: &Path) -> Result<Scene, SceneError> {
    load_watched(path, &Progress::default())
}

/// The same, with progress and cancellation.
pub fn load_watched(path: &Path, progress: &Progress) -> Result<Scene, SceneError> {
    if let Some(carried) = load_carried(path) {
        return carried;
    }
    parse_watched(&path.display().to_string(), read_text(path)?, progress)
}

/// The text of a scene file, which is not parsed.
pub fn read_text(path: &Path) -> Result<String, SceneError> {
    let bytes = read(path)?;
    if let Some(kind) = not_text(&bytes) {
        let message = format!("this is not a text file{kind}");
        return Err(SceneError::of_file(
            path,
            message,
            "a scene is one TOML file, saved as UTF-8 text, or a PNG or EXR that Noisefall has written with its scene",
        ));
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let text = String::from_utf8_lossy(&error.into_bytes()).into_owned();
        let source = SourceText { name: path.display().to_string(), text };
        source.error(valid..valid + 1, "the file is not UTF-8 text", "this byte is not UTF-8").with_help("save the file as UTF-8")
    })
}

/// Description of a binary file, as the end of a sentence; `None` for text. Binary files are not quoted.
fn not_text(bytes: &[u8]) -> Option<String> {
    let start = &bytes[..bytes.len().min(4096)];
    let is_control = |byte: &u8| *byte < 0x20 && !b"\t\n\r\x0c".contains(byte);
    match looks_like(start) {
        Some(kind) => Some(format!(": it looks like {kind}")),
        None if start.starts_with(b"\xff\xfe") || start.starts_with(b"\xfe\xff") => {
            Some(" in UTF-8: it looks like UTF-16".to_owned())
        }
        None => start.iter().any(is_control).then(String::new),
    }
}

fn read(path: &Path) -> Result<Vec<u8>, SceneError> {
    let unreadable = |error: std::io::Error| {
        let help = match error.kind() {
            std::io::ErrorKind::NotFound => "check the path; scenes that come with Noisefall are in `scenes/`",
            std::io::ErrorKind::PermissionDenied => "check the permissions of the file",
            _ => "a scene is one TOML file",
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
