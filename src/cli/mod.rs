//! The command line. Exit status 0 done, 1 failed with a message on standard error, 2 wrong usage.
mod check;
mod compare;
mod options;
mod render;
mod replay;

use std::{io::Write, path::PathBuf, process::ExitCode};

use clap::{Parser, Subcommand};

/// Why a command failed: one message, of one or several lines.
pub type Failure = String;

/// Solves the light transport equation while you watch.
///
/// Without a command, opens the window on SCENE, or on the built-in Cornell box.
#[derive(Parser)]
#[command(name = "noisefall", version, args_conflicts_with_subcommands = true)]
struct Arguments {
    /// Scene file (.toml) to open in the window
    scene: Option<PathBuf>,
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Subcommand)]
enum Command {
    /// Render a scene to a PNG or EXR file, without a window
    Render(render::Arguments),
    /// Error of picture A against reference B
    Compare(compare::Arguments),
    /// Read and check scene files; render nothing
    Check(check::Arguments),
}

pub fn run() -> ExitCode {
    let arguments = Arguments::parse();
    let done = match arguments.command {
        None => window(arguments.scene),
        Some(Command::Render(arguments)) => render::run(&arguments),
        Some(Command::Compare(arguments)) => compare::run(&arguments),
        Some(Command::Check(arguments)) => check::run(&arguments),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// Prints text and ends the line. A reader that has gone away, as in `… | head`, is no failure.
fn print(text: &str) -> Result<(), Failure> {
    match writeln!(std::io::stdout(), "{text}") {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(format!("standard output: {error}")),
        _ => Ok(()),
    }
}

#[cfg(feature = "viewer")]
fn window(scene: Option<PathBuf>) -> Result<(), Failure> {
    crate::viewer::run(scene)
}

#[cfg(not(feature = "viewer"))]
fn window(_: Option<PathBuf>) -> Result<(), Failure> {
    Err("this build has no window (feature `viewer` is off); use `noisefall render SCENE -o picture.png`".to_owned())
}
