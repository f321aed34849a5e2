//! Recovery files: a window has at most one, and a locked file beside it while it runs: `unsaved-AbC123.toml` and
//! `unsaved-AbC123.lock`.
use std::{
    fs::{self, TryLockError},
    path::{Path, PathBuf},
    time::Duration,
};

use noisefall_base::file::open_regular;
use noisefall_edit::edit::{Document, Recovery, WindowView};
use noisefall_scene::scene::read_text;
use tempfile::NamedTempFile;

use super::catalogue::in_full;

/// Extension of recovery files.
const EXTENSION: &str = "toml";

/// Unsaved changes that a window has left behind.
#[derive(Clone, Debug)]
pub struct FoundRecovery {
    pub file: PathBuf,
    pub recovery: Recovery,
    /// The title of a scene without a file; empty if it has none.
    pub title: String,
    /// Time since the last change.
    pub age: Duration,
    /// Whether the scene file was changed later.
    pub is_older: bool,
}

/// The recovery file of a window.
pub struct OwnFile {
    pub path: PathBuf,
    /// Locked, and removed when it is dropped.
    _lock: NamedTempFile,
}

/// Writes the changes, and the view of them. Returns whether they are in the file.
pub fn keep(folder: &Path, own: &mut Option<OwnFile>, document: &Document, view: Option<WindowView>) -> bool {
    if own.is_none() {
        *own = begin(folder, "unsaved-", EXTENSION).ok();
    }
    own.as_ref().is_some_and(|own| Recovery::of(document, view).write(&own.path).is_ok())
}

/// Begins a file of this window, with a lock beside it.
pub fn begin(folder: &Path, prefix: &str, extension: &str) -> std::io::Result<OwnFile> {
    fs::create_dir_all(folder)?;
    let lock = tempfile::Builder::new().prefix(prefix).suffix(".lock").tempfile_in(folder)?;
    // Not every file system has locks.
    let _ = lock.as_file().lock();
    Ok(OwnFile { path: lock.path().with_extension(extension), _lock: lock })
}

/// Removes a recovery file, and the lock that it may have.
pub fn remove(file: &Path) {
    let _ = fs::remove_file(file);
    let _ = fs::remove_file(file.with_extension("lock"));
}

/// The latest changes of a scene, or of any, that no window has open.
pub fn find(folder: &Path, scene: Option<&Path>) -> Option<FoundRecovery> {
    let found =
        files(folder).filter(|file| !is_in_use(file)).filter_map(|file| read(file).filter(|found| is_of(&found.recovery, scene)));
    found.min_by_key(|found| found.age)
}

/// The latest changes, also of a window that is about to end. A program that was killed holds its lock until its memory is freed, so the
/// search goes on while a lock is held. `wait` waits for a moment and returns whether to look again.
pub fn find_patiently(folder: &Path, scene: Option<&Path>, mut wait: impl FnMut() -> bool) -> Option<FoundRecovery> {
    loop {
        let found = find(folder, scene);
        if found.is_some() || !is_any_in_use(folder, scene) || !wait() {
            return found;
        }
    }
}

/// Whether a window has changes of a scene, or of any.
fn is_any_in_use(folder: &Path, scene: Option<&Path>) -> bool {
    let is_of_scene = |file: &Path| matches!(Recovery::read(file), Ok(Some(recovery)) if is_of(&recovery, scene));
    files(folder).any(|file| is_in_use(&file) && is_of_scene(&file))
}

/// The recovery files of a folder.
fn files(folder: &Path) -> impl Iterator<Item = PathBuf> {
    left_files(folder, EXTENSION)
}

/// The files of a folder with an extension.
pub fn left_files(folder: &Path, extension: &'static str) -> impl Iterator<Item = PathBuf> {
    let files = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    files.filter(move |file| file.extension().is_some_and(|of_file| of_file == extension))
}

/// Reads a recovery file. Removes it if the scene file has the same content.
fn read(file: PathBuf) -> Option<FoundRecovery> {
    let recovery = Recovery::read(&file).ok()??;
    if recovery.path.as_ref().is_some_and(|path| read_text(path).is_ok_and(|text| text == recovery.text)) {
        remove(&file);
        return None;
    }
    let changed = |path: &Path| path.metadata().and_then(|metadata| metadata.modified()).ok();
    let written = changed(&file)?;
    let is_older = recovery.file().and_then(changed).is_some_and(|later| later > written);
    let title = if recovery.file().is_none() { title(&recovery) } else { String::new() };
    Some(FoundRecovery { file, recovery, title, age: written.elapsed().unwrap_or_default(), is_older })
}

fn title(recovery: &Recovery) -> String {
    recovery.open().map(|document| document.description().title.clone()).unwrap_or_default()
}

fn is_of(recovery: &Recovery, scene: Option<&Path>) -> bool {
    scene.is_none_or(|scene| recovery.file().is_some_and(|path| in_full(path) == in_full(scene)))
}

/// Whether a window that runs has the lock of a file.
pub fn is_in_use(file: &Path) -> bool {
    open_regular(&file.with_extension("lock")).is_ok_and(|lock| matches!(lock.try_lock(), Err(TryLockError::WouldBlock)))
}

#[cfg(test)]
pub mod tests {
    use noisefall_base::declare::{OwnedValue, Path as ParameterPath};
    use noisefall_edit::edit::Edit;
    use noisefall_scene::scene::BUILT_IN;

    use super::*;

    /// A scene with unsaved changes.
    pub fn changed(path: &Path, fov: f64) -> Document {
        let mut document = Document::open(path, BUILT_IN).expect("it is a scene");
        let edit = Edit::set(ParameterPath::of("camera.fov"), OwnedValue::Number(fov));
        document.apply(&edit).expect("it is in range");
        document
    }

    /// How many files a folder has.
    pub fn count_files(folder: &Path) -> usize {
        fs::read_dir(folder).map_or(0, Iterator::count)
    }

    #[test]
    fn changes_of_a_window_that_is_gone_are_found_and_those_of_an_open_window_are_not() {
        let folder = tempfile::tempdir().expect("a folder");
        let scene = folder.path().join("mine.toml");
        let kept = folder.path().join("recovery");
        let document = changed(&scene, 20.0);
        let mut own = None;
        assert!(find(&kept, None).is_none());
        assert!(keep(&kept, &mut own, &document, None));
        assert!(find(&kept, Some(&scene)).is_none(), "the window is open");
        drop(own);
        let found = find(&kept, Some(&scene)).expect("it was left behind");
        assert_eq!(found.recovery, Recovery::of(&document, None));
        assert!(find(&kept, None).is_some() && find(&kept, Some(&folder.path().join("other.toml"))).is_none());
        // Changes that were saved after all need not be restored.
        fs::write(&scene, document.text()).expect("it is written");
        assert!(find(&kept, Some(&scene)).is_none());
        assert_eq!(count_files(&kept), 0);
    }

    #[test]
    fn changes_are_found_when_a_dying_program_gives_its_lock_back() {
        let folder = tempfile::tempdir().expect("a folder");
        let kept = folder.path().join("recovery");
        let document = changed(&folder.path().join("mine.toml"), 20.0);
        assert!(find_patiently(&kept, None, || panic!("there is nothing to wait for")).is_none());
        let mut own = None;
        assert!(keep(&kept, &mut own, &document, None));
        let other = folder.path().join("other.toml");
        assert!(find_patiently(&kept, Some(&other), || panic!("it is of another scene")).is_none());
        let mut looks = 0;
        let found = find_patiently(&kept, None, || {
            looks += 1;
            if looks == 3 {
                own = None;
            }
            true
        });
        assert_eq!((found.map(|found| found.recovery), looks), (Some(Recovery::of(&document, None)), 3));
        let mut own = None;
        assert!(keep(&folder.path().join("open"), &mut own, &document, None));
        assert!(find_patiently(&folder.path().join("open"), None, || false).is_none(), "its window stays open");
    }

    #[test]
    fn a_scene_without_a_file_is_found_with_its_title() {
        let kept = tempfile::tempdir().expect("a folder");
        let mut document = Document::untitled(BUILT_IN).expect("it is a scene");
        let edit = Edit::set(ParameterPath::of("title"), OwnedValue::Text("Two lights".to_owned()));
        document.apply(&edit).expect("a title can be anything");
        let mut own = None;
        assert!(keep(kept.path(), &mut own, &document, None));
        drop(own);
        assert_eq!(find(kept.path(), None).map(|found| found.title).as_deref(), Some("Two lights"));
    }
}
