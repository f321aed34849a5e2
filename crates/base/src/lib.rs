//! Numbers and vectors over lanes, declared parameters, files, memory, progress and quoted text: what all other crates stand on.

pub mod declare;
pub mod file;
pub mod math;
pub mod memory;
pub mod parallel;
pub mod progress;
pub mod quote;
