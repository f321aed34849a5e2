//! Folders depend downwards only.
use std::{collections::BTreeSet, fs};

use crate::imports::{imports, source, source_files};

/// Folders and the files beside them, from the top down. Those of one line do not import each other.
const LAYERS: [&[&str]; 13] = [
    &["validate", "study"],
    &["render", "report"],
    &["export"],
    &["measure", "import", "render_file"],
    &["integrator", "edit"],
    &["scene"],
    &["light"],
    &["shape"],
    &["geometry", "material"],
    &["texture"],
    &["sampling", "image", "model"],
    &["declare"],
    &["math", "file", "memory", "parallel", "progress", "quote"],
];

/// The folders of the window, from the top down.
const VIEWER: [&[&str]; 6] = [&["app"], &["panels", "dialogs"], &["instruments"], &["canvas"], &["background"], &["widgets"]];

fn level(folder: &str) -> Option<usize> {
    LAYERS.iter().position(|layer| layer.contains(&folder))
}

/// The folders that a file names after `crate::`, also in `use crate::{a, b}`.
fn folders_used(text: &str) -> Vec<String> {
    let word = |s: &str| s.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let mut used = Vec::new();
    for (at, _) in text.match_indices("crate::") {
        let rest = &text[at + "crate::".len()..];
        match rest.strip_prefix('{') {
            None => used.push(word(rest)),
            Some(group) => {
                let mut depth = 1;
                let mut start = true;
                for (i, c) in group.char_indices() {
                    depth += i32::from(c == '{') - i32::from(c == '}');
                    if depth == 0 {
                        break;
                    }
                    if start && c.is_alphabetic() {
                        used.push(word(&group[i..]));
                        start = false;
                    }
                    start |= depth == 1 && c == ',';
                }
            }
        }
    }
    used
}

#[test]
fn arrows_between_folders_point_down() {
    let source = source();
    let mut arrows = 0;
    for file in source_files(&source) {
        let folder = file.strip_prefix(&source).expect("it lies in src").components().next().expect("it has a name");
        let folder = folder.as_os_str().to_string_lossy().trim_end_matches(".rs").to_owned();
        let Some(from) = level(&folder) else { continue };
        let text = fs::read_to_string(&file).expect("source is text");
        for used in folders_used(&text).iter().filter(|used| **used != folder) {
            let to = level(used).unwrap_or_else(|| panic!("{} uses {used}, which is no folder of the library", file.display()));
            arrows += 1;
            assert!(from < to, "{} uses {used}, which is not below {folder}", file.display());
        }
    }
    assert!(arrows > 20, "the search finds arrows: {arrows}");
}

#[test]
fn every_folder_has_its_layer() {
    let of_modules = imports().into_keys().filter_map(|module| module.first().cloned()).collect::<BTreeSet<String>>();
    let of_layers = LAYERS.iter().copied().flatten().chain(&["viewer", "cli"]).map(|name| (*name).to_owned()).collect();
    assert_eq!(of_modules, of_layers);
    let of_window = imports().into_keys().filter(|module| module.len() > 2 && module[0] == "viewer");
    let of_window: BTreeSet<String> = of_window.map(|module| module[1].clone()).collect();
    assert_eq!(of_window, VIEWER.iter().copied().flatten().map(|name| (*name).to_owned()).collect());
}

#[test]
fn groups_of_imports_are_understood() {
    assert_eq!(folders_used("use crate::{a::{x, y}, b, c::z};\nuse crate::d::e;"), ["a", "b", "c", "d"]);
}

#[test]
fn arrows_between_folders_of_the_window_point_down() {
    let mut arrows = 0;
    let folder = |module: &[String]| (module.first()? == "viewer").then(|| module.get(1).cloned())?;
    for (module, used) in imports() {
        let name = module.join("/");
        for used in used {
            if module[..1] == ["viewer"] {
                assert!(used[..1] != ["cli"], "{name} knows the command line");
            }
            let (Some(from), Some(to)) = (folder(&module), folder(&used)) else { continue };
            let level = |folder: &str| VIEWER.iter().position(|layer| layer.contains(&folder));
            arrows += 1;
            if from != to {
                assert!(level(&from) < level(&to), "{name} uses {to}, which is not below {from}");
            }
        }
    }
    assert!(arrows > 100, "the search finds arrows: {arrows}");
}
