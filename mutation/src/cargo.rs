//! Cargo on the copy: which mutants do not compile, and where the tests are.
use std::{
    collections::{BTreeMap, BTreeSet},
    ops::Range,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

use serde_json::Value;

use crate::{Outcome, schemata::Mutated};

pub struct Build {
    /// Numbers of mutants that do not compile.
    pub rejected: BTreeSet<u32>,
    /// Executables with tests, by the name of their target.
    pub tests: Vec<(String, PathBuf)>,
}

/// Runs cargo on the copy in a folder, and tells which of the mutants it refuses.
pub fn build(folder: &Path, target: &Path, arguments: &[&str], inserted: &BTreeMap<String, Mutated>) -> Outcome<Build> {
    let mut command = Command::new("cargo");
    command.args(arguments).args(["--release", "--locked", "--keep-going", "--message-format=json"]).current_dir(folder);
    command.env("CARGO_TARGET_DIR", target).env("CARGO_INCREMENTAL", "0").stderr(Stdio::piped());
    let output = command.output().map_err(|error| format!("cargo cannot be started: {error}"))?;
    let mut build = Build { rejected: BTreeSet::new(), tests: Vec::new() };
    for line in String::from_utf8_lossy(&output.stdout).lines() {
        let Ok(message) = serde_json::from_str::<Value>(line) else { continue };
        match message["reason"].as_str() {
            Some("compiler-message") if message["message"]["level"] == "error" => {
                let spans = spans(&message["message"]);
                let found = blamed(&spans, inserted);
                if found.is_empty() && !spans.is_empty() {
                    let text = message["message"]["rendered"].as_str().unwrap_or_default();
                    return Err(format!("the copy does not compile, and no mutant is to blame:\n{text}"));
                }
                build.rejected.extend(found);
            }
            Some("compiler-artifact") if message["profile"]["test"] == true => {
                let name = message["target"]["name"].as_str().unwrap_or_default();
                let is_library = message["target"]["kind"].as_array().is_some_and(|kinds| kinds.iter().any(|kind| kind == "lib"));
                if let Some(path) = message["executable"].as_str() {
                    build.tests.push((if is_library { "lib".to_owned() } else { name.to_owned() }, PathBuf::from(path)));
                }
            }
            _ => {}
        }
    }
    if !output.status.success() && build.rejected.is_empty() {
        return Err(format!("cargo {} failed:\n{}", arguments.join(" "), String::from_utf8_lossy(&output.stderr)));
    }
    build.tests.sort();
    Ok(build)
}

/// The mutants where an error lies, else the nearest one of the file.
fn blamed(spans: &[(String, Range<usize>)], inserted: &BTreeMap<String, Mutated>) -> Vec<u32> {
    let files = spans.iter().filter_map(|(file, bytes)| Some((inserted.get(file)?, bytes)));
    let there: Vec<u32> = files.clone().flat_map(|(inserted, bytes)| inserted.at(bytes)).collect();
    if there.is_empty() { files.filter_map(|(inserted, bytes)| inserted.nearest(bytes.start)).take(1).collect() } else { there }
}

/// Where an error lies: its primary places, and those of the macros that they come from.
fn spans(message: &Value) -> Vec<(String, Range<usize>)> {
    let all: Vec<&Value> = message["spans"].as_array().into_iter().flatten().collect();
    let primary = all.iter().copied().filter(|span| span["is_primary"] == true);
    let mut found = Vec::new();
    for mut span in primary {
        while span.is_object() {
            let [start, end] = ["byte_start", "byte_end"].map(|name| span[name].as_u64().unwrap_or_default() as usize);
            found.push((span["file_name"].as_str().unwrap_or_default().to_owned(), start..end));
            span = &span["expansion"]["span"];
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_in_macros_lie_where_the_macro_is_called() {
        let inner = |start, expansion| serde_json::json!({"file_name": "a.rs", "byte_start": start, "byte_end": start + 2, "is_primary": true, "expansion": expansion});
        let outer = serde_json::json!({"span": {"file_name": "b.rs", "byte_start": 7, "byte_end": 9}});
        let mut other = inner(50, Value::Null);
        other["is_primary"] = false.into();
        let message = serde_json::json!({"spans": [inner(3, outer), other]});
        assert_eq!(spans(&message), [("a.rs".to_owned(), 3..5), ("b.rs".to_owned(), 7..9)]);
    }
}
