//! There are no circular imports between files or folders.
use std::collections::{BTreeMap, BTreeSet};

use crate::imports::{Imports, Module, imports, source};

/// The imports between the files and subfolders of a folder.
fn within(folder: &[String], imports: &Imports) -> BTreeMap<String, BTreeSet<String>> {
    let part = |module: &Module| -> Option<String> {
        Some(module.strip_prefix(folder)?.first().map_or_else(|| "mod".to_owned(), Clone::clone))
    };
    let mut parts: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (from, used) in imports {
        let Some(from) = part(from) else { continue };
        let to = used.iter().filter_map(part).filter(|to| *to != from);
        parts.entry(from.clone()).or_default().extend(to);
    }
    parts
}

/// A circle of arrows.
fn circle(arrows: &BTreeMap<String, BTreeSet<String>>) -> Option<Vec<String>> {
    let mut left = arrows.clone();
    // A module that imports none of the remaining ones is not part of a circle.
    while let Some(end) = left.iter().find(|(_, to)| !to.iter().any(|to| left.contains_key(to))).map(|(end, _)| end.clone()) {
        left.remove(&end);
    }
    let mut way = vec![left.keys().next()?.clone()];
    loop {
        let next = left[way.last()?].iter().find(|to| left.contains_key(*to))?.clone();
        if let Some(start) = way.iter().position(|name| *name == next) {
            return Some(way.split_off(start));
        }
        way.push(next);
    }
}

#[test]
fn nothing_imports_itself_by_way_of_others() {
    let imports = imports();
    let folders: BTreeSet<Module> = imports.keys().flat_map(|module| (0..=module.len()).map(|n| module[..n].to_vec())).collect();
    let mut wrong = Vec::new();
    for folder in &folders {
        if let Some(circle) = circle(&within(folder, &imports)) {
            wrong.push(format!("{}: {}", folder.join("/"), circle.join(" -> ")));
        }
    }
    assert!(imports.values().map(BTreeSet::len).sum::<usize>() > 500, "the search finds imports");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn no_folder_is_exempt() {
    let files = source().into_iter().filter(|file| !file.is_test());
    let folders: BTreeSet<Module> =
        files.filter_map(|file| Some(file.name.rsplit_once('/')?.0.split('/').map(str::to_owned).collect())).collect();
    let imports = imports();
    for folder in &folders {
        assert!(imports.keys().any(|module| module.starts_with(folder)), "{} is not searched", folder.join("/"));
    }
    assert!(folders.len() > 40, "{} folders", folders.len());
}

#[test]
fn a_module_with_a_folder_is_in_it() {
    for file in source() {
        assert!(!file.path.with_extension("").is_dir(), "{}: move it to mod.rs in the folder beside it", file.name);
    }
}

#[test]
fn a_circle_is_found_behind_a_chain() {
    let arrows = |arrows: &[(&str, &str)]| {
        let mut all: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for (from, to) in arrows {
            all.entry((*from).to_owned()).or_default().insert((*to).to_owned());
            all.entry((*to).to_owned()).or_default();
        }
        all
    };
    assert_eq!(circle(&arrows(&[("a", "b"), ("b", "c"), ("a", "c")])), None);
    let found = circle(&arrows(&[("a", "b"), ("b", "c"), ("c", "d"), ("d", "b"), ("d", "e")]));
    assert_eq!(found, Some(["b", "c", "d"].map(str::to_owned).to_vec()));
}
