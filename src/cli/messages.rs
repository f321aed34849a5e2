//! What the commands say. Results go to standard output, everything else to standard error; readers of either may be gone.
use std::{
    io::{ErrorKind, Write, stderr, stdout},
    process::ExitCode,
};

/// Why a command failed: one message, of one or several lines.
pub type Failure = String;

/// Prints text and ends the line. A reader that has gone away, as in `… | head`, is no failure.
pub fn print(text: &str) -> Result<(), Failure> {
    match writeln!(stdout(), "{text}") {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(format!("standard output: {error}")),
        _ => Ok(()),
    }
}

/// Says something on standard error. Where that cannot be written there is nobody to say so to.
pub fn tell(text: &str) {
    let _ = writeln!(stderr(), "{text}");
}

/// Says why a command cannot be understood, and with which code the program then ends.
pub fn wrong_usage(mistake: &str) -> ExitCode {
    const WRONG_USAGE: u8 = 2;
    tell(mistake);
    ExitCode::from(WRONG_USAGE)
}
