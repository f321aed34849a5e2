//! The files that were opened last.
use std::path::{Path, PathBuf};

use super::catalogue::in_full;

/// Length of the list.
const MOST: usize = 10;

/// Puts a file at the start of the list. A path that is no Unicode text is left out, because the preferences are.
pub fn note(files: &mut Vec<PathBuf>, path: &Path) {
    let path = in_full(path);
    if path.to_str().is_none() {
        return;
    }
    files.retain(|file| *file != path);
    files.insert(0, path);
    files.truncate(MOST);
}

/// A file of the list, and whether it was there when the list was opened.
pub struct RecentFile {
    pub path: PathBuf,
    pub exists: bool,
}

/// The list as it is on the disk now.
pub fn look_up(files: &[PathBuf]) -> Vec<RecentFile> {
    files.iter().map(|path| RecentFile { path: path.clone(), exists: path.is_file() }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_file_comes_first_and_is_listed_once() {
        let mut files = Vec::new();
        for name in ["/a.toml", "/b.toml", "/a.toml"] {
            note(&mut files, Path::new(name));
        }
        assert_eq!(files, ["/a.toml", "/b.toml"].map(PathBuf::from));
        (0..20).for_each(|number| note(&mut files, Path::new(&format!("/{number}.toml"))));
        assert_eq!((files.len(), &files[0], &files[9]), (10, &PathBuf::from("/19.toml"), &PathBuf::from("/10.toml")));
    }

    #[test]
    fn a_file_that_is_gone_is_known() {
        let folder = tempfile::tempdir().expect("a folder");
        let paths = ["here.toml", "gone.toml"].map(|name| folder.path().join(name));
        std::fs::write(&paths[0], "").expect("it is written");
        assert_eq!(look_up(&paths).iter().map(|file| file.exists).collect::<Vec<_>>(), [true, false]);
    }
}
