//! The folder that `-o` names.
use std::path::Path;

use noisefall::file::{replace, temporary};

use super::{Failure, print};

/// The file in the folder that a report goes to.
const REPORT: &str = "report.html";

/// Makes the folder if it is not there. What is wrong with it is told before a minute is spent.
pub fn make(folder: &Path) -> Result<(), Failure> {
    if folder.exists() && !folder.is_dir() {
        return Err(format!("{}: this is a file; -o names a folder", folder.display()));
    }
    let refused = |error: std::io::Error| format!("{}: cannot be written to: {}", folder.display(), error.kind());
    std::fs::create_dir_all(folder).and_then(|()| temporary(folder).map(drop)).map_err(refused)
}

/// Writes the report and says where it is.
pub fn write_report(folder: &Path, html: &str) -> Result<(), Failure> {
    write(folder, REPORT, html, "report")
}

/// Writes a file of the folder, and says what and where it is.
pub fn write(folder: &Path, name: &str, text: &str, what: &str) -> Result<(), Failure> {
    let path = folder.join(name);
    replace(folder, name, text.as_bytes()).map_err(|error| format!("{}: cannot be written: {error}", path.display()))?;
    print(&format!("{what}: {}", path.display()))
}
