//! Tells the program which commit it was built from, or "unknown" where that cannot be known.
use std::{path::Path, process::Command};

/// What the library is compiled from, beside `src`.
const SOURCES: [&str; 4] = ["build.rs", "Cargo.lock", "Cargo.toml", "scenes"];
/// Files and folders in `src` that the library is not compiled from.
const OTHERS: [&str; 5] = ["cli", "main.rs", "tests", "tests.rs", "viewer"];

/// Neither a commit alone nor a change of the window or of a test compiles the library again: no image depends on them.
#[allow(clippy::print_stdout, reason = "this is how a build script speaks to cargo")]
fn main() {
    let mut sources = SOURCES.map(str::to_owned).to_vec();
    add_files(Path::new("src"), &mut sources);
    for path in sources.iter().filter(|path| Path::new(path).exists()) {
        println!("cargo:rerun-if-changed={path}");
    }
    println!("cargo:rustc-env=NOISEFALL_COMMIT={}", commit(&sources).or_else(packaged).unwrap_or_else(|| "unknown".to_owned()));
}

fn add_files(folder: &Path, files: &mut Vec<String>) {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    for entry in entries.filter(|entry| !OTHERS.contains(&&*entry.file_name().to_string_lossy())) {
        let path = entry.path();
        if path.is_dir() { add_files(&path, files) } else { files.push(path.display().to_string()) }
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
    let source = Path::new(&std::env::var_os("CARGO_MANIFEST_DIR")?).canonicalize().ok()?;
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
