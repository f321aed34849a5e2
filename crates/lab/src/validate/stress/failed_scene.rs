//! Scenes that are kept because they break an invariant.

/// A scene file that breaks an invariant.
pub struct FailedScene {
    /// Name of the file.
    pub name: String,
    /// The text of a scene file that says why it was kept.
    pub text: String,
    /// Why it was kept.
    pub reason: String,
}
