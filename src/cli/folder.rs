//! The folder that `-o` names.
use std::path::Path;

use noisefall::file::{check, replace};

use super::messages::{Failure, print};

/// The file in the folder that a report goes to.
pub const REPORT: &str = "report.html";

/// Makes the folder if it is not there. What is wrong with it, or with the file of this name in it, is told before a minute is spent.
pub fn make(folder: &Path, name: &str) -> Result<(), Failure> {
    if folder.exists() && !folder.is_dir() {
        return Err(format!("{}: this is a file; -o names a folder", folder.display()));
    }
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: cannot be made: {}", folder.display(), error.kind()))?;
    check(&folder.join(name)).map_err(|error| error.to_string())
}

/// Writes the report and says where it is.
pub fn write_report(folder: &Path, html: &str) -> Result<(), Failure> {
    write(folder, REPORT, html, "report")
}

/// Writes a file of the folder, and says what and where it is.
pub fn write(folder: &Path, name: &str, text: &str, what: &str) -> Result<(), Failure> {
    let path = folder.join(name);
    replace(&path, text.as_bytes()).map_err(|error| error.to_string())?;
    print(&format!("{what}: {}", path.display()))
}
