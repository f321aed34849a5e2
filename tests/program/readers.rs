//! Files are opened in one place, which refuses what is no regular file; texts of unknown length have a limit.
use crate::imports::source;

/// Calls that open a file for reading, or read one without limit.
const READS: [&str; 6] =
    ["fs::read(", "fs::read_to_string(", "File::open", "File::options", "OpenOptions", "and_then(io::read_to_string"];
/// The door; leftovers and a store, which are only locked; and figures of the machine.
const READERS: [&str; 5] = ["file/mod.rs", "file/target/mod.rs", "memory.rs", "study/machine.rs", "study/store.rs"];
/// Calls that turn a path of a scene into one that can be opened. Readers of scenes leave that to their folder, which knows what
/// may be read.
const WAYS_AROUND: [&str; 4] = ["canonicalize(", "read_link(", "read_dir(", "env::"];
/// The second looks for names in upper and lower case, below the folder alone; the first resolves what it finds.
const FOLDER: [&str; 2] = ["import/paths.rs", "import/spelling.rs"];

/// The files of the source whose code has one of these, by their paths.
fn with(texts: &[&str], within: &str) -> Vec<String> {
    let mut found = Vec::new();
    for file in source() {
        let is_test = file.name.contains("tests") || ["file/faults.rs", "export/round_trip.rs"].contains(&file.name.as_str());
        if file.name.starts_with(within) && !is_test {
            let code = file.code();
            found.extend(texts.iter().any(|text| has_word(&code, text)).then_some(file.name));
        }
    }
    found.sort();
    found
}

/// Whether a text stands somewhere, and not as the end of another word.
fn has_word(code: &str, text: &str) -> bool {
    code.match_indices(text).any(|(at, _)| !code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_'))
}

#[test]
fn every_file_is_opened_by_the_same_module() {
    assert_eq!(with(&READS, ""), READERS, "other code opens files, or these no longer do");
}

#[test]
fn readers_of_scenes_find_files_through_their_folder_alone() {
    assert_eq!(with(&WAYS_AROUND, "import/"), FOLDER, "a path of a scene is resolved elsewhere");
}

#[test]
fn the_terminal_gets_text_through_one_module() {
    let streams = ["stdout()", "stderr()"];
    // The second sends images to standard output; the third asks whether a bar can be seen.
    assert_eq!(with(&streams, "cli/"), ["cli/loading.rs", "cli/messages.rs", "cli/output.rs"]);
}
