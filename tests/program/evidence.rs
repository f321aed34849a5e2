//! `noisefall evidence`: the chapter has the right numbers and all files.
use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
};

use super::command_line::{Shell, scene, text};

/// The headings and rows of all tables in a folder, by name.
fn tables(shell: &Shell, names: &BTreeSet<String>) -> BTreeMap<String, Vec<Vec<String>>> {
    let read = |name: &str| {
        let path = shell.path("out").join(format!("{name}.csv"));
        let mut reader = csv::ReaderBuilder::new().has_headers(false).from_path(path).expect("a table");
        reader.records().map(|row| row.expect("a line").iter().map(str::to_owned).collect()).collect()
    };
    names.iter().map(|name| (name.clone(), read(name))).collect()
}

/// Checks that every table and plot exists in both formats and on the page. Returns the names of the tables.
fn check_files(shell: &Shell, stdout: &str) -> BTreeSet<String> {
    let names: BTreeSet<String> = fs::read_dir(shell.path("out"))
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        // The lock of the study.
        .filter(|name| !name.starts_with('.'))
        .collect();
    let with = |extension: &str| -> BTreeSet<&str> { names.iter().filter_map(|name| name.strip_suffix(extension)).collect() };
    let tables: BTreeSet<&str> = with(".csv").into_iter().filter(|name| *name != "study").collect();
    assert_eq!(tables, with(".tex"));
    assert!(with(".svg").len() >= 7 && with(".svg") == with(".png"), "{names:?}");
    assert!(tables.contains("equal_time_estimator") && with(".png").contains("pictures_by_cap"), "{names:?}");
    // All files except the page and the measurements.
    let count = format!("out: {} files of figures and tables", names.len() - 2);
    assert!(stdout.contains(&count), "{count}: {stdout} {names:?}");
    let page = fs::read_to_string(shell.path("out/report.html")).expect("a page");
    // The two sheets of images are on the page as they are.
    assert_eq!((page.matches("<table").count(), page.matches("<svg").count()), (tables.len(), with(".svg").len() - 2));
    assert_eq!(page.matches("<img").count(), 2);
    for outside in ["http://", "https://", "<script", "<link"] {
        assert!(!page.replace("http://www.w3.org/2000/svg", "").contains(outside), "{outside}");
    }
    tables.into_iter().map(str::to_owned).collect()
}

#[test]
fn the_chapter_of_the_furnace_agrees_with_the_exact_biases() {
    let shell = Shell::new();
    let run = |more: &[&str]| {
        shell.run(&[&["evidence", &scene("furnace"), "-o", "out", "--time", "3", "--size", "16x16"], more].concat())
    };
    let done = run(&[]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let read = |name: &str| fs::read_to_string(shell.path("out").join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    // Every cell except the first of a row and the remark is a number.
    let tables = tables(&shell, &check_files(&shell, &text(&done.stdout)));
    for (name, rows) in &tables {
        let numbers = rows[1..].iter().flat_map(|row| &row[1..row.len() - 1]);
        for cell in numbers.filter(|cell| !cell.is_empty()) {
            assert!(cell.parse::<f64>().is_ok(), "{name}: {cell}");
        }
    }
    assert!(read("error_by_sampler_time.svg").contains("rendering time"));
    assert!(read("error_by_sampler_samples.svg").contains("samples per pixel"));
    // L_e/(1 − ρ) = 2, from which a cap of k removes 1/2^k.
    let rows = &tables["bias_of_caps"];
    assert_eq!(rows[0], ["bounce cap", "bias", "standard error", "z", "of the mean, %", "excluded beyond, %", "remark"]);
    let exact = [("0", -1.0), ("1", -0.5), ("2", -0.25), ("5", -1.0 / 32.0), ("none", 0.0)];
    for (row, (cap, exact)) in rows[1..].iter().zip(exact) {
        let number = |cell: &String| cell.parse::<f64>().ok();
        // Exact samples have no standard error. Few samples have none either if their tails are heavy, which depends on the time that
        // the machine had for them: the remark says so, and the bias is then known by its size only.
        let has_heavy_tails = row[6].contains("heavy tails");
        let tolerance = number(&row[2]).map_or(if has_heavy_tails { 2.0 * f64::abs(exact) } else { 1e-3 }, |e| 5.0 * e + 1e-3);
        assert!(row[0] == cap && number(&row[1]).is_some_and(|bias| (bias - exact).abs() <= tolerance), "{row:?}");
    }
    assert_eq!(rows.len(), 1 + exact.len());
    // Path reuse is off in all comparisons except its own.
    let csv = read("study.csv");
    let column = |name: &str| csv.lines().next().and_then(|line| line.split(',').position(|column| column == name));
    let [reuse, adaptive] = ["reuse", "adaptive"].map(|name| column(name).expect("a column"));
    let mut lines = csv::Reader::from_reader(csv.as_bytes());
    let settings: BTreeSet<[String; 2]> =
        lines.records().map(|line| [reuse, adaptive].map(|at| line.as_ref().expect("a line")[at].to_owned())).collect();
    assert!(settings.iter().all(|[reuse, adaptive]| reuse != "auto" && adaptive == "off"), "{settings:?}");
    assert!(tables.contains_key("equal_time_path_reuse"));
    assert!(read("bias_of_roulette.tex").contains("\\begin{tabular}{lrrrrrl}"));
    // The corner of the first image with a cap has radiance 1.
    let corner = || {
        let sheet = noisefall_render::render::image_file::read(&shell.path("out/pictures_by_cap.png")).expect("an image");
        sheet.radiance[12 * sheet.width as usize + 12][0]
    };
    assert!((corner() - 1.0).abs() < 2e-3, "{}", corner());
    // Measurements are not repeated, whatever the timing says, but the images get the display settings of the command.
    let csv = read("study.csv");
    let again = run(&["--exposure", "-2"]);
    assert!(again.status.success() && read("study.csv") == csv, "{}", text(&again.stderr));
    assert!((corner() - 0.25).abs() < 2e-3, "{}", corner());
    let none = shell.run(&["evidence", &scene("outside_lit_inside"), "-o", "dark", "--time", "1", "--size", "8x8"]);
    assert!(none.status.code() == Some(1) && text(&none.stderr).contains("entirely black"), "{}", text(&none.stderr));
}
