//! Checkpoints: the state of a render in a file, from which it continues to the same bits.
//!
//! The worker encodes the film between two passes, and another thread writes it (`writer.rs`). A file is opened in two steps: its
//! header says which scene it needs ([`CheckpointFile`]), and the film follows once that scene is there and still gives the same samples.
mod checkpoint_file;
mod film_sections;
mod kept_scene;
mod probe;
#[cfg(test)]
pub(super) mod tests;
mod writer;

pub(super) use self::{checkpoint_file::CheckpointState, writer::CheckpointWriter};
pub use self::{
    checkpoint_file::{Checkpoint, CheckpointFile, EXTENSION, UnreadableFile, counters, is_checkpoint_file},
    kept_scene::{checkpoint_header, file_differences, keep_scene, path_of},
    probe::{probe, probe_difference},
    writer::{CheckpointEvent, CheckpointPlan, reserve},
};

/// The key of the remark that an image was continued with another scene or program.
pub const MIXED_KEY: &str = "continued";
