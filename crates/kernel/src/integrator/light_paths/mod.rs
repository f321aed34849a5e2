//! The data of bidirectional paths while a batch is traced. [`super::bidirectional`] has their stages.
//!
//! | file | content |
//! |---|---|
//! | `grid.rs` | finds vertices near a place |
//! | `partial.rs` | partial sums of the balance heuristic |
//! | `path_state.rs` | the state of the paths from one end, by slot |
//! | `vertices.rs` | the vertices of light paths |
//! | `records.rs` | records in the queues between stages |
//! | `paths.rs` | all of that |
//! | `splat.rs` | light that arrives in any pixel |
pub mod grid;
pub mod partial;
pub mod path_state;
pub mod paths;
pub mod records;
pub mod splat;
pub mod vertices;
