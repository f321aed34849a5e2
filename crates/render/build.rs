//! Tells the renderer which commit it was built from, or "unknown" where that cannot be known.
use std::{path::Path, process::Command};

/// The top of the repository.
const TOP: &str = "../..";
/// Files and folders below the top that the renderer is compiled from.
const SOURCES: [&str; 8] = [
    "Cargo.lock",
    "Cargo.toml",
    "scenes",
    "crates/base",
    "crates/kernel",
    "crates/scene",
    "crates/render/build.rs",
    "crates/render/src",
];
/// Files and folders that it is not compiled from.
const OTHERS: [&str; 3] = ["README.md", "tests", "tests.rs"];

/// Neither a commit alone nor a change of the window or of a test compiles the library again: no image depends on them.
#[allow(clippy::print_stdout, reason = "this is how a build script speaks to cargo")]
fn main() {
    let mut sources = Vec::new();
    SOURCES.iter().for_each(|source| add_files(&Path::new(TOP).join(source), &mut sources));
    for path in sources.iter().filter(|path| Path::new(path).exists()) {
        println!("cargo:rerun-if-changed={path}");
    }
    println!("cargo:rustc-env=NOISEFALL_COMMIT={}", commit(&sources).or_else(packaged).unwrap_or_else(|| "unknown".to_owned()));
}

fn add_files(path: &Path, files: &mut Vec<String>) {
    if !path.is_dir() {
        files.push(path.display().to_string());
        return;
    }
    let entries = std::fs::read_dir(path).into_iter().flatten().flatten();
    for entry in entries.filter(|entry| !OTHERS.contains(&&*entry.file_name().to_string_lossy())) {
        add_files(&entry.path(), files);
    }
}

/// The commit that a package was made from, which cargo notes in it.
fn packaged() -> Option<String> {
    const NOTE: &str = ".cargo_vcs_info.json";
    if Path::new(NOTE).exists() {
        println!("cargo:rerun-if-changed={NOTE}");
    }
    let note = std::fs::read_to_string(NOTE).ok()?;
    let commit = note.split_once("\"sha1\": \"")?.1.get(..12)?;
    commit.chars().all(|c| c.is_ascii_hexdigit()).then(|| commit.to_owned())
}

/// The commit of the sources, with a mark if they differ from it.
fn commit(sources: &[String]) -> Option<String> {
    // A copy of the source may lie in somebody else's repository, whose commit says nothing.
    let top = Path::new(&git(&["rev-parse", "--show-toplevel"])?).canonicalize().ok()?;
    let source = Path::new(&std::env::var_os("CARGO_MANIFEST_DIR")?).join(TOP).canonicalize().ok()?;
    if top != source {
        return None;
    }
    let mut commit = git(&["rev-parse", "--short=12", "HEAD"])?;
    if !git(&[vec!["status", "--porcelain", "--"], sources.iter().map(String::as_str).collect()].concat())?.is_empty() {
        commit.push_str("+changes");
    }
    Some(commit)
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim().to_owned())
}
