//! `noisefall validate`: compares the renderer with exact solutions.
use std::{
    path::{Path, PathBuf},
    time::Instant,
};

use noisefall_base::file::replace;
use noisefall_lab::validate::{Effort, FailedScene, Section, Suite, Validation, csv, drawings, html, json, reference_names};

use super::{
    folder,
    messages::{Failure, print, tell},
};

/// Folder beside the report for the scenes that fail.
const KEPT: &str = "stress";
/// Folder beside the report for its figures.
const FIGURES: &str = "figures";
/// The files beside the report.
const FILES: [&str; 3] = [folder::REPORT, "report.csv", "report.json"];

#[derive(clap::Args)]
pub struct Arguments {
    /// Folder for report.html, report.csv, report.json and the figures as SVG; created if it does not exist
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Use fewer samples or scenes; takes less than half a minute
    #[arg(long)]
    quick: bool,
    /// Render more than two thousand adversarial scenes instead; those that fail are written to DIR/stress
    #[arg(long, conflicts_with = "references")]
    stress: bool,
    /// Folder of reference scenes with block means [default: those in the program]
    #[arg(long, value_name = "DIR")]
    references: Option<PathBuf>,
    /// Seed of the random numbers of all measurements
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = super::options::whole, conflicts_with = "stress")]
    seed: u32,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    check(arguments)?;
    let effort = if arguments.quick { Effort::Quick } else { Effort::Full };
    let start = Instant::now();
    let suite = if arguments.stress { Suite::Stress } else { Suite::Exact };
    let validation = validation(arguments, effort);
    let mut lines = Vec::new();
    let done = |number: usize, section: &Section| lines.push(show(number, section, suite));
    let (sections, kept) = match suite {
        Suite::Exact => (validation.run(done), Vec::new()),
        Suite::Stress => validation.stress(done, &tell),
    };
    lines.into_iter().collect::<Result<Vec<()>, Failure>>()?;
    if let Some(output) = &arguments.output {
        write(output, &sections, suite, effort, arguments.seed)?;
        keep(&output.join(KEPT), &kept)?;
    } else {
        print("no report was written: add -o DIR to get one")?;
    }
    let statements: usize = sections.iter().map(|section| section.statements.len()).sum();
    let failed: usize = sections.iter().map(failures).sum();
    let seconds = start.elapsed().as_secs_f64();
    if failed > 0 {
        return Err(format!("{failed} of {statements} statements fail ({seconds:.0} s)"));
    }
    print(&format!("all {statements} statements hold ({seconds:.0} s)"))
}

fn validation(arguments: &Arguments, effort: Effort) -> Validation {
    Validation::new(effort, arguments.references.clone(), arguments.seed)
}

/// Writes the report, its rows and its figures.
fn write(output: &Path, sections: &[Section], suite: Suite, effort: Effort, seed: u32) -> Result<(), Failure> {
    folder::write_report(output, &html(sections, suite, effort, seed))?;
    let rows = csv(sections).map_err(|error| format!("{}: {error}", FILES[1]))?;
    folder::write(output, FILES[1], &rows, "rows")?;
    folder::write(output, FILES[2], &format!("{:#}\n", json(sections, suite, effort, seed)), "rows")?;
    let (figures, drawings) = (output.join(FIGURES), drawings(sections));
    for (name, svg) in &drawings {
        replace(&figures.join(name), svg.as_bytes()).map_err(|error| error.to_string())?;
    }
    print(&format!("{} figures: {}", drawings.len(), figures.display()))
}

/// Writes the scenes that fail, if there are any.
fn keep(folder: &Path, scenes: &[FailedScene]) -> Result<(), Failure> {
    if !scenes.is_empty() {
        std::fs::create_dir_all(folder).map_err(|error| format!("{}: cannot be created: {error}", folder.display()))?;
    }
    scenes.iter().try_for_each(|scene| folder::write(folder, &format!("{}.toml", scene.name), &scene.text, "scene"))
}

/// Reports problems with the folders before the work begins.
fn check(arguments: &Arguments) -> Result<(), Failure> {
    if let Some(folder) = &arguments.references
        && reference_names(folder).is_empty()
    {
        return Err(format!("{}: no references (NAME.toml with NAME.txt) in this folder", folder.display()));
    }
    let make = |folder: &Path| {
        FILES.iter().try_for_each(|name| folder::make(folder, name))?;
        folder::make(&folder.join(FIGURES), "section-01-1.svg")
    };
    arguments.output.as_deref().map_or(Ok(()), make)
}

fn failures(section: &Section) -> usize {
    section.statements.iter().filter(|statement| !statement.holds).count()
}

/// Prints a line for the section, its figures if it is a stress section, and a line for each statement that fails.
fn show(number: usize, section: &Section, suite: Suite) -> Result<(), Failure> {
    let verdict = match (section.was_run(), section.holds()) {
        (false, _) => "not run",
        (_, true) => "holds",
        (_, false) => "FAILS",
    };
    print(&format!("{number:>2}  {verdict:<7}  {:>3} statements  {}", section.statements.len(), section.title.replace('_', "")))?;
    if let (Suite::Stress, Some(figures)) = (suite, &section.remark) {
        print(&format!("           {}", figures.replace('_', "")))?;
    }
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

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    #[derive(Parser)]
    struct Command {
        #[command(flatten)]
        arguments: Arguments,
    }

    #[test]
    fn a_validation_has_the_seed_and_the_references_of_the_command() {
        let of = |words: &[&str]| {
            let command = Command::parse_from([&["validate"][..], words].concat());
            format!("{:?}", validation(&command.arguments, Effort::Quick))
        };
        let given = of(&["--seed", "7", "--references", "a/folder"]);
        assert!(given.contains("seed: 7") && given.contains("references: Some(\"a/folder\")"), "{given}");
        let default = of(&[]);
        assert!(default.contains("seed: 0") && default.contains("references: None"), "{default}");
    }
}
