//! The reason why a file is refused.
use std::path::Path;

use noisefall_base::{memory::TooMuch, progress::Cancelled};
use noisefall_scene::scene::SceneError;

/// The reason why a file is refused, and what helps.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    pub message: String,
    pub help: String,
}

/// A value, or the reason why the file is refused.
pub type Found<T> = Result<T, Refusal>;

impl Refusal {
    pub fn new(message: impl Into<String>, help: impl Into<String>) -> Refusal {
        Refusal { message: message.into(), help: help.into() }
    }

    /// Puts the place in front of the message.
    pub fn within(self, place: &str) -> Refusal {
        Refusal { message: format!("{place}: {}", self.message), ..self }
    }

    pub fn of_file(self, path: &Path) -> SceneError {
        SceneError::of_file(path, self.message, self.help)
    }
}

impl From<String> for Refusal {
    fn from(message: String) -> Refusal {
        Refusal::new(message, "the file is damaged, or not as glTF 2.0 requires; export it again")
    }
}

impl From<&str> for Refusal {
    fn from(message: &str) -> Refusal {
        message.to_owned().into()
    }
}

impl From<Cancelled> for Refusal {
    fn from(cancelled: Cancelled) -> Refusal {
        Refusal::new(cancelled.to_string(), "open the file again")
    }
}

impl From<TooMuch> for Refusal {
    fn from(error: TooMuch) -> Refusal {
        Refusal::new(error.to_string(), "close other scenes, or allow more memory")
    }
}
