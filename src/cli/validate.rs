//! `noisefall validate`: every exact solution against what the renderer says.
use std::{path::PathBuf, time::Instant};

use noisefall::{
    file::replace,
    validate::{Effort, Section, Validation, html},
};

use super::{Failure, print};

/// The file in the folder that the report goes to.
const REPORT: &str = "report.html";

#[derive(clap::Args)]
pub struct Arguments {
    /// Folder for the report, made if it is not there
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Fewer samples: under half a minute
    #[arg(long)]
    quick: bool,
    /// Folder of reference scenes with block means
    #[arg(long, value_name = "DIR", default_value = "tests/references")]
    references: PathBuf,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    // A folder that cannot be written is told before minutes are spent.
    if let Some(folder) = &arguments.output {
        std::fs::create_dir_all(folder).map_err(|error| format!("{}: cannot be made: {error}", folder.display()))?;
    }
    let effort = if arguments.quick { Effort::Quick } else { Effort::Full };
    let start = Instant::now();
    let mut lines = Vec::new();
    let sections = Validation::new(effort, arguments.references.clone()).run(|number, section| lines.push(show(number, section)));
    lines.into_iter().collect::<Result<Vec<()>, Failure>>()?;
    if let Some(folder) = &arguments.output {
        let path = folder.join(REPORT);
        let written = replace(folder, REPORT, html(&sections, effort).as_bytes());
        written.map_err(|error| format!("{}: cannot be written: {error}", path.display()))?;
        print(&format!("report: {}", path.display()))?;
    }
    let statements: usize = sections.iter().map(|section| section.statements.len()).sum();
    let failed: usize = sections.iter().map(failures).sum();
    let seconds = start.elapsed().as_secs_f64();
    if failed > 0 {
        return Err(format!("{failed} of {statements} statements fail ({seconds:.0} s)"));
    }
    print(&format!("all {statements} statements hold ({seconds:.0} s)"))
}

fn failures(section: &Section) -> usize {
    section.statements.iter().filter(|statement| !statement.holds).count()
}

/// A line for the section, and one for each statement that fails.
fn show(number: usize, section: &Section) -> Result<(), Failure> {
    let verdict = if section.holds() { "holds" } else { "FAILS" };
    print(&format!("{number:>2}  {verdict}  {:>3} statements  {}", section.statements.len(), section.title))?;
    for statement in section.statements.iter().filter(|statement| !statement.holds) {
        let (measured, exact) = (statement.measured, statement.exact);
        print(&format!(
            "           {}: {measured:.6e} ± {:.1e}, exact {exact:.6e}, {}",
            statement.what, statement.error, statement.statistic
        ))?;
    }
    Ok(())
}
