//! The graph of imports between the modules of the program and its library, without tests.
use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::{Path, PathBuf},
};

/// The path of a module, by names from the root of the source.
pub type Module = Vec<String>;

pub type Imports = BTreeMap<Module, BTreeSet<Module>>;

/// A file of the source.
pub struct SourceFile {
    /// Its path below the folder `src` of its crate, with `/`. No two crates have a module of the same name.
    pub name: String,
    pub path: PathBuf,
}

impl SourceFile {
    /// Whether it has only tests.
    pub fn is_test(&self) -> bool {
        self.name.split('/').any(|part| part == "tests" || part == "tests.rs")
    }

    /// Its code, as [`code`] cuts it out.
    pub fn code(&self) -> String {
        code(&fs::read_to_string(&self.path).expect("source is text"))
    }
}

/// The top of the repository.
fn top() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All files of the source, crate by crate.
pub fn source() -> Vec<SourceFile> {
    let crates = fs::read_dir(top().join("crates")).expect("the folder can be read").map(|entry| entry.expect("an entry").path());
    let mut folders: Vec<PathBuf> = crates.chain([top().to_owned()]).map(|folder| folder.join("src")).collect();
    folders.sort();
    let named = |folder: &PathBuf, path: PathBuf| {
        let name = path.strip_prefix(folder).expect("it lies there").display().to_string().replace('\\', "/");
        SourceFile { name, path }
    };
    let files = folders.iter().flat_map(|folder| source_files(folder).into_iter().map(|path| named(folder, path)));
    files.collect()
}

fn source_files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("the folder can be read").map(|entry| entry.expect("an entry").path());
    let is_source = |path: &PathBuf| path.is_dir() || path.extension().is_some_and(|extension| extension == "rs");
    let entries = entries.filter(is_source);
    entries.flat_map(|path| if path.is_dir() { source_files(&path) } else { vec![path] }).collect()
}

/// The modules that each module imports. A name that is re-exported counts as an import from where it is defined.
pub fn imports() -> Imports {
    let files = source().into_iter().filter(|file| !file.is_test());
    let files: Files = files.map(|file| (module(&file.name), uses(&file.code()))).collect();
    let used = |(from, uses): (&Module, &Vec<Use>)| {
        let paths = uses.iter().filter(|found| !found.exports).filter_map(|found| resolve(&files, from, &found.path));
        (from.clone(), paths.filter(|to| to != from).collect())
    };
    files.iter().map(used).collect()
}

type Files = BTreeMap<Module, Vec<Use>>;

struct Use {
    path: Module,
    exports: bool,
}

fn module(name: &str) -> Module {
    let names: Module = name.trim_end_matches(".rs").split('/').map(str::to_owned).collect();
    let is_root = |name: &String| name == "mod" || name == "lib" || name == "main";
    if names.last().is_some_and(is_root) { names[..names.len() - 1].to_vec() } else { names }
}

/// The text without comments and without the tests at its end.
pub fn code(text: &str) -> String {
    let end = text.match_indices("#[cfg(test)]").map(|(at, _)| at).find(|at| text[*at..].lines().nth(1).is_some_and(is_tests));
    let lines = text[..end.unwrap_or(text.len())].lines().filter(|line| !line.trim_start().starts_with("//"));
    lines.collect::<Vec<_>>().join("\n")
}

fn is_tests(line: &str) -> bool {
    line.trim_start_matches("pub ").starts_with("mod tests {")
}

/// The paths in statements `use`, and those behind `crate::` and `super::` in other code.
fn uses(code: &str) -> Vec<Use> {
    let (mut found, mut rest) = (Vec::new(), String::new());
    for statement in code.split_inclusive(';') {
        let words = statement.trim_end_matches(';');
        let start = words.rfind("\nuse ").or(words.rfind(" use ")).or(words.starts_with("use ").then_some(0));
        let Some(start) = start.filter(|at| !words[at + 4..].contains('(')) else {
            rest += statement;
            continue;
        };
        let line = words[..start].rsplit('\n').next().unwrap_or_default();
        let exports = words[start..].starts_with(' ') && line.trim_start().starts_with("pub");
        expand(words[start..].trim_start().trim_start_matches("use "), &[], &mut |path| found.push(Use { path, exports }));
        rest += &words[..start];
    }
    for root in ["crate::", "super::"] {
        for (at, _) in rest.match_indices(root) {
            let path: String = rest[at..].chars().take_while(|c| c.is_alphanumeric() || *c == '_' || *c == ':').collect();
            found.push(Use { path: path.split("::").map(str::to_owned).collect(), exports: false });
        }
    }
    found
}

/// The paths of a tree as `a::{b, c::{d, e}}`.
fn expand(tree: &str, before: &[String], found: &mut impl FnMut(Module)) {
    let (head, group) = tree.split_once('{').map_or((tree, None), |(head, group)| (head, Some(group)));
    let names = head.split(" as ").next().unwrap_or_default().split("::").map(|name| name.trim().to_owned());
    let path: Module = before.iter().cloned().chain(names.filter(|name| !name.is_empty())).collect();
    let Some(group) = group.and_then(|group| group.trim_end().strip_suffix('}')) else { return found(path) };
    let (mut depth, mut start) = (0, 0);
    for (at, c) in group.char_indices().chain([(group.len(), ',')]) {
        depth += i32::from(c == '{') - i32::from(c == '}');
        if depth == 0 && c == ',' {
            if !group[start..at].trim().is_empty() {
                expand(group[start..at].trim(), &path, found);
            }
            start = at + 1;
        }
    }
}

/// The module that a path leads into, as seen from another one.
fn resolve(files: &Files, from: &[String], path: &[String]) -> Option<Module> {
    let child = |name: &String| files.contains_key(&[from, std::slice::from_ref(name)].concat());
    let (mut base, mut rest) = match path.first()?.as_str() {
        root if root == "crate" || root.starts_with("noisefall") => (Vec::new(), &path[1..]),
        "self" => (from.to_vec(), &path[1..]),
        "super" => (from.to_vec(), path),
        _ if child(&path[0]) => (from.to_vec(), path),
        _ => return None,
    };
    while rest.first().is_some_and(|name| name == "super") {
        (_, rest) = (base.pop(), &rest[1..]);
    }
    while let Some(name) = rest.first() {
        base.push(name.clone());
        if !files.contains_key(&base) {
            base.pop();
            break;
        }
        rest = &rest[1..];
    }
    let exported =
        rest.first().and_then(|name| files.get(&base)?.iter().find(|found| found.exports && found.path.last() == Some(name)));
    exported.and_then(|found| resolve(files, &base, &found.path)).or(Some(base))
}

#[test]
fn paths_of_imports_are_understood() {
    let text = "//! use crate::no;\npub use self::a::B;\nuse crate::{c::{D, E as F}, g};\nfn f() { super::h::I }\n#[cfg(test)]\nmod tests {\nuse crate::no;\n}";
    let found = uses(&code(text));
    let paths: Vec<String> = found.iter().map(|found| found.path.join("::")).collect();
    assert_eq!(paths, ["self::a::B", "crate::c::D", "crate::c::E", "crate::g", "super::h::I"]);
    assert!(found[0].exports && found[1..].iter().all(|found| !found.exports));
}
