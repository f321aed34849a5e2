//! Checkpoints: the state of a render in a file, from which it continues to the same bits.
//!
//! The worker encodes the film between two passes, and another thread writes it (`keeper.rs`). A file is opened in two steps: its
//! header says which scene it needs ([`KeptFile`]), and the film follows once that scene is there and still gives the same samples.
mod film_sections;
mod kept_file;
mod kept_scene;
mod probe;
#[cfg(test)]
pub(super) mod tests;
mod writer;

pub(super) use self::{kept_file::KeptState, writer::CheckpointWriter};
pub use self::{
    kept_file::{EXTENSION, KeptFile, KeptRender, UnreadableFile, counters, is_kept_file},
    kept_scene::{file_differences, keep_scene, kept_header, path_of},
    probe::{probe, probe_difference},
    writer::{KeepEvent, KeepPlan, reserve},
};

/// The key of the remark that an image was continued with another scene or program.
pub const MIXED_KEY: &str = "continued";
