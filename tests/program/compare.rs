//! `noisefall compare`: error, bias with its standard error, FLIP and difference images.
use std::fs;

use noisefall_kernel::measure::exact::{furnace, furnace_capped, furnace_capped_variance};
use noisefall_render::render::{Display, Frame, image_file};
use serde_json::Value;

use super::command_line::{Shell, scene, text};

fn compare(shell: &Shell, arguments: &[&str]) -> Value {
    let output = shell.run(&[&["compare"], arguments, &["--json"]].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    serde_json::from_str(&text(&output.stdout)).expect("a line of JSON")
}

/// The text output of the same comparison.
fn said(shell: &Shell, arguments: &[&str]) -> String {
    let output = shell.run(&[&["compare"], arguments].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    text(&output.stdout)
}

fn render_scene(shell: &Shell, scene_file: &str, file: &str, options: &[&str]) {
    let output = shell.run(&[&["render", scene_file, "-o", file], options].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
}

fn render(shell: &Shell, file: &str, options: &[&str]) {
    let base = ["--spp", "32", "--size", "128x128"];
    render_scene(shell, &scene("cornell_spheres"), file, &[&base[..], options].concat());
}

fn render_furnace(shell: &Shell, file: &str, options: &[&str]) {
    let base = ["--spp", "16", "--size", "64x64", "--sampler", "independent", "--estimator", "path", "--roulette", "off"];
    render_scene(shell, &scene("furnace"), file, &[&base[..], options].concat());
}

/// An image of constant radiance without variances.
fn save_constant(shell: &Shell, file: &str, radiance: f32) {
    let frame =
        Frame { width: 64, height: 64, full_resolution: [64; 2], radiance: vec![[radiance; 3]; 64 * 64], ..Frame::default() };
    image_file::save(&frame, Display::default(), "{}", &shell.path(file)).expect("it is saved");
}

fn z(line: &Value) -> f64 {
    line["bias_in_standard_errors"].as_f64().unwrap_or_else(|| panic!("{line}"))
}

/// Compares an image with variances with one without. The text has the numbers of the JSON, each after its name.
fn assert_text_agrees(told: &str, line: &Value) {
    let number = |name: &str| line[name].as_f64().unwrap_or_else(|| panic!("{name}: {line}"));
    let z: Vec<f64> = line["block_z"].as_array().expect("blocks").iter().filter_map(Value::as_f64).collect();
    let worst = z.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).expect("a block");
    let rms = (z.iter().map(|z| z * z).sum::<f64>() / z.len() as f64).sqrt();
    let [bias, error, z] = ["bias", "bias_standard_error", "bias_in_standard_errors"].map(&number);
    for part in [
        format!("RMSE    {:.6e}\nrelMSE  {:.6e}\n", number("rmse"), number("rel_mse")),
        format!("bias    {bias:+.6e} ± {error:.2e}: {z:+.2} standard errors\n"),
        format!(" of 32 × 32 pixels: worst z {worst:+.2}, root mean square {rms:.2} (noise alone: 1)\n"),
        "warning: the error of truth.exr itself is unknown and assumed to be 0\n".to_owned(),
    ] {
        assert!(told.contains(&part), "{part}: {told}");
    }
}

/// Exceeded by chance once in 30000 cases.
const SIGMAS: f64 = 4.0;

#[test]
fn the_bias_of_a_capped_furnace_is_as_many_standard_errors_as_closed_form_says() {
    let shell = Shell::new();
    save_constant(&shell, "truth.exr", furnace(1.0, 0.5) as f32);
    for cap in [1, 2, 3] {
        render_furnace(&shell, "capped.exr", &["--max-bounces", &cap.to_string()]);
        let line = compare(&shell, &["capped.exr", "truth.exr"]);
        let standard_error = (furnace_capped_variance(1.0, 0.5, 4.0 / 3.0, cap) / (64.0 * 64.0 * 16.0)).sqrt();
        let exact = (furnace_capped(1.0, 0.5, cap) - furnace(1.0, 0.5)) / standard_error;
        // −443, −162 and −72: the relative error of a variance of 65536 samples is 0.6 %.
        assert!((z(&line) / exact - 1.0).abs() < 0.02, "cap {cap}: {} {exact}", z(&line));
        assert!((line["bias_standard_error"].as_f64().unwrap_or(0.0) / standard_error - 1.0).abs() < 0.02, "{line}");
        let blocks = line["block_z"].as_array().expect("blocks");
        // Each of the four blocks has a quarter of the samples, so twice the standard error.
        assert!(blocks.len() == 4 && blocks.iter().all(|z| (z.as_f64().unwrap_or(0.0) / exact - 0.5).abs() < 0.03), "{line}");
        assert_eq!((&line["heavy_tails"], &line["exact_samples"]), (&Value::Bool(false), &Value::Bool(false)));
        assert_text_agrees(&said(&shell, &["capped.exr", "truth.exr"]), &line);
    }
}

#[test]
fn exact_samples_are_not_compared_by_chance() {
    let shell = Shell::new();
    save_constant(&shell, "truth.exr", 2.0);
    render_furnace(&shell, "cap0.exr", &["--max-bounces", "0"]);
    render_furnace(&shell, "cosine.exr", &["--max-bounces", "2", "--directions", "cosine"]);
    for (file, bias) in [("cap0.exr", -1.0), ("cosine.exr", -0.25)] {
        let line = compare(&shell, &[file, "truth.exr"]);
        assert!((line["bias"].as_f64().unwrap_or(0.0) - bias).abs() < 1e-6, "{line}");
        assert!(
            line["exact_samples"] == true && line["bias_in_standard_errors"].is_null() && line["block_z"].is_null(),
            "{line}"
        );
        assert!(said(&shell, &[file, "truth.exr"]).contains("exact samples: not noise"));
    }
    render_furnace(&shell, "full.exr", &["--directions", "cosine"]);
    assert!(said(&shell, &["full.exr", "truth.exr"]).contains("exact samples: no more than rounding"));
}

#[test]
fn repeats_give_the_standard_error_and_two_pictures_alone_do_not() {
    let shell = Shell::new();
    for (seed, file) in [("1", "a.png"), ("2", "b.png"), ("3", "c.png"), ("4", "d.png"), ("5", "e.png")] {
        render(&shell, file, &["--seed", seed]);
    }
    let alone = compare(&shell, &["a.png", "b.png"]);
    assert!(alone["bias_standard_error"].is_null() && alone["bias_in_standard_errors"].is_null() && alone["block_z"].is_null());
    let told = said(&shell, &["a.png", "b.png"]);
    assert!(told.contains("standard error unknown") && told.contains("unknown: a.png has no variances; render it"), "{told}");
    assert!(told.contains("or give --repeats with other seeds"), "{told}");
    let repeated = compare(&shell, &["a.png", "b.png", "--repeats", "c.png", "d.png", "e.png"]);
    assert!(repeated["bias_standard_error"].as_f64().is_some_and(|error| error > 0.0), "{repeated}");
    assert!(z(&repeated).abs() < SIGMAS && repeated["block_z"].as_array().map(Vec::len) == Some(16), "{repeated}");
    let same = shell.run(&["compare", "a.png", "b.png", "--repeats", "a.png"]);
    assert!(same.status.code() == Some(1) && text(&same.stderr).contains("repeats need other seeds"), "{}", text(&same.stderr));
}

#[test]
fn repeats_find_the_bias_that_variances_find() {
    let shell = Shell::new();
    save_constant(&shell, "truth.exr", 2.0);
    let files: Vec<String> = (0..6).map(|seed| format!("{seed}.exr")).collect();
    for (seed, file) in files.iter().enumerate() {
        render_furnace(&shell, file, &["--max-bounces", "1", "--seed", &seed.to_string()]);
    }
    let mut arguments = vec![files[0].as_str(), "truth.exr", "--repeats"];
    arguments.extend(files[1..].iter().map(String::as_str));
    let line = compare(&shell, &arguments);
    let standard_error = (furnace_capped_variance(1.0, 0.5, 4.0 / 3.0, 1) / (64.0 * 64.0 * 16.0 * 6.0)).sqrt();
    // χ² with 5 degrees of freedom is below 0.21 in one of 1000 cases, and above 25.7 in one of 10000.
    let ratio = line["bias_standard_error"].as_f64().unwrap_or(0.0) / standard_error;
    assert!((0.21f64 / 5.0).sqrt() < ratio && ratio < (25.7f64 / 5.0).sqrt(), "{ratio}");
    assert!((line["bias"].as_f64().unwrap_or(0.0) + 0.5).abs() < SIGMAS * standard_error, "{line}");
    // The score by Student's t with five degrees of freedom is smaller than the number of standard errors, but still large.
    assert!(z(&line) < -6.0 && z(&line) > -0.5 / standard_error, "{line}");
}

/// A room with grey walls. With roulette at q = 0.5 every reflection is 1.5 times as bright or lost, and E X² is infinite for ρ²
/// ≥ q.
const ROOM: &str = r#"
format = 1
camera = { eye = [0.1, 0.0, 0.2], look_at = [1.0, 0.3, 0.0], fov = 90.0, resolution = [64, 64] }
materials.wall.lambertian.albedo = 0.75
[[objects]]
shape = { cuboid = { min = [-1, -1, -1], max = [1, 1, 1] } }
material = "wall"
emission.radiance = 1.0
flip = true
"#;

#[test]
fn a_variance_that_few_samples_make_up_is_not_trusted() {
    let shell = Shell::new();
    fs::write(shell.path("room.toml"), ROOM).expect("a scene");
    let plain = ["--sampler", "independent", "--estimator", "path", "--reuse", "off", "--directions", "cosine"];
    save_constant(&shell, "truth.exr", 4.0);
    let heavy = |roulette: &str| {
        render_scene(&shell, "room.toml", "a.exr", &[&plain[..], &["--spp", "16", "--roulette", roulette]].concat());
        let told = said(&shell, &["a.exr", "truth.exr"]);
        let line = compare(&shell, &["a.exr", "truth.exr"]);
        let is_heavy = told.contains("few samples make up most of the variance: do not trust the standard error");
        assert_eq!(line["heavy_tails"], Value::Bool(is_heavy), "{told}");
        assert!(is_heavy || z(&line).abs() < SIGMAS, "{line}");
        is_heavy
    };
    assert_eq!(["0.5", "0.56", "0.8"].map(heavy), [true, true, false]);
}

#[test]
fn bias_is_distinguished_from_noise_with_path_reuse_too() {
    let shell = Shell::new();
    for reuse in ["suffixes", "off"] {
        render(&shell, "a.exr", &["--seed", "1", "--reuse", reuse]);
        render(&shell, "b.exr", &["--seed", "2", "--reuse", reuse]);
        render(&shell, "capped.exr", &["--seed", "3", "--max-bounces", "4", "--reuse", reuse]);
        let noise = compare(&shell, &["a.exr", "b.exr"]);
        let bias = compare(&shell, &["capped.exr", "b.exr"]);
        assert_eq!(noise["block_z"].as_array().map(Vec::len), Some(16));
        assert!(z(&noise).abs() < SIGMAS, "{noise}");
        assert!(z(&bias) < -6.0, "{bias}");
        let told = said(&shell, &["a.exr", "b.exr"]);
        assert!(
            told.contains("is an upper bound: the error of stratified and Sobol samples") && !told.contains("is not known"),
            "{told}"
        );
        if cfg!(feature = "flip") {
            let flip = |line: &Value| line["flip"].as_f64().expect("a number");
            assert!(flip(&compare(&shell, &["a.exr", "a.exr"])) == 0.0 && flip(&bias) > flip(&noise) && flip(&noise) > 0.0);
        }
    }
    render(&shell, "a.exr", &["--seed", "2", "--max-bounces", "4"]);
    assert!(said(&shell, &["a.exr", "b.exr"]).contains("A and B have the same seed"));
}

#[test]
fn the_floor_of_rel_mse_is_relative_unless_it_is_named() {
    let shell = Shell::new();
    for (file, radiance) in [("a.exr", 3.0), ("b.exr", 2.0), ("black.exr", 0.0)] {
        save_constant(&shell, file, radiance);
    }
    let rel_mse = |arguments: &[&str]| compare(&shell, arguments)["rel_mse"].as_f64();
    let is = |found: Option<f64>, exact: f64| assert!(found.is_some_and(|x| (x / exact - 1.0).abs() < 1e-9), "{found:?} {exact}");
    let floor = |arguments: &[&str]| compare(&shell, arguments)["floor"].as_str().map(str::to_owned);
    assert_eq!(floor(&["a.exr", "b.exr"]).as_deref(), Some("0.01 of mean square"));
    assert_eq!(floor(&["a.exr", "b.exr", "--floor", "0.5"]).as_deref(), Some("0.5"));
    is(rel_mse(&["a.exr", "b.exr"]), 1.0 / 4.04);
    is(rel_mse(&["a.exr", "b.exr", "--floor", "0.01"]), 1.0 / 4.01);
    is(rel_mse(&["a.exr", "black.exr", "--floor", "0.5"]), 18.0);
    assert_eq!(rel_mse(&["a.exr", "black.exr"]), None, "nothing is relative to black");
    assert_eq!(rel_mse(&["black.exr", "black.exr"]), Some(0.0));
    let refused = shell.run(&["compare", "a.exr", "b.exr", "--floor", "-1"]);
    assert!(refused.status.code() == Some(2) && text(&refused.stderr).contains("expected a number above 0"));
    for command in ["compare", "study", "render"] {
        assert!(
            text(&shell.run(&[command, "--help"]).stdout).split_whitespace().collect::<String>().contains("0.01"),
            "{command}"
        );
    }
}

#[test]
fn differences_are_written_as_numbers_and_as_colours() {
    let shell = Shell::new();
    render(&shell, "a.exr", &["--seed", "1"]);
    render(&shell, "b.exr", &["--seed", "2"]);
    let said = |file: &str| {
        let told = said(&shell, &["a.exr", "b.exr", "-o", file]);
        assert!(shell.path(file).is_file());
        told
    };
    assert!(said("difference.png").contains("full colour is a difference of"));
    assert!(said("difference.exr").contains("A minus B"));
    let read = |file: &str| image_file::read(&shell.path(file)).expect("an image").radiance;
    let (a, b, difference) = (read("a.exr"), read("b.exr"), read("difference.exr"));
    let exact = |(a, b): (&[f32; 3], &[f32; 3])| [0, 1, 2].map(|c| a[c] - b[c]);
    assert!(a.iter().zip(&b).map(exact).eq(difference) && a != b);
    let streamed = shell.run(&["compare", "a.exr", "b.exr", "-o", "-", "--format", "exr"]);
    assert!(streamed.status.success() && text(&streamed.stderr).contains("standard output: A minus B"));
    assert!(fs::read(shell.path("difference.exr")).is_ok_and(|bytes| bytes == streamed.stdout));
    let unnamed = shell.run(&["compare", "a.exr", "b.exr", "-o", "-"]);
    assert!(unnamed.status.code() == Some(2) && text(&unnamed.stderr).contains("needs --format"));
    let refused = shell.run(&["compare", "a.exr", "b.exr", "-o", "nowhere/difference.png"]);
    assert!(refused.status.code() == Some(1) && text(&refused.stderr).contains("there is no folder"));
}

#[test]
fn a_pixel_that_is_no_number_is_named_by_column_and_row() {
    let shell = Shell::new();
    let mut frame = Frame { width: 5, height: 2, full_resolution: [5, 2], radiance: vec![[1.0; 3]; 10], ..Frame::default() };
    frame.radiance[5 + 3][1] = f32::NAN;
    image_file::save(&frame, Display::default(), "{}", &shell.path("a.exr")).expect("it is saved");
    let refused = shell.run(&["compare", "a.exr", "a.exr"]);
    assert_eq!(refused.status.code(), Some(1));
    assert_eq!(text(&refused.stderr), "a.exr: pixel 3,1 is not a finite number\n");
}

/// Luminance 2, 1 and 0.5 against 1: it differs by 1, 0 and −0.5 over √1.01, and the largest difference has full colour.
#[test]
fn colours_of_a_difference_have_its_sign_and_size() {
    let shell = Shell::new();
    let radiance: Vec<[f32; 3]> = (0..64 * 64).map(|i| [[2.0; 3], [0.0, 1.0 / 0.7152, 0.0], [0.5; 3]][i % 64 / 22]).collect();
    let frame = Frame { width: 64, height: 64, full_resolution: [64; 2], radiance, ..Frame::default() };
    image_file::save(&frame, Display::default(), "{}", &shell.path("a.exr")).expect("it is saved");
    save_constant(&shell, "b.exr", 1.0);
    let told = said(&shell, &["a.exr", "b.exr", "-o", "difference.png"]);
    assert!(told.contains("full colour is a difference of 99.5 %"), "{told}");
    let shown = image_file::read(&shell.path("difference.png")).expect("an image").radiance;
    let near =
        |i: usize, exact: [f32; 3]| assert!(shown[i].iter().zip(exact).all(|(a, b)| (a - b).abs() < 0.01), "{i}: {:?}", shown[i]);
    near(0, [0.445, 0.017, 0.025]);
    near(30, [1.0; 3]);
    near(60, [0.5085, 0.5625, 0.7225]);
}
