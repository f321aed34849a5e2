//! Pages quote the figures of `docs/figures.toml`, and their links lead somewhere.
use std::path::{Path, PathBuf};
use std::{collections::BTreeMap, fs};

use super::declared::root;

/// A measured figure that stands on several pages.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Figure {
    value: String,
    command: String,
    date: String,
    pages: Vec<String>,
    /// Values of earlier builds, which no page may have.
    former: Option<Vec<String>>,
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn pages() -> Vec<(PathBuf, String)> {
    let docs = fs::read_dir(root().join("docs")).expect("the pages").map(|entry| entry.expect("a page").path());
    let mut paths: Vec<PathBuf> = docs.filter(|path| path.extension().is_some_and(|extension| extension == "md")).collect();
    paths.extend(["README.md", "CONTRIBUTING.md"].map(|name| root().join(name)));
    paths.into_iter().map(|path| (path.clone(), read(&path))).collect()
}

/// Whether a text contains a value that is no part of a longer number or word.
fn quotes(text: &str, value: &str) -> bool {
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let is_whole = |at: usize| {
        let continues = text[at + value.len()..].starts_with(char::is_alphanumeric);
        !continues && !text[..at].ends_with(|c: char| c.is_alphanumeric() || c == '.')
    };
    text.match_indices(value).any(|(at, _)| is_whole(at))
}

#[test]
fn pages_quote_the_figures_of_today() {
    let figures: BTreeMap<String, Figure> = toml::from_str(&read(&root().join("docs/figures.toml"))).expect("figures");
    let mut wrong = Vec::new();
    for (name, figure) in &figures {
        assert!(!figure.command.is_empty() && figure.date.len() == "2026-11-29".len(), "{name} has no command or date");
        let lacking = figure.pages.iter().filter(|page| !quotes(&read(&root().join(page)), &figure.value));
        wrong.extend(lacking.map(|page| format!("{page} lacks {name}: {}", figure.value)));
        for (page, text) in pages() {
            let old = figure.former.iter().flatten().filter(|value| quotes(&text, value));
            wrong.extend(old.map(|value| format!("{} has {value}: a former {name}", page.display())));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn has_anchor(page: &str, anchor: &str) -> bool {
    let slug = |heading: &str| -> String {
        let kept = heading.trim().chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
        kept.map(|c| if c == ' ' { '-' } else { c }).collect::<String>().to_lowercase()
    };
    let mut headings = page.lines().filter(|line| line.starts_with('#'));
    page.contains(&format!("id=\"{anchor}\"")) || headings.any(|line| slug(line.trim_start_matches('#')) == anchor)
}

#[test]
fn links_of_pages_lead_somewhere() {
    let leads = |page: &Path, link: &str| {
        let (path, anchor) = link.split_once('#').unwrap_or((link, ""));
        let target = if path.is_empty() { page.to_owned() } else { page.with_file_name(path) };
        target.exists() && (anchor.is_empty() || has_anchor(&read(&target), anchor))
    };
    let mut broken = Vec::new();
    for (page, text) in pages() {
        let links = text.split("](").skip(1).filter_map(|rest| Some(rest.split_once(')')?.0));
        let local = links.filter(|link| !link.contains("://") && !leads(&page, link));
        broken.extend(local.map(|link| format!("{}: {link}", page.display())));
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}
