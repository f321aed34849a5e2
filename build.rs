//! Tells the program which commit it was built from, or "unknown" where that cannot be known.
use std::{path::Path, process::Command};

/// What the library is compiled from. A commit alone does not compile it again.
const SOURCES: [&str; 5] = ["build.rs", "Cargo.lock", "Cargo.toml", "scenes", "src"];

#[allow(clippy::print_stdout, reason = "this is how a build script speaks to cargo")]
fn main() {
    for path in SOURCES.into_iter().filter(|path| Path::new(path).exists()) {
        println!("cargo:rerun-if-changed={path}");
    }
    println!("cargo:rustc-env=NOISEFALL_COMMIT={}", commit().or_else(packaged).unwrap_or_else(|| "unknown".to_owned()));
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

/// The commit of the source, with a mark if the source differs from it.
fn commit() -> Option<String> {
    // A copy of the source may lie in somebody else's repository, whose commit says nothing.
    let top = Path::new(&git(&["rev-parse", "--show-toplevel"])?).canonicalize().ok()?;
    let source = Path::new(&std::env::var_os("CARGO_MANIFEST_DIR")?).canonicalize().ok()?;
    if top != source {
        return None;
    }
    let mut commit = git(&["rev-parse", "--short=12", "HEAD"])?;
    if !git(&[&["status", "--porcelain", "--"], &SOURCES[..]].concat())?.is_empty() {
        commit.push_str("+changes");
    }
    Some(commit)
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim().to_owned())
}
