//! The rest of the scene, as far as rows refer to it.

/// What the inspector knows of the scene besides the part that it shows.
pub struct Surroundings<'s> {
    /// Names of all textures.
    pub textures: &'s [String],
    /// Names of all materials.
    pub materials: &'s [String],
    /// The extent of the scene, metres: drags of positions depend on it.
    pub size: f64,
}
