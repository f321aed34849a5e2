//! The lamps without surface of a scene.

/// A lamp as the file describes it. [`crate::light::Lamps`] holds its light.
#[derive(Clone, Debug, PartialEq)]
pub struct LampInstance {
    /// The place of the lamp in the description.
    pub described: u32,
    /// The name in the scene file; may be empty.
    pub name: String,
}

impl LampInstance {
    /// The name of the lamp in messages.
    pub fn title(&self) -> String {
        if self.name.is_empty() { format!("lamp {}", self.described + 1) } else { self.name.clone() }
    }
}
