//! Slow parts of a scene, kept from one compile to the next.
use std::{any::Any, collections::HashMap, sync::Arc, time::Duration};

use crate::memory::Reservation;

/// Slow parts by key. A key states everything that determines its part, so a reused part equals a new one.
#[derive(Clone, Default)]
pub struct Memo(HashMap<String, CheckpointPart>);

/// A part, with the memory that it takes.
#[derive(Clone)]
pub(super) struct CheckpointPart {
    value: Arc<dyn Any + Send + Sync>,
    _memory: Arc<Reservation>,
}

impl CheckpointPart {
    pub fn new<T: Send + Sync + 'static>(value: Arc<T>, memory: Reservation) -> CheckpointPart {
        CheckpointPart { value, _memory: Arc::new(memory) }
    }

    /// The part, if it has this type.
    pub fn value<T: Send + Sync + 'static>(&self) -> Option<Arc<T>> {
        self.value.clone().downcast().ok()
    }
}

impl Memo {
    pub(super) fn get(&self, key: &str) -> Option<&CheckpointPart> {
        self.0.get(key)
    }

    pub(super) fn insert(&mut self, key: String, kept: CheckpointPart) {
        self.0.insert(key, kept);
    }
}

/// How often one kind of part was made or reused in a compile.
#[derive(Clone, Debug, PartialEq)]
pub struct PartReport {
    /// The kind, as a plural noun: "mesh trees".
    pub part: &'static str,
    /// Parts that were made.
    pub made: usize,
    /// Parts that were reused.
    pub reused: usize,
    /// Time that making them took.
    pub took: Duration,
}
