//! Files that exist in memory only.
use std::{any::Any, collections::BTreeMap, fmt, sync::Arc};

/// Contents of files that exist in memory only, by the path under which a description names them. A clone shares the contents.
#[derive(Clone, Default)]
pub struct Assets(BTreeMap<String, Arc<dyn Any + Send + Sync>>);

impl Assets {
    /// Adds a file.
    pub fn insert<T: Send + Sync + 'static>(&mut self, path: impl Into<String>, content: T) {
        self.0.insert(path.into(), Arc::new(content));
    }

    /// The content of a file, if it has this type.
    pub fn get<T: Send + Sync + 'static>(&self, path: &str) -> Option<Arc<T>> {
        self.0.get(path)?.clone().downcast().ok()
    }

    /// The paths of all files.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl fmt::Debug for Assets {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.0.keys()).finish()
    }
}
