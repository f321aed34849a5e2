//! The program: a window onto a path tracer, and its headless commands.
use std::process::ExitCode;

mod cli;
mod kept_scene;
#[cfg(feature = "viewer")]
mod viewer;

fn main() -> ExitCode {
    cli::run()
}
