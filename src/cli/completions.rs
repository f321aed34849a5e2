//! `noisefall completions`: prints completions for a shell, which are generated from the declarations of the command line.
use clap::Command;
use clap_complete::{Shell, generate};

use super::messages::{Failure, print};

const NOTES: &str = "\
Examples:
  noisefall completions bash > ~/.local/share/bash-completion/completions/noisefall
  noisefall completions fish > ~/.config/fish/completions/noisefall.fish
  noisefall completions zsh > ~/.zfunc/_noisefall        # with ~/.zfunc in $fpath
  noisefall completions powershell >> $PROFILE";

#[derive(clap::Args)]
#[command(after_help = NOTES)]
pub struct Arguments {
    /// The shell
    shell: Shell,
}

pub fn run(arguments: &Arguments, mut program: Command) -> Result<(), Failure> {
    let mut script = Vec::new();
    generate(arguments.shell, &mut program, "noisefall", &mut script);
    print(String::from_utf8_lossy(&script).trim_end())
}
