//! How exactly a changed scene is compiled.

/// How exactly a changed scene is compiled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// As from nothing: the scene has the same bits.
    #[default]
    Exact,
    /// Fast enough for a drag: a mesh whose pose changed keeps its tree and is moved by a transform, which rounds differently, and
    /// tables of rough glass are integrated with fewer points.
    Interactive,
}
