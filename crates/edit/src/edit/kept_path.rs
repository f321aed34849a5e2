//! Paths in recovery files. Those that are not Unicode text are kept byte by byte: another path would be that of another file.
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

/// A path as JSON: a text, or its bytes. `Value::Null` if the system can do neither.
pub fn to_json(path: &Path) -> Value {
    path.to_str().map_or_else(|| bytes(path), Value::from)
}

/// The inverse; `None` for anything else.
pub fn of_json(value: &Value) -> Option<PathBuf> {
    let byte = |byte: &Value| byte.as_u64().and_then(|byte| u8::try_from(byte).ok());
    let bytes = || value.as_array()?.iter().map(byte).collect::<Option<Vec<u8>>>();
    value.as_str().map(PathBuf::from).or_else(|| of_bytes(bytes()?))
}

#[cfg(unix)]
fn bytes(path: &Path) -> Value {
    use std::os::unix::ffi::OsStrExt;
    json!(path.as_os_str().as_bytes())
}

#[cfg(unix)]
fn of_bytes(bytes: Vec<u8>) -> Option<PathBuf> {
    use std::os::unix::ffi::OsStringExt;
    Some(std::ffi::OsString::from_vec(bytes).into())
}

#[cfg(not(unix))]
fn bytes(_: &Path) -> Value {
    json!(null)
}

#[cfg(not(unix))]
fn of_bytes(_: Vec<u8>) -> Option<PathBuf> {
    None
}

#[cfg(unix)]
#[cfg(test)]
mod tests {
    use std::{ffi::OsStr, os::unix::ffi::OsStrExt};

    use super::*;
    use crate::edit::Recovery;

    fn round_trip(path: &Path) -> Option<PathBuf> {
        of_json(&serde_json::from_str(&to_json(path).to_string()).expect("it is JSON"))
    }

    #[test]
    fn every_path_comes_back() {
        for name in [&b"/home/a/room.toml"[..], b"/home/J\xe9r\xf4me/room.toml", "/home/Jérôme 🙂/\n\"\\".as_bytes()] {
            let path = Path::new(OsStr::from_bytes(name));
            assert_eq!(round_trip(path).as_deref(), Some(path));
        }
        for other in [json!(null), json!(3), json!([300]), json!([-1]), json!(["a"]), json!({ "from": "a" })] {
            assert_eq!(of_json(&other), None, "{other}");
        }
    }

    #[test]
    fn changes_of_a_file_whose_path_is_no_text_belong_to_that_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let scene = folder.path().join(OsStr::from_bytes(b"r\xf6om.toml"));
        let file = folder.path().join("unsaved.toml");
        for first in [to_json(&scene), json!({ "from": to_json(&scene) })] {
            let text = format!("# Unsaved changes of the scene {first}\n{}", noisefall_scene::scene::BUILT_IN);
            std::fs::write(&file, text).expect("it is written");
            let recovery = Recovery::read(&file).expect("it is readable").expect("it is there");
            assert_eq!(recovery.file(), Some(&*scene));
            recovery.write(&file).expect("it is written");
            assert_eq!(Recovery::read(&file).expect("it is readable"), Some(recovery.clone()));
            let document = recovery.open().expect("it is valid");
            assert_eq!(document.path().or(document.origin()), Some(&*scene));
        }
    }

    #[test]
    fn a_recovery_file_that_names_a_device_reads_nothing_from_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("unsaved.toml");
        let text = format!("# Unsaved changes of the scene \"/dev/zero\"\n{}", noisefall_scene::scene::BUILT_IN);
        std::fs::write(&file, text).expect("it is written");
        let recovery = Recovery::read(&file).expect("it is readable").expect("it is there");
        assert!(recovery.open().expect("it is valid").has_changes());
        // Nor from a recovery file that is one itself, or that is too long.
        assert!(Recovery::read(Path::new("/dev/zero")).is_err());
        std::fs::File::create(&file).and_then(|file| file.set_len(1 << 40)).expect("it is sparse");
        assert!(Recovery::read(&file).is_err());
    }
}
