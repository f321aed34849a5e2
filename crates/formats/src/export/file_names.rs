//! Names of files that every system accepts, and that do not lead out of their folder.
use std::collections::HashSet;

use noisefall_base::file::short_name;

/// Longest part of a path, in bytes. A number may follow.
const LONGEST: usize = 120;

/// Names that mean devices on Windows, with any extension.
const DEVICES: [&str; 6] = ["con", "prn", "aux", "nul", "com", "lpt"];

/// The relative paths that are taken so far. Paths that differ in their case alone are the same file on some systems.
#[derive(Default)]
pub struct FileNames(HashSet<String>);

impl FileNames {
    /// Takes a path as it is.
    pub fn keep(&mut self, path: &str) {
        self.0.insert(path.to_lowercase());
    }

    /// A path that is not taken yet, similar to the one that a scene uses: its last folder and its name.
    pub fn free(&mut self, wanted: &str) -> String {
        let parts: Vec<&str> = wanted.split(['/', '\\']).filter(|part| !part.trim_matches(['.', ' ']).is_empty()).collect();
        let parts: Vec<String> = parts[parts.len().saturating_sub(2)..].iter().map(|part| harmless(part)).collect();
        let path = if parts.is_empty() { "file".to_owned() } else { parts.join("/") };
        let (stem, extension) = match path.rsplit_once('.') {
            Some((stem, extension)) if !extension.contains('/') => (stem, format!(".{extension}")),
            _ => (path.as_str(), String::new()),
        };
        let names = std::iter::once(path.clone()).chain((2..).map(|number: u64| format!("{stem} {number}{extension}")));
        { names }.find(|name| self.0.insert(name.to_lowercase())).unwrap_or_default()
    }
}

/// A part of a path that every system accepts.
fn harmless(part: &str) -> String {
    let is_bad = |c: char| c.is_control() || "<>:\"|?*".contains(c);
    let part: String = part.chars().map(|c| if is_bad(c) { '_' } else { c }).collect();
    let short = short_name(part.trim().trim_end_matches('.'), LONGEST);
    let device: String = short.split('.').next().unwrap_or_default().chars().filter(|c| !c.is_ascii_digit()).collect();
    let is_device = DEVICES.contains(&device.to_lowercase().as_str());
    if is_device || short.starts_with('.') { format!("_{short}") } else { short }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_inside_their_folder_and_apart() {
        let mut names = FileNames::default();
        names.keep("meshes/kept.ply");
        let cases = [
            ("meshes/chair.ply", "meshes/chair.ply"),
            ("meshes/Chair.ply", "meshes/Chair 2.ply"),
            ("meshes/kept.ply", "meshes/kept 2.ply"),
            ("../../etc/passwd", "etc/passwd"),
            ("C:\\a\\b\\..\\nul.png", "b/_nul.png"),
            ("a:b?.png", "a_b_.png"),
            ("..", "file"),
            (".hidden", "_.hidden"),
            ("d.ir/name", "d.ir/name"),
        ];
        for (wanted, expected) in cases {
            assert_eq!(names.free(wanted), expected, "{wanted}");
        }
        for letter in ["ü", "🙂"] {
            let long = format!("{}.ply", letter.repeat(200));
            let [first, second] = [(); 2].map(|()| names.free(&long));
            assert!(first.len() <= LONGEST && second.len() <= LONGEST + 2 && first != second, "{first}, {second}");
            assert!(first.ends_with(".ply") && second.ends_with(" 2.ply"), "{first}, {second}");
        }
    }
}
