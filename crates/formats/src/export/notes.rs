//! Remarks about what is being translated.
use crate::import::Remarks;

/// Remarks on parts that the other format cannot express exactly, by place.
#[derive(Default)]
pub struct Notes {
    /// The remarks so far.
    pub remarks: Remarks,
    /// The part that is being translated, such as `materials.gold`.
    place: String,
}

impl Notes {
    /// Adds a remark about what is being translated.
    pub fn add(&mut self, found: impl Into<String>, used: impl Into<String>, effect: impl Into<String>) {
        self.remarks.add(self.place.clone(), found, used, effect);
    }

    /// Returns the part that is being translated.
    pub fn place(&self) -> &str {
        &self.place
    }

    /// Goes to a place, and returns the one before.
    pub fn enter(&mut self, place: String) -> String {
        std::mem::replace(&mut self.place, place)
    }
}

/// The place of an element of the lists `objects` and `lights`: by its name, or else by its number.
pub fn element(kind: &str, number: usize, name: &str) -> String {
    if name.is_empty() { format!("{kind}s[{number}]") } else { format!("{kind} \"{name}\"") }
}
