//! The image of the crates in the documentation is what cargo says.
use std::{collections::BTreeMap, path::Path, process::Command};

const PAGE: &str = "docs/architecture.md";
/// The page has the image between these lines.
const FENCES: [&str; 2] = ["<!-- crates -->\n", "<!-- end of crates -->\n"];

/// The crates of the workspace: what each is for, and those that it uses.
type Crates = BTreeMap<String, (String, Vec<String>)>;

fn crates() -> Crates {
    let arguments = ["metadata", "--format-version", "1", "--no-deps", "--offline"];
    let output =
        Command::new(env!("CARGO")).args(arguments).current_dir(env!("CARGO_MANIFEST_DIR")).output().expect("cargo runs");
    let found: serde_json::Value = serde_json::from_slice(&output.stdout).expect("it prints JSON");
    let text = |value: &serde_json::Value| value.as_str().expect("text").to_owned();
    let items = |value: &serde_json::Value| value.as_array().expect("a list").clone();
    let packages = items(&found["packages"]).into_iter().map(|package| {
        let normal = items(&package["dependencies"]).into_iter().filter(|dependency| dependency["kind"].is_null());
        let ours = normal.map(|dependency| text(&dependency["name"])).filter(|name| name.starts_with("noisefall"));
        (text(&package["name"]), (text(&package["description"]), ours.collect()))
    });
    packages.collect()
}

/// The longest way down from a crate.
fn height(crates: &Crates, name: &str) -> usize {
    crates[name].1.iter().map(|used| height(crates, used) + 1).max().unwrap_or(0)
}

fn reaches(crates: &Crates, from: &str, to: &str) -> bool {
    from == to || crates[from].1.iter().any(|used| reaches(crates, used, to))
}

/// One line for each crate, from the top down; what a crate uses by way of another one is left out.
fn picture(crates: &Crates) -> String {
    let mut names: Vec<&String> = crates.keys().collect();
    names.sort_by_key(|name| std::cmp::Reverse(height(crates, name)));
    let top = height(crates, names[0]);
    let line = |name: &&String| {
        let (description, used) = &crates[*name];
        let by_way = |to: &String| used.iter().any(|used| used != to && reaches(crates, used, to));
        let direct: Vec<&str> = used.iter().filter(|to| !by_way(to)).map(|to| to.trim_start_matches("noisefall-")).collect();
        let indented = format!("{:1$}{2}", "", 3 * (top - height(crates, name)), name.trim_start_matches("noisefall-"));
        let uses = if direct.is_empty() { String::new() } else { format!(" → {}", direct.join(", ")) };
        format!("    {:<42}{description}\n", indented + &uses)
    };
    names.iter().map(line).collect()
}

#[test]
fn the_picture_in_the_documentation_is_up_to_date() {
    let page = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(PAGE)).expect("the page is there");
    let shown =
        page.split_once(FENCES[0]).and_then(|(_, rest)| rest.split_once(FENCES[1])).map(|(shown, _)| shown.trim_matches('\n'));
    let picture = picture(&crates());
    assert_eq!(shown, Some(picture.trim_matches('\n')), "{PAGE} is out of date; between the fences belongs:\n\n{picture}");
}

#[test]
fn ways_by_others_are_left_out() {
    let uses = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    let crates = Crates::from([
        ("noisefall".to_owned(), ("top".to_owned(), uses(&["noisefall-a", "noisefall-b"]))),
        ("noisefall-a".to_owned(), ("middle".to_owned(), uses(&["noisefall-b"]))),
        ("noisefall-b".to_owned(), ("ground".to_owned(), Vec::new())),
    ]);
    let lines: Vec<String> = picture(&crates).lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
    assert_eq!(lines, ["noisefall → a top", "a → b middle", "b ground"]);
}
