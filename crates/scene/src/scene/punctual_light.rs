//! The punctual lights of a scene.

/// A light as the file describes it. [`crate::light::Lights`] holds its light.
#[derive(Clone, Debug, PartialEq)]
pub struct PunctualLightInstance {
    /// The place of the light in the description.
    pub described: u32,
    /// The name in the scene file; may be empty.
    pub name: String,
}

impl PunctualLightInstance {
    /// The name of the light in messages.
    pub fn title(&self) -> String {
        if self.name.is_empty() { format!("light {}", self.described + 1) } else { self.name.clone() }
    }
}
