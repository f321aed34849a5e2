//! Files below a folder of the program's own, such as `room.files`: nothing there follows a link, the folder itself included.
use std::{
    fs,
    io::ErrorKind,
    path::{Component, Path, PathBuf},
};

use super::target::{OutputFile, WriteError};

/// Checks whether a file can be written below a folder. Neither needs to exist; the folder of the folder does.
pub fn check_below(folder: &Path, inner: &str) -> Result<(), WriteError> {
    let path = folder.join(inner);
    if !Path::new(inner).components().all(|part| matches!(part, Component::Normal(_))) {
        return Err(WriteError::failed(&path, "its path leads out of its folder"));
    }
    for above in folders(folder, &path) {
        match fs::symlink_metadata(&above) {
            Ok(there) if there.is_dir() => {}
            Ok(there) if there.is_symlink() => return Err(WriteError::Link { path, link: above }),
            Ok(_) => return Err(WriteError::NoFolder { path, folder: above }),
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
            Err(error) => return Err(WriteError::failed(&above, &error.to_string())),
        }
    }
    OutputFile::without_links(&path).map(drop)
}

/// Replaces a file below a folder, or leaves it unchanged on failure. Folders that do not exist are made.
pub fn replace_below(folder: &Path, inner: &str, bytes: &[u8]) -> Result<(), WriteError> {
    check_below(folder, inner)?;
    let path = folder.join(inner);
    for above in folders(folder, &path) {
        match fs::create_dir(&above) {
            Err(error) if error.kind() != ErrorKind::AlreadyExists => return Err(WriteError::failed(&above, &error.to_string())),
            _ => {}
        }
    }
    // Links and files that were made meanwhile count, too.
    check_below(folder, inner)?;
    OutputFile::without_links(&path)?.replace(|to| to.write_all(bytes))
}

/// The folder, and those within it that lead to a file, from the top down.
fn folders(folder: &Path, path: &Path) -> Vec<PathBuf> {
    let mut folders: Vec<PathBuf> =
        path.ancestors().skip(1).take_while(|above| above.starts_with(folder)).map(Path::to_owned).collect();
    folders.reverse();
    folders
}

#[cfg(unix)]
#[cfg(test)]
mod tests {
    use std::os::unix::fs::symlink;

    use super::*;

    #[test]
    fn files_are_written_below_a_folder_that_may_be_new() {
        let root = tempfile::tempdir().expect("a folder");
        let folder = root.path().join("room.files");
        for bytes in [&b"old"[..], b"new"] {
            replace_below(&folder, "meshes/a.ply", bytes).expect("it is written");
            assert_eq!(fs::read(folder.join("meshes/a.ply")).expect("it is there"), bytes);
        }
        for outside in ["../a.ply", "/a.ply", "a/../../b.ply"] {
            assert!(replace_below(&folder, outside, b"no").is_err(), "{outside}");
        }
    }

    #[test]
    fn no_link_is_followed_below_a_folder() {
        let root = tempfile::tempdir().expect("a folder");
        let home = root.path().join("home");
        fs::create_dir(&home).expect("a folder");
        fs::write(home.join("keep"), "mine").expect("it is written");
        for (number, (link, to, inner)) in [
            ("a.png", "keep", "a.png"),
            ("a.png", "dangling", "a.png"),
            ("textures", ".", "textures/keep"),
            ("textures", ".", "textures/new"),
            ("", ".", "keep"),
        ]
        .into_iter()
        .enumerate()
        {
            let folder = root.path().join(format!("{number}.files"));
            if link.is_empty() {
                symlink(home.join(to), &folder).expect("a link");
            } else {
                fs::create_dir(&folder).expect("a folder");
                symlink(home.join(to), folder.join(link)).expect("a link");
            }
            let error = replace_below(&folder, inner, b"theirs").expect_err("it is a link").to_string();
            assert!(error.contains("is a link") && check_below(&folder, inner).is_err(), "{error}");
            let left: Vec<_> = fs::read_dir(&home).expect("it is there").flatten().map(|entry| entry.file_name()).collect();
            assert_eq!((left, fs::read(home.join("keep")).expect("it is there")), (vec!["keep".into()], b"mine".to_vec()));
        }
    }
}
