//! Lists a folder on another thread, because folders can be slow.
use std::path::{Path, PathBuf};

use super::background_task::BackgroundTask;

/// Most entries that are read. A folder with more of them is listed in part.
const MOST: usize = 20_000;

/// A file or a folder.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FolderEntry {
    /// Folders come first.
    pub is_file: bool,
    pub name: String,
}

/// The folder that is listed.
#[derive(Default)]
pub struct FolderReader {
    folder: Option<PathBuf>,
    entries: Vec<FolderEntry>,
    pending: Option<BackgroundTask<Vec<FolderEntry>>>,
    /// Counts the lists.
    revision: u64,
}

impl FolderReader {
    /// The entries of a folder with the files that have one of these extensions, and the number of this list. There are none while the
    /// folder is read, or if it cannot be read.
    pub fn of(&mut self, ctx: &egui::Context, folder: &Path, extensions: &'static [&str]) -> (&[FolderEntry], u64) {
        if self.folder.as_deref() != Some(folder) {
            let of = folder.to_owned();
            (self.folder, self.entries, self.revision) = (Some(of.clone()), Vec::new(), self.revision + 1);
            self.pending = Some(BackgroundTask::start(ctx, move |_| entries(&of, extensions)));
        }
        if let Some(Ok(entries)) = BackgroundTask::take(&mut self.pending) {
            (self.entries, self.revision) = (entries, self.revision + 1);
        }
        (&self.entries, self.revision)
    }
}

fn entries(folder: &Path, extensions: &[&str]) -> Vec<FolderEntry> {
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let read = std::fs::read_dir(here).into_iter().flatten().flatten().take(MOST);
    let mut entries: Vec<FolderEntry> = read.filter_map(|entry| known(&entry.path(), extensions)).collect();
    entries.sort_by_cached_key(|entry| (entry.is_file, entry.name.to_lowercase()));
    entries
}

/// The entry of a path, if it is a folder or such a file.
fn known(path: &Path, extensions: &[&str]) -> Option<FolderEntry> {
    let name = path.file_name()?.to_str()?.to_owned();
    let is_file = !path.is_dir();
    let extension = path.extension().and_then(|extension| extension.to_str());
    let is_known = |extension: &str| extensions.iter().any(|known| known.eq_ignore_ascii_case(extension));
    (!is_file || extension.is_some_and(is_known)).then_some(FolderEntry { is_file, name })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_come_first_and_only_files_that_can_be_opened_follow() {
        let folder = tempfile::tempdir().expect("a folder");
        for name in ["b.TOML", "a.toml", "notes.txt", "none"] {
            std::fs::write(folder.path().join(name), "").expect("it is written");
        }
        std::fs::create_dir(folder.path().join("zoo.d")).expect("it is made");
        let found = entries(folder.path(), &["toml", "glb"]);
        let names: Vec<_> = found.iter().map(|entry| (entry.is_file, entry.name.as_str())).collect();
        assert_eq!(names, [(false, "zoo.d"), (true, "a.toml"), (true, "b.TOML")]);
        assert!(entries(&folder.path().join("nowhere"), &["toml"]).is_empty());
    }
}
