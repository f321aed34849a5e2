//! The parts of the scene that rows refer to.

/// Context of the inspected part: names in the scene and their uses, and the size of the scene.
pub struct Surroundings<'s> {
    /// Names of all textures.
    pub textures: &'s [String],
    /// Names of all materials.
    pub materials: &'s [String],
    /// Counts the objects with a material.
    pub count_objects: &'s dyn Fn(&str) -> usize,
    /// The extent of the scene, metres: drags of positions depend on it.
    pub size: f64,
}
