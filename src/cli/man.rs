//! `noisefall man`: writes manual pages, which are generated from the declarations of the command line.
use std::path::{Path, PathBuf};

use clap::Command;
use clap_mangen::Man;
use noisefall_base::file::replace;

use super::{
    folder,
    messages::{Failure, print},
};

/// An argument without characters. A truly empty one would be left out, and the source would stand in place of the date.
const NO_DATE: &str = "\"\"";

#[derive(clap::Args)]
pub struct Arguments {
    /// Folder for the pages, such as ~/.local/share/man/man1; created if it does not exist
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
}

pub fn run(arguments: &Arguments, program: Command) -> Result<(), Failure> {
    let folder = &arguments.output;
    let mut program = program.disable_help_subcommand(true);
    program.build();
    let commands: Vec<Command> = program.get_subcommands().cloned().collect();
    let pages = std::iter::once(program).chain(commands).map(|command| write(folder, command));
    let count = pages.collect::<Result<Vec<()>, Failure>>()?.len();
    print(&format!("{count} pages: {}", folder.display()))
}

fn write(folder: &Path, command: Command) -> Result<(), Failure> {
    let page = Man::new(command).manual("Noisefall").source(concat!("Noisefall ", env!("CARGO_PKG_VERSION"))).date(NO_DATE);
    let (name, mut text) = (page.get_filename(), Vec::new());
    folder::make(folder, &name)?;
    page.render(&mut text).map_err(|error| format!("{name}: {error}"))?;
    replace(&folder.join(&name), &text).map_err(|error| error.to_string())
}
