//! Libraries of materials: the files that `mtllib` names.
use std::{collections::HashMap, io::Read, path::Path};

use super::mtl::{self, Mtl};
use crate::import::{Folder, Remarks, Unresolved};
use noisefall_base::{file::open_regular, quote};

/// Larger libraries are refused.
const LARGEST: u64 = 64 << 20;
/// Further libraries are not read.
const MOST: usize = 256;

/// The materials of all libraries by name, with their places in messages. The first of those with the same name counts.
#[derive(Default)]
pub struct Library(HashMap<String, (String, Mtl)>);

impl Library {
    /// Reads what stands after each `mtllib`: a file name, or several.
    pub fn read(lines: &[String], folder: &Folder, file: &str, remarks: &mut Remarks) -> Library {
        let mut library = Library::default();
        let mut lines: Vec<&str> = lines.iter().map(String::as_str).filter(|line| !line.is_empty()).collect();
        let mut known = std::collections::HashSet::new();
        lines.retain(|line| known.insert(*line));
        for line in &lines[..lines.len().min(MOST)] {
            // Names have spaces more often than lines have several names.
            if library.add(line, folder, remarks).is_ok() {
                continue;
            }
            let words: Vec<&str> = line.split_ascii_whitespace().take(MOST).collect();
            for word in words {
                if let Err(reason) = library.add(word, folder, remarks) {
                    remarks.add(file, format!("`mtllib`: {reason}"), "grey", "the materials of this library are missing");
                }
            }
        }
        if lines.len() > MOST {
            remarks.add(file, format!("{} libraries", lines.len()), format!("the first {MOST}"), "further materials are grey");
        }
        library
    }

    /// The material of this name with its place. A comment may stand after the name.
    pub fn find(&self, name: &str) -> Option<(&str, &Mtl)> {
        let without_comment = || self.0.get(name.split('#').next()?.trim());
        self.0.get(name).or_else(without_comment).map(|(place, material)| (&**place, material))
    }

    fn add(&mut self, named: &str, folder: &Folder, remarks: &mut Remarks) -> Result<(), String> {
        let path = locate(named, folder)?;
        let shown = path.file_name().map(|name| quote::piece(&name.to_string_lossy())).unwrap_or_default();
        let bytes = bytes(&path).map_err(|error| format!("`{shown}` cannot be read: {error}"))?;
        for (name, material) in mtl::read(&String::from_utf8_lossy(&bytes), &shown, remarks) {
            let place = format!("{shown}: material \"{}\"", quote::piece(&name));
            self.0.entry(name).or_insert((place, material));
        }
        Ok(())
    }
}

/// The file at a path as exporters write it: with the separators of any system, perhaps in quotes. Where an absolute path leads nowhere,
/// the file of the same name beside the scene is meant; and one whose name differs in case, since other systems do not care.
pub fn locate(named: &str, folder: &Folder) -> Result<std::path::PathBuf, Unresolved> {
    let named = named.trim().trim_matches('"');
    let slashed = named.replace('\\', "/");
    let in_any_case = || folder.resolve_in_any_case(&slashed);
    let beside = || slashed.rsplit('/').next().filter(|name| *name != slashed).and_then(|name| folder.resolve(name).ok());
    folder
        .resolve(&slashed)
        .or_else(|error| folder.resolve(named).map_err(|_| error))
        .or_else(|error| beside().or_else(in_any_case).ok_or(error))
}

fn bytes(path: &Path) -> std::io::Result<Vec<u8>> {
    let file = open_regular(path)?;
    if file.metadata()?.len() > LARGEST {
        return Err(std::io::Error::other(format!("it is larger than {} MB", LARGEST >> 20)));
    }
    let mut bytes = Vec::new();
    file.take(LARGEST).read_to_end(&mut bytes)?;
    Ok(bytes)
}
