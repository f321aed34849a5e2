//! The parts of the scene that rows refer to.

/// Context of the inspected part: names in the scene, and its size.
pub struct Surroundings<'s> {
    /// Names of all textures.
    pub textures: &'s [String],
    /// Names of all materials.
    pub materials: &'s [String],
    /// The extent of the scene, metres: drags of positions depend on it.
    pub size: f64,
}
