//! Files that exist in memory only.
use std::{
    any::Any,
    collections::{BTreeMap, BTreeSet},
    fmt,
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
};

use crate::memory::Reservation;

/// Contents of files that exist in memory only, by the path under which a description names them. Clones share the contents.
#[derive(Clone, Default)]
pub struct Assets {
    files: Arc<BTreeMap<String, Asset>>,
    loaded: Loaded,
    /// The files on disk that the scene was read from, beside the scene file.
    sources: Arc<BTreeSet<String>>,
    /// Given back with the last clone.
    memory: Option<Arc<Reservation>>,
}

/// Contents of files on disk that have been read already, by [`super::key_of_file`]. Each is taken once.
#[derive(Clone, Default)]
pub(super) struct Loaded(Arc<Mutex<LoadedFiles>>);

type LoadedFiles = BTreeMap<String, (Box<dyn Any + Send>, Reservation)>;

impl Loaded {
    /// Takes the content of a file, if it has this type.
    pub fn take<T: 'static>(&self, key: &str) -> Option<T> {
        let (content, _memory) = self.files().remove(key)?;
        content.downcast().ok().map(|content| *content)
    }

    fn files(&self) -> MutexGuard<'_, LoadedFiles> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The content of a file in memory.
#[derive(Clone)]
pub(super) struct Asset {
    content: Arc<dyn Any + Send + Sync>,
    /// No other content of this process has it: part of the keys of what is made of the content.
    pub number: u64,
}

impl Asset {
    /// The content, if it has this type.
    pub fn content<T: Send + Sync + 'static>(&self) -> Option<Arc<T>> {
        self.content.clone().downcast().ok()
    }
}

impl Assets {
    /// Adds a file.
    pub fn insert<T: Send + Sync + 'static>(&mut self, path: impl Into<String>, content: T) {
        static NUMBERS: AtomicU64 = AtomicU64::new(0);
        let number = NUMBERS.fetch_add(1, Ordering::Relaxed);
        Arc::make_mut(&mut self.files).insert(path.into(), Asset { content: Arc::new(content), number });
    }

    /// Hands over the content of a file on disk, and its memory, so that the compile need not read it again. `key` is its
    /// [`super::key_of_file`] from before it was read.
    pub fn hand_over<T: Send + 'static>(&self, key: String, content: T, memory: Reservation) {
        self.loaded.files().insert(key, (Box::new(content), memory));
    }

    /// Forgets the contents that were handed over and not taken.
    pub fn forget_loaded(&self) {
        self.loaded.files().clear();
    }

    /// The content of a file, if it has this type.
    pub fn get<T: Send + Sync + 'static>(&self, path: &str) -> Option<Arc<T>> {
        self.files.get(path)?.content()
    }

    pub(super) fn asset(&self, path: &str) -> Option<&Asset> {
        self.files.get(path)
    }

    pub(super) fn loaded(&self) -> &Loaded {
        &self.loaded
    }

    /// Keeps the memory of the contents reserved while they exist, in place of an earlier reservation.
    pub fn keep_reserved(&mut self, memory: Reservation) {
        self.memory = Some(Arc::new(memory));
    }

    /// Notes the files on disk that the scene was read from, beside the scene file: by paths relative to its folder, or absolute.
    pub fn set_sources(&mut self, sources: BTreeSet<String>) {
        self.sources = Arc::new(sources);
    }

    /// The files on disk that the scene was read from, beside the scene file.
    pub fn sources(&self) -> impl Iterator<Item = &str> {
        self.sources.iter().map(String::as_str)
    }

    /// The paths of all files.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        self.files.keys().map(String::as_str)
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }
}

impl fmt::Debug for Assets {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.files.keys()).finish()
    }
}
