//! `noisefall study`: a table of measurements and a report, which survive an interruption.
use std::{collections::BTreeSet, fs, process::Stdio};

use crate::command_line::{Shell, scene, text};

/// Eight combinations, some of which give the same image.
const SMALL: [&str; 14] = [
    "--estimators",
    "path,mis",
    "--directions",
    "uniform,cosine",
    "--samplers",
    "independent",
    "--roulette",
    "off,0.8",
    "--spp",
    "11",
    "--size",
    "16x16",
    "--seconds",
    "1000",
];

fn study(shell: &Shell, arguments: &[&str]) -> std::process::Output {
    shell.run(&[&["study", "-o", "new/study"], &SMALL[..], arguments].concat())
}

#[test]
fn a_study_writes_measurements_and_a_report_that_needs_nothing_else() {
    let shell = Shell::new();
    let done = study(&shell, &[&scene("furnace"), &scene("bright_sky"), "--max-bounces", "none,1"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let shown = text(&done.stdout);
    assert!(shown.contains(" – ") && shown.contains("report: new/study/report.html"), "{shown}");

    let csv = fs::read_to_string(shell.path("new/study/study.csv")).expect("measurements");
    assert!(csv.starts_with("scene,width,height,estimator,"), "{csv}");
    // 1, 2, 4, 8 and 11 samples, twice each.
    assert!(csv.lines().count() > 1 && (csv.lines().count() - 1).is_multiple_of(5 * 2), "{csv}");
    let mut table = csv::Reader::from_reader(csv.as_bytes());
    let header = table.headers().expect("names").clone();
    let numbers = ["repeat", "seed"].map(|name| header.iter().position(|column| column == name).expect("a column"));
    let of_repeats: BTreeSet<[String; 2]> =
        table.records().map(|row| numbers.map(|at| row.as_ref().expect("a line")[at].to_owned())).collect();
    assert_eq!(of_repeats, [["1", "0"], ["2", "1"]].map(|pair| pair.map(str::to_owned)).into());
    assert!(csv.contains(",cap at 1,") && csv.contains(",the exact radiance,") && csv.contains("a converged render"), "{csv}");

    let report = fs::read_to_string(shell.path("new/study/report.html")).expect("a report");
    assert_eq!(report.matches("<section").count(), 2);
    assert!(
        report.matches("<svg").count() >= 8
            && report.contains("biased: cap at 1")
            && report.contains("which itself has an estimated error")
    );
    for outside in ["http://", "https://", "src=", "<script", "<link"] {
        assert!(!report.replace("http://www.w3.org/2000/svg", "").contains(outside), "{outside}");
    }
}

#[test]
fn the_same_study_again_measures_nothing_and_another_one_is_kept_beside_it() {
    let shell = Shell::new();
    assert!(study(&shell, &[&scene("bright_sky")]).status.success());
    let csv = || fs::read_to_string(shell.path("new/study/study.csv")).expect("measurements");
    let (first, runs) = (csv(), (csv().lines().count() - 1) / 5);

    let again = study(&shell, &[&scene("bright_sky")]);
    assert!(text(&again.stderr).contains(&format!("{runs} of {runs} runs are already measured")), "{}", text(&again.stderr));
    assert_eq!(csv(), first);

    let larger = study(&shell, &[&scene("bright_sky"), "--threads", "3"]);
    assert!(larger.status.success() && !text(&larger.stderr).contains("already measured"), "{}", text(&larger.stderr));
    assert!(csv().starts_with(&first) && csv().len() > first.len());
}

#[test]
fn a_study_that_was_cut_off_goes_on_where_it_was() {
    let shell = Shell::new();
    assert!(study(&shell, &[&scene("furnace")]).status.success());
    let path = shell.path("new/study/study.csv");
    let whole = fs::read_to_string(&path).expect("measurements");
    let (lines, runs) = (whole.lines().count(), (whole.lines().count() - 1) / 5);
    // Truncates the file by the last three lines of the last run and half of the line before.
    let cut = whole.lines().take(lines - 3).map(str::len).sum::<usize>() + lines - 3 - 20;
    fs::write(&path, &whole[..cut]).expect("it can be written");
    let again = study(&shell, &[&scene("furnace")]);
    let told = text(&again.stderr);
    assert!(again.status.success() && told.contains("warning: 2 lines of study.csv belong to incomplete runs"), "{told}");
    assert!(told.contains(&format!("{} of {runs} runs are already measured", runs - 1)), "{told}");
    assert_eq!(fs::read_to_string(&path).expect("measurements").lines().count(), lines);
}

#[test]
fn two_studies_in_one_folder_at_once_lose_no_line() {
    let shell = Shell::new();
    let start = |scenes: &[&str]| {
        let arguments = [&["study", "-o", "out"], &SMALL[..], scenes].concat();
        shell.command(&arguments).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("the program starts")
    };
    let [furnace, sky] = ["furnace", "bright_sky"].map(scene);
    let both = [start(&[&furnace, &sky]), start(&[&sky, &furnace])];
    for study in both {
        let done = study.wait_with_output().expect("it ends");
        assert!(done.status.success(), "{}", text(&done.stderr));
    }
    let again = shell.run(&[&["study", "-o", "out"], &SMALL[..], &[&furnace, &sky]].concat());
    let told = text(&again.stderr);
    let [found, runs] = [0, 2].map(|word| told.split(' ').nth(word).unwrap_or_default().to_owned());
    assert!(again.status.success() && found == runs && told.contains("are already measured"), "{told}");
    assert!(!told.contains("incomplete"), "{told}");
}

#[test]
fn path_reuse_and_adaptive_samples_are_listed_and_scenes_of_one_title_told_apart() {
    let shell = Shell::new();
    fs::copy(scene("cornell_box"), shell.path("other.toml")).expect("a scene");
    let few =
        ["--estimators", "mis", "--directions", "bsdf", "--samplers", "independent", "--roulette", "throughput", "--spp", "4"];
    let lists = ["--reuse", "suffixes,off", "--adaptive", "on,off", "--size", "16x16", "--seconds", "1000", "--repeats", "1"];
    let shipped = scene("cornell_box");
    let done = shell.run(&[&["study", "other.toml", &shipped, "-o", "out"], &few[..], &lists].concat());
    assert!(done.status.success(), "{}", text(&done.stderr));
    // Without a terminal, the progress of the reference is printed in quarters.
    assert!(text(&done.stderr).matches(" % of the reference, ").count() >= 8, "{}", text(&done.stderr));
    assert_eq!(text(&done.stderr).matches(": 100 % of the reference, 0 s left").count(), 2, "{}", text(&done.stderr));
    let mut table = csv::Reader::from_path(shell.path("out/study.csv")).expect("measurements");
    let header = table.headers().expect("names").clone();
    let column = |name: &str| header.iter().position(|column| column == name).expect("a column");
    let columns = ["reuse", "path_reuse", "adaptive", "spp", "bias_standard_error"].map(column);
    let rows: Vec<[String; 5]> =
        table.records().map(|row| columns.map(|at| row.as_ref().expect("a line")[at].to_owned())).collect();
    for (reuse, in_force) in [("suffixes", "suffixes"), ("off", "off")] {
        for adaptive in ["on", "off"] {
            assert!(rows.iter().any(|row| row[..3] == [reuse, in_force, adaptive]), "{reuse} {adaptive}: {rows:?}");
        }
    }
    // The standard error is known from the second sample on, and falls.
    let even = || rows.iter().filter(|row| row[2] == "off");
    assert!(even().all(|row| (row[3] == "1") == row[4].is_empty()), "{rows:?}");
    let report = fs::read_to_string(shell.path("out/report.html")).expect("a report");
    assert!(report.contains("(other.toml)</h2>") && report.contains("cornell_box.toml)</h2>"), "{report}");
    assert!(
        report.contains("<th>path reuse</th>")
            && report.contains("<th>adaptive</th>")
            && report.contains("path reuse suffixes, adaptive on")
    );
}

#[test]
fn references_are_files_where_there_are_some() {
    let shell = Shell::new();
    fs::copy(scene("bright_sky"), shell.path("sky.toml")).expect("a scene");
    let render = ["render", "sky.toml", "-o", "sky.ref.exr", "--spp", "64", "--size", "20x10"];
    assert!(shell.run(&render).status.success());
    let few = ["--estimators", "mis", "--directions", "bsdf", "--samplers", "sobol", "--roulette", "off", "--spp", "4"];
    let study = |arguments: &[&str]| shell.run(&[&["study", "sky.toml", "-o", "out"], &few[..], arguments].concat());
    let done = study(&[]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let csv = fs::read_to_string(shell.path("out/study.csv")).expect("measurements");
    assert!(csv.contains("sky.toml,20,10,") && csv.contains("the reference sky.ref.exr"), "{csv}");
    // It was rendered by this program, so its file has variances.
    let own = |folder: &str| {
        let mut table = csv::Reader::from_path(shell.path(folder).join("study.csv")).expect("measurements");
        let column = table.headers().expect("names").iter().position(|name| name == "reference_rel_mse").expect("a column");
        let row = table.records().next().expect("a line").expect("a line");
        row[column].parse::<f64>().expect("a number")
    };
    let known = own("out");
    // 3.3 % at 64 samples on an image of 64 × 36 pixels.
    assert!((1e-5..1e-2).contains(&known), "{known}");
    assert!(!text(&done.stdout).contains("assumed to be 0"), "{}", text(&done.stdout));
    let report = |folder: &str| fs::read_to_string(shell.path(folder).join("report.html")).expect("a report");
    assert!(report("out").contains("sky.ref.exr, which itself has an estimated error of"));
    // A file of another program, or of an older version of this one.
    let picture = noisefall_render::render::image_file::read(&shell.path("sky.ref.exr")).expect("an image");
    let frame = noisefall_render::render::Frame { width: 20, height: 10, radiance: picture.radiance, ..Default::default() };
    noisefall_render::render::image_file::save(&frame, Default::default(), "{}", &shell.path("foreign.exr"))
        .expect("it is saved");
    let foreign =
        shell.run(&[&["study", "sky.toml", "-o", "foreign", "--reference", "foreign.exr", "--floor", "0.5"], &few[..]].concat());
    let told = text(&foreign.stdout);
    assert!(told.contains("The error of the reference foreign.exr itself is unknown and assumed to be 0."), "{told}");
    assert!(report("foreign").contains("whose own error is unknown and assumed to be 0") && own("foreign") == 0.0);
    let csv = fs::read_to_string(shell.path("foreign/study.csv")).expect("measurements");
    assert!(csv.contains(",0.5,") && report("foreign").contains("(x − r)²/(r² + 0.5)"), "{csv}");
    // The reference of a scene does not make the error of a file known.
    let declared = ["study", &scene("furnace"), "-o", "declared", "--reference", "foreign.exr", "--max-bounces", "1"];
    let told = text(&shell.run(&[&declared[..], &few[..]].concat()).stdout);
    assert!(told.contains("The error of the reference foreign.exr itself is unknown and assumed to be 0."), "{told}");
    fs::copy(shell.path("sky.ref.exr"), shell.path("other.exr")).expect("an image");
    let other = study(&["--reference", "other.exr", "--size", "16x16"]);
    assert_eq!(other.status.code(), Some(1));
    let told = text(&other.stderr);
    assert!(told.contains("the reference other.exr is 20 × 10 and the study 16 × 16: leave --size out"), "{told}");
}

#[test]
fn a_scene_that_cannot_be_studied_is_reported_at_once() {
    let shell = Shell::new();
    let furnace = scene("furnace");
    let dark = "format = 1\ncamera = { eye = [0.0, 0.0, 4.0], look_at = [0.0, 0.0, 0.0], fov = 40.0, resolution = [8, 8] }\n";
    fs::write(shell.path("dark.toml"), dark).expect("a scene");
    fs::write(shell.path("file"), "").expect("a file");
    fs::create_dir(shell.path("taken")).expect("a folder");
    fs::write(shell.path("taken/study.csv"), "a,b\n1,2\n").expect("a file");
    let fails = |arguments: &[&str], code: i32, message: &str| {
        let output = shell.run(&[&["study"], arguments].concat());
        assert_eq!(output.status.code(), Some(code), "{arguments:?}");
        assert!(text(&output.stderr).contains(message), "{arguments:?}: {}", text(&output.stderr));
        assert!(!text(&output.stderr).contains("panicked"));
    };
    fails(&["nowhere.toml", "-o", "out"], 1, "there is no such file");
    fails(&["dark.toml", "-o", "out"], 1, "nothing in this scene emits light");
    fails(&[&scene("inside_lit_outside"), "-o", "out"], 1, "is entirely black");
    fails(&[&furnace, "-o", "file"], 1, "file: this is a file; -o needs a folder");
    fails(&[&furnace, "-o", "taken"], 1, "was not written by `noisefall study`");
    fails(&[&furnace, "-o", "out", "--reference", "nowhere.exr"], 1, "there is no such file");
    fails(&[&furnace, "-o", "out", "--size", "0x5"], 1, "resolution");
    fails(&[&furnace, &furnace, "-o", "out", "--reference", "a.exr"], 2, "--reference is the image of one scene");
    fails(&[&furnace, "-o", "out", "--samplers", "sobol,foo"], 2, "independent, stratified, sobol");
    fails(&[&furnace, "-o", "out", "--roulette", "off,2"], 2, "survival probability");
    fails(&[&furnace, "-o", "out", "--max-bounces", "some"], 2, "`none`");
    fails(&[&furnace], 2, "--output");
    fails(&["-o", "out"], 2, "SCENE");
    fails(&[&furnace, "-o", "out", "--samplers", "sobol,,independent"], 2, "independent, stratified, sobol");
}

#[test]
fn without_lists_the_usual_ones_are_combined() {
    let shell = Shell::new();
    let done = shell.run(&["study", &scene("furnace"), "-o", "out", "--spp", "1", "--repeats", "1", "--size", "8x8"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let report = fs::read_to_string(shell.path("out/report.html")).expect("a report");
    let worth = report.split("Gain from each setting").nth(1).and_then(|rest| rest.split("</table>").next());
    let worth = worth.expect("a table of values");
    let values: BTreeSet<&str> = worth.split("<td>").skip(1).filter_map(|cell| cell.split('<').next()).collect();
    let usual = "path light mis uniform cosine bsdf independent stratified sobol off 0.8 throughput";
    assert_eq!(values, usual.split(' ').collect(), "{worth}");
}

#[test]
fn lists_may_have_spaces_and_quotes() {
    let shell = Shell::new();
    let lists = [
        ["--estimators", "path, 'mis'"],
        ["--directions", " \"uniform\" ,cosine "],
        ["--samplers", "independent, sobol"],
        ["--roulette", "off, 0.8"],
        ["--max-bounces", "none, 3"],
    ];
    let size = ["study", &scene("furnace"), "-o", "out", "--spp", "1", "--repeats", "1", "--size", "8x8"];
    let done = shell.run(&[&size[..], &lists.concat()].concat());
    assert!(done.status.success(), "{}", text(&done.stderr));
    let csv = fs::read_to_string(shell.path("out/study.csv")).expect("measurements");
    for both in
        [[",path,", ",mis,"], [",uniform,", ",cosine,"], [",independent,", ",sobol,"], [",off,", ",0.8,"], [",none,", ",3,"]]
    {
        assert!(both.iter().all(|value| csv.contains(value)), "{both:?}: {csv}");
    }
}
