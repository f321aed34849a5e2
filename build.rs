//! Tells the program which commit it was built from, or "unknown" where that cannot be known.
use std::{path::Path, process::Command};

#[allow(clippy::print_stdout, reason = "this is how a build script speaks to cargo")]
fn main() {
    println!("cargo:rerun-if-changed=build.rs");
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

fn commit() -> Option<String> {
    // A copy of the source may lie in somebody else's repository, whose commit says nothing.
    let top = Path::new(&git(&["rev-parse", "--show-toplevel"])?).canonicalize().ok()?;
    let source = Path::new(&std::env::var_os("CARGO_MANIFEST_DIR")?).canonicalize().ok()?;
    if top != source {
        return None;
    }
    watch("HEAD");
    // HEAD names a branch, whose file changes with every commit, but is not there while it is packed with others.
    if let Some(branch) = git(&["symbolic-ref", "-q", "HEAD"]) {
        watch(&branch);
    }
    watch("logs/HEAD");
    git(&["rev-parse", "--short=12", "HEAD"])
}

/// Runs this again when a file of the repository changes. One that does not exist would make it run every time.
fn watch(name: &str) {
    if let Some(file) = git(&["rev-parse", "--git-path", name]).filter(|file| Path::new(file).exists()) {
        println!("cargo:rerun-if-changed={file}");
    }
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim().to_owned())
}
