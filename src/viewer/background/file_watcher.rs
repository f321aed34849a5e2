//! Notices that other programs change files.
use std::{
    collections::{BTreeMap, BTreeSet},
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

use crossbeam_channel::{Receiver, RecvTimeoutError, Sender, unbounded};
use notify::{
    Event, EventKind, RecommendedWatcher, RecursiveMode, Watcher,
    event::{AccessKind, AccessMode},
};

/// A change is reported when nothing happened for this time, because programs write a file in several steps.
const QUIET: Duration = Duration::from_millis(50);
/// Changes that go on are reported after this time.
const LONGEST: Duration = Duration::from_millis(250);

/// Watches files, also those that are replaced or that appear later.
pub struct FileWatcher {
    files: BTreeSet<PathBuf>,
    /// To the thread that watches; absent if nothing is watched.
    messages: Option<Sender<Message>>,
    changed: (Sender<PathBuf>, Receiver<PathBuf>),
}

enum Message {
    Files(BTreeSet<PathBuf>),
    Event(Event),
    End,
}

impl FileWatcher {
    /// A watcher that notices nothing.
    pub fn idle() -> FileWatcher {
        FileWatcher { files: BTreeSet::new(), messages: None, changed: unbounded() }
    }

    /// A watcher of the file system. The window is redrawn when a file has changed.
    pub fn start(ctx: &egui::Context) -> notify::Result<FileWatcher> {
        let (sender, messages) = unbounded();
        let of_events = sender.clone();
        let watcher = notify::recommended_watcher(move |event: notify::Result<Event>| {
            event.into_iter().for_each(|event| _ = of_events.send(Message::Event(event)));
        })?;
        let mut started = FileWatcher::idle();
        started.messages = Some(sender);
        let (changed, ctx) = (started.changed.0.clone(), ctx.clone());
        let mut folders = Folders { watcher, folders: BTreeSet::new(), names: BTreeMap::new() };
        std::thread::spawn(move || {
            folders.run(&messages, |path| _ = changed.send(path), || ctx.request_repaint());
        });
        Ok(started)
    }

    /// Watches these files instead of the earlier ones.
    pub fn watch(&mut self, files: BTreeSet<PathBuf>) {
        if files != self.files {
            self.messages.iter().for_each(|messages| _ = messages.send(Message::Files(files.clone())));
            self.files = files;
        }
    }

    /// Takes a file that has changed. Its content can still be the same.
    pub fn take(&self) -> Option<PathBuf> {
        self.changed.1.try_iter().find(|path| self.files.contains(path))
    }

    /// Reports a change as the file system would.
    #[cfg(test)]
    pub fn report(&self, path: &Path) {
        let _ = self.changed.0.send(path.to_owned());
    }
}

impl Drop for FileWatcher {
    fn drop(&mut self) {
        self.messages.iter().for_each(|messages| _ = messages.send(Message::End));
    }
}

/// The folders of the watched files. A file itself would be lost when it is replaced.
struct Folders {
    watcher: RecommendedWatcher,
    folders: BTreeSet<PathBuf>,
    /// The files by the paths in events.
    names: BTreeMap<PathBuf, PathBuf>,
}

impl Folders {
    fn run(&mut self, messages: &Receiver<Message>, report: impl Fn(PathBuf), done: impl Fn()) {
        let (mut changed, mut first, mut last) = (BTreeSet::new(), Instant::now(), Instant::now());
        loop {
            let deadline = (last + QUIET).min(first + LONGEST);
            let message = if changed.is_empty() {
                messages.recv().map_err(RecvTimeoutError::from)
            } else if Instant::now() < deadline {
                messages.recv_deadline(deadline)
            } else {
                Err(RecvTimeoutError::Timeout)
            };
            match message {
                Ok(Message::Files(files)) => self.watch(&files),
                Ok(Message::Event(event)) => {
                    let files = self.files_of(&event);
                    if files.is_empty() {
                        continue;
                    }
                    last = Instant::now();
                    if changed.is_empty() {
                        first = last;
                    }
                    changed.extend(files);
                }
                Ok(Message::End) | Err(RecvTimeoutError::Disconnected) => return,
                Err(RecvTimeoutError::Timeout) => {
                    std::mem::take(&mut changed).into_iter().for_each(&report);
                    done();
                }
            }
        }
    }

    fn watch(&mut self, files: &BTreeSet<PathBuf>) {
        self.names = files.iter().flat_map(|file| places(file).map(|place| (place, file.clone()))).collect();
        let wanted: BTreeSet<PathBuf> = self.names.keys().filter_map(|place| Some(place.parent()?.to_owned())).collect();
        let mut folders = std::mem::take(&mut self.folders);
        folders.extract_if(.., |folder| !wanted.contains(folder)).for_each(|gone| _ = self.watcher.unwatch(&gone));
        for folder in wanted {
            // A folder that cannot be watched is tried again with the next files.
            if folders.contains(&folder) || self.watcher.watch(&folder, RecursiveMode::NonRecursive).is_ok() {
                folders.insert(folder);
            }
        }
        self.folders = folders;
    }

    /// The watched files that an event changes.
    fn files_of(&self, event: &Event) -> Vec<PathBuf> {
        if event.need_rescan() {
            return self.names.values().cloned().collect();
        }
        // Reading a file is an event too.
        let changes = match event.kind {
            EventKind::Access(access) => access == AccessKind::Close(AccessMode::Write),
            _ => true,
        };
        event.paths.iter().filter(|_| changes).filter_map(|path| self.names.get(path).cloned()).collect()
    }
}

/// The paths of a file in events: in its folder, and where its link leads.
fn places(file: &Path) -> impl Iterator<Item = PathBuf> + use<> {
    let parent = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let in_folder = parent.canonicalize().ok().zip(file.file_name()).map(|(folder, name)| folder.join(name));
    in_folder.into_iter().chain(file.canonicalize().ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Makes a change again and again until it is reported, because folders are watched from some moment on. The limit is for a machine
    /// that is busy otherwise.
    fn is_reported(watcher: &FileWatcher, path: &Path, change: impl Fn()) {
        let start = Instant::now();
        while watcher.take().as_deref() != Some(path) {
            assert!(start.elapsed() < Duration::from_secs(60), "it never came");
            change();
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    #[test]
    fn a_file_that_is_written_replaced_or_made_is_reported_by_the_name_it_was_asked_for() {
        let folder = tempfile::tempdir().expect("a folder");
        // Not the name that the system has for it.
        let path = |name: &str| folder.path().join(".").join("within").join("..").join(name);
        std::fs::create_dir(folder.path().join("within")).expect("it is made");
        let write = |name: &str| std::fs::write(path(name), "text").expect("it is written");
        ["written.toml", "replaced.toml"].into_iter().for_each(write);
        let mut watcher = FileWatcher::start(&egui::Context::default()).expect("the system has a watcher");
        watcher.watch([path("written.toml"), path("replaced.toml"), path("made.png")].into());
        is_reported(&watcher, &path("written.toml"), || write("written.toml"));
        is_reported(&watcher, &path("replaced.toml"), || {
            write("replaced.toml~");
            std::fs::rename(path("replaced.toml~"), path("replaced.toml")).expect("it is renamed");
        });
        is_reported(&watcher, &path("made.png"), || write("made.png"));
        // Folders come and go with the files.
        let inner = path("within").join("inner.png");
        watcher.watch([inner.clone()].into());
        is_reported(&watcher, &inner, || std::fs::write(&inner, "text").expect("it is written"));
    }

    #[test]
    fn files_that_are_not_watched_any_more_are_not_reported() {
        let mut watcher = FileWatcher::idle();
        watcher.watch(["a.toml".into(), "b.png".into()].into());
        ["a.toml", "b.png", "c.png"].iter().for_each(|name| watcher.report(Path::new(name)));
        watcher.watch(["b.png".into()].into());
        assert_eq!([watcher.take(), watcher.take()], [Some("b.png".into()), None]);
    }
}
