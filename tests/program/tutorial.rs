//! The numbers of docs/tutorial.md are those that its commands print: its scenes are written to a folder, its commands run there in
//! order, and every line of output on the page is found in their output.
use std::fs;

use super::command_line::{Shell, text};

const PAGE: &str = include_str!("../../docs/tutorial.md");

/// The fenced blocks in a language, each with the part of the page before it.
fn blocks(language: &str) -> Vec<(&'static str, &'static str)> {
    let fence = format!("```{language}\n");
    let block = |(at, _)| {
        let (inside, _) = PAGE[at + fence.len()..].split_once("\n```").expect("the block ends");
        (&PAGE[..at], inside)
    };
    PAGE.match_indices(&fence).map(block).collect()
}

/// The last file name of a scene in backquotes.
fn scene_name(before: &str) -> &str {
    let is_name = |part: &&str| part.ends_with(".toml") && !part.contains(char::is_whitespace);
    before.rsplit('`').find(is_name).expect("a name stands before the scene")
}

/// A command of the page, and the lines of its output that the page shows.
struct Example {
    arguments: Vec<String>,
    shown: Vec<String>,
}

/// The commands of a block, in order. A command continues after a backslash.
fn examples(block: &str) -> Vec<Example> {
    let joined = block.replace("\\\n", " ");
    assert!(joined.starts_with("$ noisefall "), "a block begins with a command: {joined}");
    let example = |part: &str| {
        let (command, output) = part.split_once('\n').unwrap_or((part, ""));
        Example {
            arguments: command.split_whitespace().map(str::to_owned).collect(),
            shown: output.lines().map(str::to_owned).collect(),
        }
    };
    joined.split("$ noisefall ").skip(1).map(example).collect()
}

/// Whether a printed line is a line of the page, in which `…` stands for any text.
fn agrees(printed: &str, shown: &str) -> bool {
    let parts: Vec<&str> = shown.split('…').map(str::trim).collect();
    let (first, last) = (parts[0], parts[parts.len() - 1]);
    let printed = printed.trim();
    let mut rest = Some(printed);
    for part in &parts {
        rest = rest.and_then(|rest| rest.split_once(part)).map(|(_, after)| after);
    }
    let is_whole = parts.len() > 1 || printed == first;
    rest.is_some() && is_whole && printed.starts_with(first) && printed.ends_with(last)
}

/// Runs a command of the page. Returns the lines of the page that it does not print.
fn missing(shell: &Shell, example: &Example) -> Vec<String> {
    let arguments: Vec<&str> = example.arguments.iter().map(String::as_str).collect();
    let output = shell.run(&arguments);
    let printed = text(&output.stdout) + &text(&output.stderr);
    assert!(output.status.success(), "noisefall {}: {printed}", arguments.join(" "));
    let is_missing = |shown: &&String| !printed.lines().any(|line| agrees(line, shown));
    let lines = example.shown.iter().filter(|shown| shown.trim() != "…").filter(is_missing);
    lines.map(|line| format!("noisefall {}: `{line}` is not in\n{printed}", arguments.join(" "))).collect()
}

#[test]
fn commands_of_the_tutorial_print_the_lines_that_it_shows() {
    let shell = Shell::new();
    for (before, scene) in blocks("toml") {
        fs::write(shell.path(scene_name(before)), scene).expect("it is written");
    }
    let examples: Vec<Example> = blocks("console").into_iter().flat_map(|(_, block)| examples(block)).collect();
    assert!(examples.len() > 20, "{} commands", examples.len());
    let missing: Vec<String> = examples.iter().flat_map(|example| missing(&shell, example)).collect();
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

#[test]
fn a_line_agrees_up_to_ellipses() {
    let printed = "a.exr: 16 spp in 0.02 s, error 5.39 %, unbiased";
    for shown in [printed, "a.exr: 16 spp in …, error 5.39 %, unbiased", "a.exr: …, error 5.39 %, …"] {
        assert!(agrees(printed, shown), "{shown}");
    }
    for shown in ["a.exr: 16 spp", "…, error 5.3 %, …", "error 5.39 %, …", "… 5.39 % … 16 spp …", "a.exr: …, error 5.39 %"]
    {
        assert!(!agrees(printed, shown), "{shown}");
    }
}
