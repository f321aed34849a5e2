//! A program that is installed alone has its scenes, manual pages and completions.
use std::{collections::BTreeSet, fs};

use super::{
    command_line::{Shell, json, text},
    scene_files::shipped_scenes,
};

fn printed(shell: &Shell, arguments: &[&str]) -> String {
    let done = shell.run(arguments);
    assert!(done.status.success(), "{arguments:?}: {}", text(&done.stderr));
    text(&done.stdout)
}

/// The commands that the program lists.
fn commands(shell: &Shell) -> Vec<String> {
    let help = printed(shell, &["--help"]);
    let list = help.split("Commands:").nth(1).and_then(|rest| rest.split("\n\n").next()).expect("a list").to_owned();
    let names = list.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    names.filter_map(|line| line.split_whitespace().next()).map(str::to_owned).filter(|name| name != "help").collect()
}

#[test]
fn scenes_can_be_named_where_there_is_no_file() {
    let shell = Shell::new();
    let list = printed(&shell, &["scenes"]);
    let names: Vec<&str> = list.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert_eq!(names.len(), shipped_scenes().len());
    assert!(list.contains("cornell_box          Cornell box\n"), "{list}");
    let options = ["-o", "a.exr", "--spp", "1", "--size", "8x8", "--json"];
    // One names an image, one does not.
    for name in ["sky_lit", "cornell_box"] {
        let line = json(&shell.run(&[&["render", name], &options[..]].concat()));
        assert_eq!((&line["scene"], &line["spp"]), (&name.into(), &1.into()));
        // The rendered image carries the scene, but not the files that it names.
        printed(&shell, &["check", "a.exr"]);
    }
    let wrong = shell.run(&[&["render", "cornel_box"], &options[..]].concat());
    assert!(text(&wrong.stderr).contains("`noisefall scenes` lists"), "{}", text(&wrong.stderr));
    let wrong = shell.run(&["scenes", "cornel_box"]);
    assert!(text(&wrong.stderr).contains("did you mean `cornell_box`?"), "{}", text(&wrong.stderr));
}

#[test]
fn scenes_are_written_with_the_images_that_they_name() {
    let shell = Shell::new();
    printed(&shell, &["scenes", "-o", "some", "sky_lit", "furnace"]);
    let found = |folder: &str| -> BTreeSet<String> {
        let entries = fs::read_dir(shell.path(folder)).expect("a folder");
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect()
    };
    assert_eq!(found("some"), ["assets", "furnace.toml", "sky_lit.toml"].map(str::to_owned).into());
    assert_eq!(found("some/assets"), ["sky.exr".to_owned()].into());
    printed(&shell, &["check", "some/sky_lit.toml"]);
    printed(&shell, &["scenes", "-o", "all"]);
    for file in shipped_scenes() {
        let written = shell.path("all").join(file.file_name().expect("a name"));
        assert_eq!(fs::read(&file).expect("it is there"), fs::read(written).expect("it is written"), "{}", file.display());
    }
}

#[test]
fn every_command_has_a_manual_page_with_its_options() {
    let shell = Shell::new();
    printed(&shell, &["man", "-o", "pages/man1"]);
    let commands = commands(&shell);
    assert!(commands.len() >= 12 && commands.contains(&"render".to_owned()), "{commands:?}");
    for command in &commands {
        let page = fs::read_to_string(shell.path(&format!("pages/man1/noisefall-{command}.1"))).expect(command);
        assert!(page.contains(&format!(".TH noisefall-{command} 1 \"\" \"Noisefall ")), "{page}");
        let options = printed(&shell, &[command, "--help"]);
        let options = options.split_whitespace().filter(|word| word.starts_with("--") && word.len() > 2);
        for option in options.map(|word| word.trim_matches(|c: char| !c.is_alphanumeric() && c != '-')) {
            assert!(page.contains(&option.replace('-', "\\-")), "{command}: {option}");
        }
    }
    assert!(shell.path("pages/man1/noisefall.1").is_file());
    assert_eq!(fs::read_dir(shell.path("pages/man1")).expect("a folder").count(), commands.len() + 1);
}

#[test]
fn completions_know_every_command() {
    let shell = Shell::new();
    for name in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = printed(&shell, &["completions", name]);
        for command in commands(&shell) {
            assert!(script.contains(&command), "{name} does not know {command}");
        }
        assert!(script.contains("white-balance"), "{name}");
    }
}
