//! `noisefall evidence`: a chapter whose numbers are right, and whose files are all there.
use std::{collections::BTreeSet, fs};

use super::command_line::{Shell, scene, text};

/// The rows of a table without its head.
fn cells(csv: &str) -> Vec<Vec<String>> {
    csv.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

/// Bias and the largest one that is left are percentages of a mean of 2, within what the digits of the numbers leave open.
fn assert_parts_of_2(row: &[String], bias: f64, error: f64) {
    let parts = [&row[2], &row[3]].map(|part| part.strip_suffix(" %").and_then(|part| part.parse::<f64>().ok()));
    let open = |part: f64| 10.0 * error + 0.01 * part.abs() + 1e-3;
    for (part, exact) in parts.into_iter().zip([50.0 * bias, 50.0 * (bias.abs() + 1.96 * error)]) {
        assert!(part.is_some_and(|part| (part - exact).abs() <= open(part)), "{row:?}");
    }
}

/// Samples and seconds, and an efficiency within an interval that is the same factor wide on both sides.
fn assert_interval(row: &[String]) {
    assert!(row[1].parse::<u32>().is_ok_and(u32::is_power_of_two) && row[2].parse::<f64>().is_ok(), "{row:?}");
    let ratio = row[4].parse::<f64>().expect("an efficiency");
    let (low, high) = row[5].split_once(" to ").expect("an interval");
    let [low, high] = [low, high].map(|end| end.parse::<f64>().expect("a number"));
    assert!(low <= ratio && ratio <= high && (low * high / (ratio * ratio) - 1.0).abs() < 0.03, "{row:?}");
}

#[test]
fn the_chapter_of_the_furnace_finds_what_is_known_of_it() {
    let shell = Shell::new();
    let run = |more: &[&str]| {
        shell.run(&[&["evidence", &scene("furnace"), "-o", "out", "--time", "3", "--size", "16x16"], more].concat())
    };
    let done = run(&[]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let read = |name: &str| fs::read_to_string(shell.path("out").join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    // Every table in both forms, every figure too, and all of them on the page.
    let names: BTreeSet<String> = fs::read_dir(shell.path("out"))
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    let with = |extension: &str| -> BTreeSet<&str> { names.iter().filter_map(|name| name.strip_suffix(extension)).collect() };
    let tables: BTreeSet<&str> = with(".csv").into_iter().filter(|name| *name != "study").collect();
    assert_eq!(tables, with(".tex"));
    assert!(with(".svg").len() >= 5 && with(".svg").is_subset(&with(".png")), "{names:?}");
    assert!(tables.contains("equal_time_estimator") && with(".png").contains("pictures_by_cap"), "{names:?}");
    let page = read("report.html");
    assert_eq!((page.matches("<table").count(), page.matches("<svg").count()), (tables.len(), with(".svg").len()));
    assert_eq!(page.matches("<img").count(), 2);
    for outside in ["http://", "https://", "<script", "<link"] {
        assert!(!page.replace("http://www.w3.org/2000/svg", "").contains(outside), "{outside}");
    }
    assert!(read("error_by_sampler_time.svg").contains("rendering time, s"));
    assert!(read("error_by_sampler_samples.svg").contains("samples a pixel"));
    // L_e/(1 − ρ) = 2, of which a cap of k leaves out 1/2^k.
    let rows = cells(&read("bias_of_caps.csv"));
    for (row, (cap, exact)) in rows.iter().zip([("0", -1.0), ("1", -0.5), ("2", -0.25), ("5", -1.0 / 32.0), ("none", 0.0)]) {
        let (bias, error) = row[1].split_once(" ± ").unwrap_or((&row[1], "1e-6"));
        let [bias, error] = [bias, error].map(|number| number.parse::<f64>().unwrap_or(f64::NAN));
        assert!(row[0] == cap && (bias - exact).abs() <= 5.0 * error + 1e-3, "{row:?}");
        assert_parts_of_2(row, bias, error);
    }
    assert_eq!(rows.len(), 5);
    assert!(read("bias_of_roulette.tex").contains("\\begin{tabular}{lrrr}"));
    cells(&read("equal_time_sampler.csv")).iter().for_each(|row| assert_interval(row));
    // The corner of the picture without reflections shows radiance 1: as white, and two stops darker.
    let corner = || {
        let sheet = noisefall::render::image_file::read(&shell.path("out/pictures_by_cap.png")).expect("a picture");
        sheet.radiance[12 * sheet.width as usize + 12][0]
    };
    assert!((corner() - 1.0).abs() < 2e-3, "{}", corner());
    // What is there already is not measured again.
    let csv = read("study.csv");
    let again = run(&["--exposure", "-2"]);
    assert!(again.status.success() && read("study.csv").starts_with(&csv), "{}", text(&again.stderr));
    assert!((corner() - 0.25).abs() < 2e-3, "{}", corner());
    let none = shell.run(&["evidence", &scene("outside_lit_inside"), "-o", "dark", "--time", "1", "--size", "8x8"]);
    assert!(none.status.code() == Some(1) && text(&none.stderr).contains("entirely black"), "{}", text(&none.stderr));
}
