//! Letters that no font has would be shown as boxes.
use std::{fs, path::Path};

use super::*;

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("the folder can be read").map(|entry| entry.expect("an entry").path());
    entries.flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] }).collect()
}

#[test]
fn the_fonts_have_every_letter_that_the_window_writes() {
    let mut window = open(None);
    window.run_steps(2);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders =
        ["src/viewer", "crates/render/src", "crates/lab/src/study", "crates/scene/src/scene", "crates/scene/src/sampling"]
            .map(|folder| root.join(folder));
    let mut missing = Vec::new();
    for path in folders.iter().flat_map(|folder| sources(folder)) {
        let text = fs::read_to_string(&path).expect("source is text");
        let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
        for letter in code.flat_map(str::chars).filter(|letter| !letter.is_ascii()) {
            for font in [egui::FontId::proportional(13.0), egui::FontId::monospace(13.0)] {
                let known = window.ctx.fonts_mut(|fonts| fonts.has_glyph(&font, letter));
                if !known {
                    missing.push(format!("{letter:?} of {}", path.display()));
                }
            }
        }
    }
    missing.dedup();
    assert!(missing.is_empty(), "in no font: {missing:#?}");
}
