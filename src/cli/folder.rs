//! The folder of `-o DIR`.
use std::path::Path;

use noisefall_base::file::{check, replace};

use super::messages::{Failure, print};

/// File name of a report.
#[cfg(feature = "reports")]
pub const REPORT: &str = "report.html";

/// Creates the folder if it does not exist. Reports a problem with it, or with the file of this name in it, before the work
/// begins.
pub fn make(folder: &Path, name: &str) -> Result<(), Failure> {
    if folder.exists() && !folder.is_dir() {
        return Err(format!("{}: this is a file; -o needs a folder", folder.display()));
    }
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: cannot be created: {}", folder.display(), error.kind()))?;
    check(&folder.join(name)).map_err(|error| error.to_string())
}

/// Writes the report and prints its path.
#[cfg(feature = "reports")]
pub fn write_report(folder: &Path, html: &str) -> Result<(), Failure> {
    write(folder, REPORT, html, "report")
}

/// Writes a file into the folder, and prints what it is and its path.
pub fn write(folder: &Path, name: &str, text: &str, what: &str) -> Result<(), Failure> {
    let path = folder.join(name);
    replace(&path, text.as_bytes()).map_err(|error| error.to_string())?;
    print(&format!("{what}: {}", path.display()))
}
