//! Limits of a scene: bytes that it may unpack, and triangles that it may make from rules rather than from lists. A small file can
//! ask for any amount of either, and do so a thousand times.
use std::sync::{Arc, Mutex, PoisonError};

/// Bytes that any scene may unpack, and those per byte of its packed files.
const FREE_BYTES: u64 = 64 << 20;
const BYTES_PER_BYTE: u64 = 64;
/// Triangles that any scene may make.
const FREE_TRIANGLES: u64 = 1 << 21;

/// The budget of a scene. Clones share it.
#[derive(Clone, Debug, Default)]
pub struct Budget(Arc<Mutex<Spent>>);

#[derive(Debug, Default)]
struct Spent {
    /// Bytes of packed files.
    packed: u64,
    unpacked: u64,
    triangles: u64,
}

impl Budget {
    /// Counts the bytes of a packed file, of which more may be unpacked.
    pub fn packed(&self, bytes: u64) {
        self.change(|spent| spent.packed = spent.packed.saturating_add(bytes));
    }

    /// Takes bytes that are unpacked. An error is the end of a sentence.
    pub fn unpack(&self, bytes: u64) -> Result<(), String> {
        self.change(|spent| {
            spent.unpacked = spent.unpacked.saturating_add(bytes);
            let most = spent.packed.saturating_mul(BYTES_PER_BYTE).saturating_add(FREE_BYTES);
            let reason = || "the packed files of the scene unpack to far more than their size; unpack them first".to_owned();
            (spent.unpacked <= most).then_some(()).ok_or_else(reason)
        })
    }

    /// Takes triangles if all of them are left.
    pub fn make(&self, triangles: u64) -> bool {
        self.change(|spent| {
            let sum = spent.triangles.checked_add(triangles).filter(|sum| *sum <= FREE_TRIANGLES);
            sum.map(|sum| spent.triangles = sum).is_some()
        })
    }

    fn change<T>(&self, change: impl FnOnce(&mut Spent) -> T) -> T {
        change(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_files_of_a_scene_draw_on_the_same_budget() {
        let budget = Budget::default();
        let other = budget.clone();
        assert!(budget.unpack(FREE_BYTES).is_ok() && other.unpack(1).is_err());
        budget.packed(10);
        assert!(other.unpack(10 * BYTES_PER_BYTE - 1).is_ok() && budget.unpack(1).is_err());
        assert!(budget.make(FREE_TRIANGLES - 5) && !other.make(6) && other.make(5) && !budget.make(1));
        assert!(!budget.make(u64::MAX) && budget.make(0));
    }
}
