//! `noisefall validate`: a self-contained report, and an exit status that tells whether all statements hold.
use std::{fs, path::Path};

use crate::{
    command_line::{Shell, text},
    json_schema::fits_part,
};

fn schema() -> serde_json::Value {
    serde_json::from_str(include_str!("../../docs/figures.schema.json")).expect("the schema is JSON")
}

fn references() -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/lab/references").display().to_string()
}

#[test]
fn a_quick_validation_holds_and_writes_a_report_that_needs_nothing_else() {
    let shell = Shell::new();
    let done = shell.run(&["validate", "--quick", "-o", "new/report"]);
    let shown = text(&done.stdout);
    assert!(done.status.success(), "{shown}{}", text(&done.stderr));
    assert!(shown.contains("17  holds") && shown.contains("statements hold") && !shown.contains("not run"), "{shown}");
    let report = fs::read_to_string(shell.path("new/report/report.html")).expect("a report");
    assert_eq!(report.matches("<section").count(), 17);
    assert!(report.matches("<svg").count() >= 12 && report.contains("data:image/png;base64,"));
    for outside in ["http://", "https://", "src=\"/", "<script", "<link"] {
        let elsewhere = report.replace("http://www.w3.org/2000/svg", "");
        assert!(!elsewhere.contains(outside), "{outside}");
    }
    assert!(!report.contains("✗"), "no verdict is red");
    let rows = fs::read_to_string(shell.path("new/report/report.csv")).expect("rows");
    let json: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(shell.path("new/report/report.json")).expect("JSON")).expect("JSON");
    assert!(fits_part(&json, "validation", &schema()), "{json:#}");
    let sections = json["sections"].as_array().expect("sections");
    let statements: usize = sections.iter().map(|section| section["statements"].as_array().map_or(0, Vec::len)).sum();
    assert_eq!((sections.len(), csv::Reader::from_reader(rows.as_bytes()).records().count()), (17, statements));
    assert!(shown.contains(&format!("all {statements} statements hold")), "{shown}");
    let drawn = fs::read_dir(shell.path("new/report/figures")).expect("figures").count();
    assert_eq!(drawn, report.matches("<figure").count() - 1, "all but the table of times");
    a_reference_that_differs_fails_the_validation(&shell);
    // Other random numbers change the statements of section 2, which are all about sample variances.
    let measured = |folder: &str| -> Vec<String> {
        let mut rows = csv::Reader::from_path(shell.path(folder).join("report.csv")).expect("rows");
        let rows = rows.records().map(|row| row.expect("a row")).filter(|row| &row[0] == "2");
        rows.map(|row| row[3].to_owned()).collect()
    };
    let (first, second) = (measured("new/report"), measured("wrong/report"));
    assert!(first.len() == second.len() && first.len() > 5, "{first:?} {second:?}");
    assert!(first.iter().zip(&second).all(|(first, second)| first != second), "{first:?} {second:?}");
}

fn a_reference_that_differs_fails_the_validation(shell: &Shell) {
    fs::create_dir(shell.path("wrong")).expect("a folder");
    for name in ["furnace_enclosure.toml", "furnace_enclosure.txt"] {
        let kept = fs::read_to_string(Path::new(&references()).join(name)).expect("a reference");
        // One block a fifth too bright.
        fs::write(shell.path("wrong").join(name), kept.replacen("\n2 2 2", "\n2.4 2 2", 1)).expect("it can be written");
    }
    let done = shell.run(&["validate", "--quick", "--references", "wrong", "--seed", "1", "-o", "wrong/report"]);
    assert_eq!(done.status.code(), Some(1), "{}", text(&done.stdout));
    assert!(text(&done.stderr).contains("statements fail"), "{}", text(&done.stderr));
    assert!(text(&done.stdout).contains("furnace enclosure: largest |z|"), "{}", text(&done.stdout));
}

#[test]
fn scenes_under_stress_hold_and_are_reported() {
    let shell = Shell::new();
    let done = shell.run(&["validate", "--stress", "--quick", "-o", "report"]);
    let shown = text(&done.stdout);
    assert!(done.status.success(), "{shown}{}", text(&done.stderr));
    assert!(shown.contains(" 9  holds") && shown.contains("scenes, ") && shown.contains("slowest"), "{shown}");
    let report = fs::read_to_string(shell.path("report/report.html")).expect("a report");
    assert_eq!(report.matches("<section").count(), 9);
    assert!(report.matches("<svg").count() >= 5 && !report.contains("✗"));
    let json = fs::read_to_string(shell.path("report/report.json")).expect("rows");
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert!(fits_part(&json, "validation", &schema()), "{json:#}");
    assert!(!shell.path("report/stress").exists(), "nothing fails, nothing is kept");
}

#[test]
fn a_folder_that_cannot_be_created_is_reported_at_once() {
    let shell = Shell::new();
    fs::write(shell.path("file"), "").expect("a file");
    let done = shell.run(&["validate", "-o", "file"]);
    assert_eq!(done.status.code(), Some(1));
    assert!(text(&done.stderr).starts_with("file: this is a file"), "{}", text(&done.stderr));
}

#[test]
fn requested_references_must_exist() {
    let done = Shell::new().run(&["validate", "--quick", "--references", "nowhere"]);
    assert_eq!(done.status.code(), Some(1));
    assert!(text(&done.stderr).starts_with("nowhere: no references"), "{}", text(&done.stderr));
}
