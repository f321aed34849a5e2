//! Output of the commands. Results go to standard output, everything else to standard error. Either may be closed by its reader.
//!
//! Nothing else prints: what files bring along, such as titles and names, has no effect on the terminal here.
use std::{
    io::{ErrorKind, Write, stderr, stdout},
    process::ExitCode,
};

use noisefall_base::quote;

/// Error message of a command, of one or several lines.
pub type Failure = String;

/// Prints a line to standard output. A reader that has gone away, as in `… | head`, is not an error.
pub fn print(text: &str) -> Result<(), Failure> {
    match writeln!(stdout(), "{}", quote::lines(text)) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(format!("standard output: {error}")),
        _ => Ok(()),
    }
}

/// Prints a line to standard error. Failures to do so are ignored.
pub fn tell(text: &str) {
    let _ = writeln!(stderr(), "{}", quote::lines(text));
}

/// Reports wrong usage. Returns the exit code for it.
pub fn wrong_usage(mistake: &str) -> ExitCode {
    const WRONG_USAGE: u8 = 2;
    tell(mistake);
    ExitCode::from(WRONG_USAGE)
}
