//! Keeps unsaved changes in a recovery file, and looks for those that other runs of the program have left.
use std::{
    path::{Path, PathBuf},
    thread::JoinHandle,
    time::Duration,
};

use crossbeam_channel::{Receiver, Sender, unbounded};
use noisefall_edit::edit::{Document, Version, WindowView};

use super::{
    background_task::BackgroundTask,
    recovery_files::{FoundRecovery, find_patiently, keep, remove},
};

/// Time between two looks at the lock of another window, and the number of looks. After that the window is taken to stay open.
const PAUSE: Duration = Duration::from_millis(100);
const MOST_LOOKS: usize = 100;

/// Keeps the recovery file of this window. A folder that cannot be read or written is not reported.
#[derive(Default)]
pub struct RecoveryKeeper {
    /// The folder of all recovery files; without one, nothing is kept.
    folder: Option<PathBuf>,
    /// Writes on its own thread, because folders can be slow.
    thread: Option<Thread>,
    /// The version and the view that the file holds, or will in a moment.
    kept: Option<(Version, Option<WindowView>)>,
    search: Option<BackgroundTask<Option<FoundRecovery>>>,
    /// The file of the recovery that is being opened.
    pub restoring: Option<PathBuf>,
    /// A file whose changes are in this window now.
    superseded: Option<PathBuf>,
}

struct Thread {
    commands: Option<Sender<Command>>,
    handle: Option<JoinHandle<()>>,
}

enum Command {
    Keep { document: Box<Document>, view: Option<Box<WindowView>>, superseded: Option<PathBuf> },
    Forget,
    Remove(PathBuf),
}

impl RecoveryKeeper {
    /// Keeps the changes of this user.
    pub fn of_user() -> RecoveryKeeper {
        let folders = directories::ProjectDirs::from("", "", "noisefall");
        folders
            .map_or_else(RecoveryKeeper::default, |folders| RecoveryKeeper::in_folder(&folders.data_local_dir().join("recovery")))
    }

    pub fn in_folder(folder: &Path) -> RecoveryKeeper {
        RecoveryKeeper { folder: Some(folder.to_owned()), ..RecoveryKeeper::default() }
    }

    /// The folder of all recovery files.
    pub fn folder(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    /// Keeps the changes of a document and the view of it, or forgets them if there are none.
    pub fn keep(&mut self, changed: Option<&Document>, view: Option<WindowView>) {
        let now = changed.map(|document| (document.version(), view));
        if now == self.kept || self.folder.is_none() {
            return;
        }
        self.kept = now;
        let command = match changed {
            Some(document) => Command::Keep {
                document: Box::new(document.clone()),
                view: view.map(Box::new),
                superseded: self.superseded.take(),
            },
            None => Command::Forget,
        };
        self.send(command);
    }

    /// Takes note that another scene was opened, and looks for changes of its file that were not saved. For the first scene of a window
    /// that has no file, looks for those of any scene.
    pub fn begin(&mut self, ctx: &egui::Context, scene: Option<PathBuf>, is_first: bool) {
        self.forget();
        self.superseded = self.restoring.take();
        let searches = self.superseded.is_none() && (scene.is_some() || is_first);
        self.search = self
            .folder
            .clone()
            .filter(|_| searches)
            .map(|folder| BackgroundTask::start(ctx, move |cancelled| search(&folder, scene.as_deref(), cancelled)));
    }

    /// Forgets the changes of the open scene.
    pub fn forget(&mut self) {
        self.keep(None, None);
    }

    /// Removes changes that nobody wants.
    pub fn discard(&mut self, found: FoundRecovery) {
        self.send(Command::Remove(found.file));
    }

    /// The changes that were found, once.
    pub fn take(&mut self) -> Option<FoundRecovery> {
        BackgroundTask::take(&mut self.search)?.ok()?
    }

    fn send(&mut self, command: Command) {
        let Some(folder) = self.folder.clone() else { return };
        let thread = self.thread.get_or_insert_with(|| {
            let (sender, commands) = unbounded();
            Thread { commands: Some(sender), handle: Some(std::thread::spawn(move || work(&folder, &commands))) }
        });
        if let Some(commands) = &thread.commands {
            let _ = commands.send(command);
        }
    }
}

impl Drop for Thread {
    fn drop(&mut self) {
        self.commands = None;
        let _ = self.handle.take().map(JoinHandle::join);
    }
}

/// Looks for changes that a window has left behind, again and again while one is about to end.
fn search(folder: &Path, scene: Option<&Path>, cancelled: &dyn Fn() -> bool) -> Option<FoundRecovery> {
    let mut looks = 0;
    find_patiently(folder, scene, || {
        std::thread::sleep(PAUSE);
        looks += 1;
        looks < MOST_LOOKS && !cancelled()
    })
}

fn work(folder: &Path, commands: &Receiver<Command>) {
    let (mut own, mut superseded) = (None, Vec::new());
    while let Ok(first) = commands.recv() {
        let mut latest = None;
        for command in std::iter::once(first).chain(commands.try_iter()) {
            match command {
                Command::Keep { document, view, superseded: file } => {
                    superseded.extend(file);
                    latest = Some(Some((document, view)));
                }
                Command::Forget => latest = Some(None),
                Command::Remove(file) => remove(&file),
            }
        }
        match latest {
            Some(Some((document, view))) if keep(folder, &mut own, &document, view.as_deref().copied()) => {
                superseded.drain(..).for_each(|file| remove(&file));
            }
            Some(None) => {
                own.take().into_iter().for_each(|own| remove(&own.path));
                superseded.drain(..).for_each(|file| remove(&file));
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::viewer::background::recovery_files::{
        find,
        tests::{changed, count_files},
    };

    #[test]
    fn the_file_goes_when_changes_are_saved_or_discarded_and_stays_when_the_window_is_lost() {
        let folder = tempfile::tempdir().expect("a folder");
        let scene = folder.path().join("mine.toml");
        let kept = folder.path().join("recovery");
        let document = changed(&scene, 20.0);
        let mut keeper = RecoveryKeeper::in_folder(&kept);
        keeper.keep(Some(&document), None);
        keeper.keep(None, None);
        drop(keeper);
        assert_eq!(count_files(&kept), 0);
        let mut keeper = RecoveryKeeper::in_folder(&kept);
        keeper.keep(Some(&document), None);
        drop(keeper);
        let left = find(&kept, None).expect("it was left behind");
        // Its changes are taken over by another window: then they are in that window's file.
        let mut keeper = RecoveryKeeper::in_folder(&kept);
        keeper.restoring = Some(left.file.clone());
        keeper.begin(&egui::Context::default(), Some(scene.clone()), true);
        assert!(left.file.exists());
        keeper.keep(Some(&changed(&scene, 30.0)), None);
        drop(keeper);
        assert!(!left.file.exists());
        let found = find(&kept, Some(&scene)).expect("it was left behind again");
        assert_eq!(found.recovery.text, changed(&scene, 30.0).text());
        let mut keeper = RecoveryKeeper::in_folder(&kept);
        keeper.discard(found);
        drop(keeper);
        assert_eq!(count_files(&kept), 0);
    }
}
