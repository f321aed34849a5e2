//! `noisefall validate`: every exact solution against what the renderer says.
use std::{path::PathBuf, time::Instant};

use noisefall::validate::{Effort, Section, Validation, html, reference_names};

use super::{Failure, folder, print};

const REFERENCES: &str = "tests/references";

#[derive(clap::Args)]
pub struct Arguments {
    /// Folder for the report, made if it is not there
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Fewer samples: under half a minute
    #[arg(long)]
    quick: bool,
    /// Folder of reference scenes with block means [default: tests/references, if it is there]
    #[arg(long, value_name = "DIR")]
    references: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    check(arguments)?;
    let references = arguments.references.clone().unwrap_or_else(|| REFERENCES.into());
    let effort = if arguments.quick { Effort::Quick } else { Effort::Full };
    let start = Instant::now();
    let mut lines = Vec::new();
    let sections = Validation::new(effort, references).run(|number, section| lines.push(show(number, section)));
    lines.into_iter().collect::<Result<Vec<()>, Failure>>()?;
    if let Some(output) = &arguments.output {
        folder::write_report(output, &html(&sections, effort))?;
    } else {
        print("no report was written: -o DIR says where to")?;
    }
    let statements: usize = sections.iter().map(|section| section.statements.len()).sum();
    let failed: usize = sections.iter().map(failures).sum();
    let seconds = start.elapsed().as_secs_f64();
    if failed > 0 {
        return Err(format!("{failed} of {statements} statements fail ({seconds:.0} s)"));
    }
    print(&format!("all {statements} statements hold ({seconds:.0} s)"))
}

/// What is wrong with the folders is told before a minute is spent.
fn check(arguments: &Arguments) -> Result<(), Failure> {
    if let Some(folder) = &arguments.references
        && reference_names(folder).is_empty()
    {
        return Err(format!("{}: no references (NAME.toml with NAME.txt) in this folder", folder.display()));
    }
    arguments.output.as_deref().map_or(Ok(()), folder::make)
}

fn failures(section: &Section) -> usize {
    section.statements.iter().filter(|statement| !statement.holds).count()
}

/// A line for the section, and one for each statement that fails.
fn show(number: usize, section: &Section) -> Result<(), Failure> {
    let verdict = match (section.was_run(), section.holds()) {
        (false, _) => "not run",
        (_, true) => "holds",
        (_, false) => "FAILS",
    };
    print(&format!("{number:>2}  {verdict:<7}  {:>3} statements  {}", section.statements.len(), section.title.replace('_', "")))?;
    for statement in section.statements.iter().filter(|statement| !statement.holds) {
        let measured = statement.measured;
        let exact = statement.exact.map_or(String::new(), |exact| format!("exact {exact:.6e}, "));
        print(&format!(
            "           {}: {measured:.6e} ± {:.1e}, {exact}{}",
            statement.what, statement.error, statement.statistic
        ))?;
    }
    Ok(())
}
