//! Loops over lists on all threads.
use rayon::prelude::*;

/// Calls a function with parts of a list, each with the index of its first element, and returns whether it returned true for all. Parts
/// have `length` elements, the last one fewer. After a false, others may be left out.
///
/// The function is a reference, not a generic: the code of a loop on all threads is large, and is compiled once for each type.
pub fn in_parts<T: Send>(list: &mut [T], length: usize, call: &(dyn Fn(usize, &mut [T]) -> bool + Sync)) -> bool {
    list.par_chunks_mut(length).enumerate().all(|(part, elements)| call(part * length, elements))
}
