//! Precision of the compile of a changed scene.

/// Precision of the compile of a changed scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// The scene has the same bits as one that is compiled from scratch.
    #[default]
    Exact,
    /// Fast enough for a drag. A mesh with a new pose keeps its tree and is moved by a transform, which rounds differently. Tables of
    /// rough glass are integrated with fewer points.
    Interactive,
}
