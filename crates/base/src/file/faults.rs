//! For tests of what writes files, faults below them: a full disk, a disk that does not take bytes to the end, a rename that is refused.
use std::{
    cell::Cell,
    collections::BTreeMap,
    fs,
    io::{self, ErrorKind, Write},
    path::{Path, PathBuf},
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicUsize, Ordering},
    },
};

use tempfile::NamedTempFile;

use super::durable::{Durable, fill};

/// Most bytes that a faulty disk takes at once.
const SHORT: usize = 1021;

/// The folders of faulty disks. A checkpoint is written on a thread of its own, so they are those of the process.
static DISKS: Mutex<Vec<(PathBuf, Arc<Disk>)>> = Mutex::new(Vec::new());

fn disks() -> MutexGuard<'static, Vec<(PathBuf, Arc<Disk>)>> {
    DISKS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The faulty disk of a file; `None` if its disk has no faults.
pub fn disk(path: &Path) -> Option<Arc<Disk>> {
    disks().iter().find(|(folder, _)| path.starts_with(folder)).map(|(_, disk)| disk.clone())
}

/// A disk that writes a few bytes at a time, is interrupted, and does so many things before it fails.
pub struct Disk {
    bytes: AtomicUsize,
    syncs: AtomicUsize,
    renames: AtomicUsize,
}

/// Counts down. `false` if nothing is left.
fn take(left: &AtomicUsize) -> bool {
    left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1)).is_ok()
}

impl Disk {
    const WHOLE: [usize; 3] = [usize::MAX; 3];

    fn new([bytes, syncs, renames]: [usize; 3]) -> Disk {
        Disk { bytes: bytes.into(), syncs: syncs.into(), renames: renames.into() }
    }

    /// Returns the bytes, syncs and renames that are left.
    fn left(&self) -> [usize; 3] {
        [&self.bytes, &self.syncs, &self.renames].map(|left| left.load(Ordering::Relaxed))
    }

    /// Writes a temporary file, and renames it.
    pub fn put(
        &self,
        mut file: NamedTempFile,
        path: &Path,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<()> {
        fill(&mut FaultyFile { disk: self, file: file.as_file_mut(), calls: 0, is_full: Cell::new(false) }, write)?;
        if !take(&self.renames) {
            return Err(ErrorKind::PermissionDenied.into());
        }
        file.persist(path)?;
        Ok(())
    }
}

struct FaultyFile<'a> {
    disk: &'a Disk,
    file: &'a mut fs::File,
    calls: usize,
    is_full: Cell<bool>,
}

impl Write for FaultyFile<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.calls += 1;
        if self.calls.is_multiple_of(3) {
            return Err(ErrorKind::Interrupted.into());
        }
        let [room, ..] = self.disk.left();
        let count = bytes.len().min(SHORT).min(room);
        if count == 0 && !bytes.is_empty() {
            self.is_full.set(true);
            return Err(ErrorKind::StorageFull.into());
        }
        self.file.write_all(&bytes[..count])?;
        self.disk.bytes.fetch_sub(count, Ordering::Relaxed);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Durable for FaultyFile<'_> {
    fn sync(&self) -> io::Result<()> {
        assert!(!self.is_full.get(), "a file that is cut off is synced, and would be renamed");
        if take(&self.disk.syncs) { Ok(()) } else { Err(io::Error::other("the disk is gone")) }
    }
}

/// Makes `write` fail in every way that a disk can fail, at every byte, sync and rename. `path` is the file that it writes last, in a
/// folder of its own. Whatever fails is said with what to do, `path` is what it was, and all files beside it are old or new, and whole.
pub fn lose_nothing(path: &Path, write: &mut dyn FnMut() -> Result<(), String>) {
    let folder = path.parent().expect("it lies in a folder");
    let old = contents(folder);
    let mut on_disk = |left: [usize; 3]| {
        let disk = Arc::new(Disk::new(left));
        disks().push((folder.to_owned(), disk.clone()));
        let done = write();
        disks().retain(|(_, other)| !Arc::ptr_eq(other, &disk));
        (done, disk.left())
    };
    // Short writes and interruptions alone.
    let (done, left) = on_disk(Disk::WHOLE);
    done.expect("no fault is left");
    let new = contents(folder);
    assert_ne!(old.get(path), new.get(path), "it writes another file");
    for (kind, left) in left.into_iter().enumerate() {
        let uses = usize::MAX - left;
        assert!(uses > 0, "it writes, syncs and renames");
        for done_before in 0..uses {
            restore(folder, &old);
            let mut room = Disk::WHOLE;
            room[kind] = done_before;
            let said = on_disk(room).0.expect_err("the disk fails");
            let remedy = ["free some space there", "the disk is gone", "choose another folder"][kind];
            assert!(said.contains("cannot be written: ") && said.contains(remedy) && !said.contains(".part"), "{said}");
            let now = contents(folder);
            assert_eq!(now.get(path), old.get(path), "{kind} {done_before}");
            for (file, bytes) in &now {
                assert!([old.get(file), new.get(file)].contains(&Some(bytes)), "{}: {kind} {done_before}", file.display());
            }
            assert!(old.keys().all(|file| now.contains_key(file)), "{kind} {done_before}");
        }
    }
}

/// All files in a folder and below.
fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let files = entries.flat_map(|path| match path.is_dir() {
        true => contents(&path),
        false => BTreeMap::from([(path.clone(), fs::read(&path).expect("it can be read"))]),
    });
    files.collect()
}

fn restore(folder: &Path, files: &BTreeMap<PathBuf, Vec<u8>>) {
    let now = contents(folder);
    now.keys().filter(|path| !files.contains_key(*path)).for_each(|path| fs::remove_file(path).expect("it is there"));
    let changed = files.iter().filter(|(path, bytes)| now.get(*path) != Some(bytes));
    changed.for_each(|(path, bytes)| fs::write(path, bytes).expect("it is written"));
}
