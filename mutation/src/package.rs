//! The source of the package and the copy of it in which mutants are inserted.
use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    hash::{DefaultHasher, Hash, Hasher},
    path::{Path, PathBuf},
};

use syn::Item;

use crate::{Outcome, finder, mutant::Mutant, schemata, schemata::Mutated};

const SWITCH: &str = include_str!("../switch/mutant.rs");
/// Not part of the copy.
const LEFT_OUT: [&str; 4] = ["target", ".git", ".ci", "mutation"];

pub struct Package {
    /// Files by their path relative to the package, with `/` on every system.
    files: BTreeMap<String, Vec<u8>>,
}

impl Package {
    /// Reads the package in a folder.
    pub fn read(folder: &Path) -> Outcome<Package> {
        if !folder.join("src/lib.rs").exists() {
            return Err(format!("there is no src/lib.rs in {}: start at the top of the repository", folder.display()));
        }
        let mut package = Package { files: BTreeMap::new() };
        for entry in entries(folder)? {
            let name = entry.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if !LEFT_OUT.contains(&name.as_str()) {
                package.add(&entry, &name)?;
            }
        }
        Ok(package)
    }

    fn add(&mut self, path: &Path, name: &str) -> Outcome<()> {
        if path.is_dir() {
            for entry in entries(path)? {
                let inner = entry.file_name().unwrap_or_default().to_string_lossy().into_owned();
                self.add(&entry, &format!("{name}/{inner}"))?;
            }
        } else {
            self.files.insert(name.to_owned(), fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?);
        }
        Ok(())
    }

    /// The text of a source file, empty if there is none.
    pub fn text(&self, file: &str) -> &str {
        self.files.get(file).and_then(|bytes| std::str::from_utf8(bytes).ok()).unwrap_or_default()
    }

    /// The files of the program itself, without tests.
    pub fn sources(&self) -> Outcome<Vec<&str>> {
        let all = self.files.keys().filter(|name| is_source(name) && name.ends_with(".rs"));
        let all: Vec<&str> = all.map(String::as_str).collect();
        let mut tests = BTreeSet::new();
        for file in &all {
            let parsed = syn::parse_file(self.text(file)).map_err(|error| format!("{file}: {error}"))?;
            let modules = parsed.items.iter().filter_map(|item| match item {
                Item::Mod(item) if item.content.is_none() && finder::is_conditional(&item.attrs) => Some(item.ident.to_string()),
                _ => None,
            });
            tests.extend(modules.map(|name| format!("{}/{name}", folder_of_modules(file))));
        }
        let is_test = |file: &str| tests.iter().any(|test| file == format!("{test}.rs") || file.starts_with(&format!("{test}/")));
        // Mutants that tests ask for are in no program.
        Ok(all.into_iter().filter(|file| !is_test(file) && !file.ends_with("/mutant.rs")).collect())
    }

    /// Every mutant that could be made.
    pub fn candidates(&self) -> Outcome<Vec<Mutant>> {
        let sources = self.sources()?;
        let mutants =
            sources.iter().map(|file| finder::mutants(file, self.text(file)).map_err(|error| format!("{file}: {error}")));
        Ok(mutants.collect::<Outcome<Vec<_>>>()?.concat())
    }

    /// Leaves all levels of vector instructions out but AVX2 and one lane, which halves the time of the build.
    pub fn leave_levels_out(&mut self) {
        let name = "crates/base/src/math/level.rs";
        let mut kept = String::new();
        let mut lines = self.text(name).lines().peekable();
        while let Some(line) = lines.next() {
            let is_other = |line: &str| line.contains(".as_sse4_2()") || line.contains(".as_avx512()");
            let next = lines.peek().filter(|next| line.trim().starts_with("#[cfg(") && is_other(next));
            if let Some(next) = next {
                // A line, or a whole arm, which ends where its braces do.
                let indent = line.len() - line.trim_start().len();
                let is_arm = next.contains("=>");
                lines.by_ref().find(|line| !is_arm || line.trim() == "}" && line.len() - line.trim_start().len() == indent);
            } else if !is_other(line) {
                kept.push_str(line);
                kept.push('\n');
            }
        }
        self.files.insert(name.to_owned(), kept.into_bytes());
    }

    /// A number that changes with the package.
    pub fn hash(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.files.iter().filter(|(name, _)| !name.ends_with(".md")).for_each(|file| file.hash(&mut hasher));
        hasher.finish()
    }

    /// Writes the copy with mutants inserted, which are numbered from 1 on. Files that stay the same keep their time.
    pub fn write(&self, folder: &Path, mutants: &[Mutant]) -> Outcome<BTreeMap<String, Mutated>> {
        let mut inserted: BTreeMap<String, Mutated> = BTreeMap::new();
        let mut by_file: BTreeMap<&str, Vec<(u32, &Mutant)>> = BTreeMap::new();
        for (id, mutant) in (1..).zip(mutants) {
            by_file.entry(&mutant.file).or_default().push((id, mutant));
        }
        for (file, mutants) in by_file {
            let switch = if file.starts_with("crates/base/") { "crate::mutant::on" } else { "noisefall_base::mutant::on" };
            inserted.insert(file.to_owned(), schemata::insert(self.text(file), &mutants, switch));
        }
        for (name, bytes) in &self.files {
            let text = inserted.get(name).map_or(bytes.as_slice(), |inserted| inserted.text.as_bytes());
            match name.as_str() {
                "crates/base/src/lib.rs" => write_if_new(&folder.join(name), &[text, b"\npub mod mutant;\n"].concat())?,
                _ => write_if_new(&folder.join(name), text)?,
            }
        }
        write_if_new(&folder.join("crates/base/src/mutant.rs"), SWITCH.as_bytes())?;
        self.remove_others(folder)?;
        Ok(inserted)
    }

    /// Removes source files of an earlier copy that the package does not have any more.
    fn remove_others(&self, folder: &Path) -> Outcome<()> {
        let copy = Package::read(folder)?;
        for name in copy.files.keys().filter(|name| !self.files.contains_key(*name) && *name != "crates/base/src/mutant.rs") {
            fs::remove_file(folder.join(name)).map_err(|error| format!("{name}: {error}"))?;
        }
        Ok(())
    }
}

fn entries(folder: &Path) -> Outcome<Vec<PathBuf>> {
    let wrong = |error| format!("{}: {error}", folder.display());
    fs::read_dir(folder).map_err(wrong)?.map(|entry| entry.map(|entry| entry.path()).map_err(wrong)).collect()
}

/// Whether a file lies in the folder `src` of a crate.
fn is_source(name: &str) -> bool {
    name.starts_with("src/") || name.starts_with("crates/") && name.split('/').nth(2) == Some("src")
}

/// Where the modules that a file declares lie.
fn folder_of_modules(file: &str) -> String {
    let (folder, name) = file.rsplit_once('/').unwrap_or(("", file));
    match name {
        "mod.rs" | "lib.rs" | "main.rs" => folder.to_owned(),
        _ => file.trim_end_matches(".rs").to_owned(),
    }
}

fn write_if_new(path: &Path, bytes: &[u8]) -> Outcome<()> {
    if fs::read(path).is_ok_and(|old| old == bytes) {
        return Ok(());
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    fs::create_dir_all(folder).and_then(|()| fs::write(path, bytes)).map_err(|error| format!("{}: {error}", path.display()))
}
