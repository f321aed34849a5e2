//! Loops over lists on all threads, and values that each thread of a pool has for itself.
use std::sync::{Mutex, MutexGuard, PoisonError};

use rayon::prelude::*;

/// Calls a function with parts of a list, each with the index of its first element, and returns whether it returned true for all. Parts
/// have `length` elements, the last one fewer. After a false, others may be left out.
///
/// The function is a reference, not a generic: the code of a loop on all threads is large, and is compiled once for each type.
pub fn in_parts<T: Send>(list: &mut [T], length: usize, call: &(dyn Fn(usize, &mut [T]) -> bool + Sync)) -> bool {
    list.par_chunks_mut(length).enumerate().all(|(part, elements)| call(part * length, elements))
}

/// A value for each thread of a pool.
pub struct PerThread<T>(Vec<Mutex<T>>);

impl<T: Default> PerThread<T> {
    /// Values for a pool of so many threads.
    pub fn new(threads: usize) -> Self {
        PerThread((0..threads).map(|_| Mutex::default()).collect())
    }

    /// The value of the calling thread, which must not hold it already.
    pub fn get(&self) -> MutexGuard<'_, T> {
        let thread = rayon::current_thread_index().unwrap_or(0);
        self.0[thread].lock().unwrap_or_else(PoisonError::into_inner)
    }
}
