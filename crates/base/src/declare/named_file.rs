//! Files that a description names.
use std::{
    fs,
    path::{Path, PathBuf},
    sync::Arc,
};

use super::assets::{Asset, Loaded};

/// A file that a description names: in memory, or else on disk.
pub struct NamedFile {
    path: PathBuf,
    asset: Option<Asset>,
    loaded: Loaded,
}

impl NamedFile {
    pub(super) fn new(path: PathBuf, asset: Option<&Asset>, loaded: &Loaded) -> NamedFile {
        NamedFile { path, asset: asset.cloned(), loaded: loaded.clone() }
    }

    /// The path of the file on disk, or that under which it is in memory.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The content of a file in memory, if it has this type.
    pub fn content<T: Send + Sync + 'static>(&self) -> Option<Arc<T>> {
        self.asset.as_ref()?.content()
    }

    /// Takes the content of a file on disk, if it has been read and not changed since. It can be taken once.
    pub fn take_loaded<T: 'static>(&self) -> Option<T> {
        self.loaded.take(&self.key())
    }

    /// A key for what is made of the file. It changes with the content.
    pub fn key(&self) -> String {
        match &self.asset {
            Some(asset) => format!("memory {}", asset.number),
            None => key_of_file(&self.path),
        }
    }
}

/// A key for a file on disk: path, size and time of the last change. A file that changes is read again.
pub fn key_of_file(path: &Path) -> String {
    match fs::metadata(path) {
        Ok(known) => format!("{path:?} {} {:?}", known.len(), known.modified().ok()),
        Err(_) => format!("{path:?}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        declare::{Assets, Resources},
        memory::Reservation,
    };

    #[test]
    fn the_key_of_a_file_changes_with_its_size() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a");
        let key = |text: &str| {
            fs::write(&path, text).expect("it is written");
            key_of_file(&path)
        };
        assert_ne!(key("one"), key("three"));
        assert_ne!(key_of_file(&folder.path().join("b")), key_of_file(&path));
    }

    #[test]
    fn files_in_memory_come_before_those_on_disk_and_each_has_its_key() {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("a"), "disk").expect("it is written");
        let mut assets = Assets::default();
        assets.insert("a", 7u8);
        let shared = assets.clone();
        assets.insert("a", 8u8);
        let file = |assets: &Assets, name: &str| Resources::new(folder.path()).with_assets(assets.clone()).file(name);
        let [old, new] = [&shared, &assets].map(|assets| file(assets, "a"));
        assert_eq!([&old, &new].map(|file| file.content::<u8>().as_deref().copied()), [Some(7), Some(8)]);
        assert!(old.key() != new.key() && old.key() == file(&shared, "a").key() && old.content::<u16>().is_none());
        let disk = file(&Assets::default(), "a");
        assert!(disk.content::<u8>().is_none() && disk.key() == key_of_file(&folder.path().join("a")));
    }

    #[test]
    fn a_loaded_file_is_taken_once_unless_it_has_changed() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a");
        fs::write(&path, "disk").expect("it is written");
        let read = Assets::default();
        let taken = || Resources::new(folder.path()).with_assets(read.clone()).file("a").take_loaded::<u8>();
        read.hand_over(key_of_file(&path), 9u8, Reservation::none());
        assert_eq!([taken(), taken()], [Some(9), None]);
        read.hand_over(key_of_file(&path), 9u8, Reservation::none());
        read.forget_loaded();
        assert_eq!(taken(), None);
        read.hand_over(key_of_file(&path), 9u8, Reservation::none());
        fs::write(&path, "changed").expect("it is written");
        assert_eq!(taken(), None);
    }
}
