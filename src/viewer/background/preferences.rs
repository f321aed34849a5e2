//! Preferences that the window keeps from one run to the next.
use std::{
    path::{Path, PathBuf},
    thread::JoinHandle,
};

use noisefall_base::file::{read_text, replace};
use serde::{Deserialize, Serialize};

const FILE: &str = "window.toml";
/// Most bytes of the file.
const LONGEST: u64 = 1 << 20;

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct SavedState {
    /// Whether the tour was seen or ended.
    pub toured: bool,
    /// "dark" or "light"; `None` follows the system.
    pub theme: Option<String>,
    /// Size of text and controls relative to that of the system; `None` is 1.
    pub scale: Option<f32>,
    /// The files that were opened last, the latest first.
    pub recent: Vec<PathBuf>,
}

/// The saved state and its folder. A folder that cannot be read or written is not reported.
#[derive(Default)]
pub struct Preferences {
    pub now: SavedState,
    folder: Option<PathBuf>,
    /// Writes on its own thread, because folders can be slow.
    writing: Option<JoinHandle<()>>,
}

impl Preferences {
    /// Reads the preferences of this user.
    pub fn of_user() -> Preferences {
        let folder = directories::ProjectDirs::from("", "", "noisefall").map(|folders| folders.config_dir().to_owned());
        folder.map_or_else(Preferences::default, |folder| Preferences::in_folder(&folder))
    }

    pub fn in_folder(folder: &Path) -> Preferences {
        let text = read_text(&folder.join(FILE), LONGEST).unwrap_or_default();
        Preferences { now: toml::from_str(&text).unwrap_or_default(), folder: Some(folder.to_owned()), writing: None }
    }

    /// Changes the state and saves it.
    pub fn change(&mut self, change: impl FnOnce(&mut SavedState)) {
        let before = self.now.clone();
        change(&mut self.now);
        let Some(folder) = self.folder.clone().filter(|_| self.now != before) else { return };
        let text = toml::to_string(&self.now).unwrap_or_default();
        let earlier = self.writing.take();
        self.writing = Some(std::thread::spawn(move || {
            let _ = earlier.map(JoinHandle::join);
            let _ = std::fs::create_dir_all(&folder);
            let _ = replace(&folder.join(FILE), text.as_bytes());
        }));
    }
}

impl Drop for Preferences {
    fn drop(&mut self) {
        let _ = self.writing.take().map(JoinHandle::join);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_found_again_and_nonsense_is_forgotten() {
        let folder = tempfile::tempdir().expect("a folder");
        let inner = folder.path().join("noisefall");
        let mut preferences = Preferences::in_folder(&inner);
        assert_eq!(preferences.now, SavedState::default());
        preferences.change(|now| {
            (now.toured, now.theme, now.scale) = (true, Some("light".to_owned()), Some(1.25));
            now.recent = vec![PathBuf::from("/a \"scene\".toml")];
        });
        let now = preferences.now.clone();
        drop(preferences);
        assert_eq!(Preferences::in_folder(&inner).now, now);
        std::fs::write(inner.join(FILE), "toured = 7").expect("it is written");
        assert_eq!(Preferences::in_folder(&inner).now, SavedState::default());
    }
}
