//! The machine-readable output of commands follows `docs/figures.schema.json`.
use std::{collections::BTreeSet, fs, process::Stdio};

use noisefall_base::math::colour::linear_from_srgb;
use serde_json::{Value, json};

use super::{
    command_line::{Shell, json as last_line, scene, text},
    json_schema::{fits, fits_part},
};

const SCHEMA: &str = include_str!("../../docs/figures.schema.json");

/// The names of figures in one kind of output, in order.
fn required(schema: &Value, kind: &str) -> Vec<String> {
    let names = schema["$defs"][kind]["required"].as_array().unwrap_or_else(|| panic!("{kind} is described"));
    names.iter().map(|name| name.as_str().expect("a name").to_owned()).collect()
}

/// Checks a value against the schema of its name: type, type of items, and allowed words.
fn check(schema: &Value, name: &str, value: &Value) {
    let figure = &schema["$defs"]["figures"]["properties"][name];
    assert!(figure["description"].is_string(), "{name} is not described");
    let is = |kind: &str| match kind {
        "string" => value.is_string(),
        "integer" => value.is_u64() || value.is_i64(),
        "number" => value.is_number(),
        "boolean" => value.is_boolean(),
        "array" => fits(value, figure),
        _ => value.is_null(),
    };
    let kinds = figure["type"].as_array().cloned().unwrap_or_else(|| vec![figure["type"].clone()]);
    assert!(kinds.iter().any(|kind| is(kind.as_str().expect("a type"))), "{name}: {value} is none of {kinds:?}");
    let words = figure["enum"].as_array();
    assert!(words.is_none_or(|words| words.contains(value)), "{name}: {value} is not listed");
}

#[test]
fn every_figure_is_described_and_every_described_figure_is_there() {
    let shell = Shell::new();
    let schema: Value = serde_json::from_str(SCHEMA).expect("the schema is JSON");
    let furnace = scene("furnace");
    let render = |arguments: &[&str]| {
        last_line(&shell.run(&[&["render", &furnace, "-o", "a.exr", "--size", "8x8", "--json"], arguments].concat()))
    };
    let samples = |range: &str, output: &str| {
        let options = ["--samples", range, "--size", "8x8", "--json"];
        last_line(&shell.run(&[&["render", &furnace, "-o", output], &options[..]].concat()))
    };
    let lines = [
        ("samples", samples("0..2", "first.nf")),
        ("samples", samples("4..6", "last.nf")),
        ("samples", samples("0..4", "c.exr")),
        ("samples", last_line(&shell.run(&["merge", "first.nf", "last.nf", "-o", "d.exr", "--allow-gaps", "--json"]))),
        ("render", render(&["--spp", "2", "--max-bounces", "3", "--roulette", "0.5"])),
        ("render", render(&["--time", "0.05"])),
        (
            "render",
            last_line(&shell.run(&["render", &scene("cornell_box"), "-o", "b.exr", "--size", "8x8", "--spp", "1", "--json"])),
        ),
        ("compare", last_line(&shell.run(&["compare", "a.exr", "a.exr", "--json"]))),
        ("compare", last_line(&shell.run(&["compare", "a.exr", "b.exr", "--json"]))),
    ];
    for (kind, line) in lines {
        let mut expected = required(&schema, kind);
        expected.sort();
        let mut names: Vec<&String> = line.as_object().expect("an object").keys().collect();
        names.sort();
        assert_eq!(names, expected.iter().collect::<Vec<_>>(), "{kind}");
        line.as_object().expect("an object").iter().for_each(|(name, value)| check(&schema, name, value));
    }
}

#[test]
fn replays_follow_the_schema() {
    let shell = Shell::new();
    let schema: Value = serde_json::from_str(SCHEMA).expect("the schema is JSON");
    let mut present = BTreeSet::new();
    for name in ["cornell_box", "glass_and_mirror", "lights", "leaves", "textures_and_bump", "room_window"] {
        for sample in ["0", "1", "lit"] {
            for reuse in ["suffixes", "off"] {
                let options = ["--size", "32x32", "--sample", sample, "--reuse", reuse];
                let line = last_line(&shell.run(&[&["render", name, "--pixel", "16,20", "--json"], &options[..]].concat()));
                assert!(fits_part(&line, "replay", &schema), "{name}, {sample}: {line:#}");
                let tables = [vec![&line], line["vertices"].as_array().expect("a list").iter().collect()].concat();
                let keys = tables.into_iter().filter_map(Value::as_object).flatten().filter(|(_, value)| !value.is_null());
                present.extend(keys.map(|(key, _)| key.clone()));
            }
        }
    }
    for sample in 0..4 {
        let options = ["--size", "32x32", "--sample", &sample.to_string(), "--estimator", "bidirectional"];
        let line = last_line(&shell.run(&[&["render", "cornell_box", "--pixel", "16,20", "--json"], &options[..]].concat()));
        assert!(fits_part(&line, "replay", &schema) && line["bidirectional"].is_object(), "{sample}: {line:#}");
        present.insert("bidirectional".to_owned());
    }
    let of = |part: &str| schema["$defs"][part]["required"].as_array().expect("keys").clone();
    for key in [of("replay"), of("vertex")].concat() {
        assert!(present.contains(key.as_str().expect("a name")), "no path has {key}");
    }
}

#[test]
fn values_that_the_schema_does_not_describe_are_refused() {
    let schema: Value = serde_json::from_str(SCHEMA).expect("the schema is JSON");
    let replay =
        json!({ "radiance": [0.0, 0.5, 1], "alone": null, "shared": null, "bidirectional": null, "vertices": [], "end": "cap" });
    assert!(fits_part(&replay, "replay", &schema));
    for (key, wrong) in [("radiance", json!([0.0, 1.0])), ("end", json!("bored")), ("vertices", json!([{}])), ("more", json!(1))]
    {
        let mut changed = replay.clone();
        changed[key] = wrong;
        assert!(!fits_part(&changed, "replay", &schema), "{key}");
    }
}

#[test]
fn the_columns_of_studies_in_one_folder_are_described_in_their_order() {
    let shell = Shell::new();
    let schema: Value = serde_json::from_str(SCHEMA).expect("the schema is JSON");
    let few = ["--estimators", "mis", "--directions", "bsdf", "--samplers", "sobol", "--max-bounces", "none,2"];
    let small = ["--spp", "2", "--size", "8x8", "--repeats", "1"];
    let both = ["off", "0.8"].map(|roulette| {
        let mut study = shell.command(&["study", &scene("furnace"), "-o", "out", "--roulette", roulette]);
        study.args(few).args(small).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("the program starts")
    });
    for study in both {
        let done = study.wait_with_output().expect("it ends");
        assert!(done.status.success(), "{}", text(&done.stderr));
    }
    let csv = fs::read(shell.path("out/study.csv")).expect("measurements");
    let mut table = csv::Reader::from_reader(&csv[..]);
    let columns: Vec<String> = table.headers().expect("names").iter().map(str::to_owned).collect();
    assert_eq!(columns, required(&schema, "study"));
    let rows: Vec<_> = table.records().map(|row| row.expect("a line")).collect();
    // Two caps of both, at 1 and 2 samples.
    assert_eq!(rows.len(), 2 * 2 * 2);
    let keys = |rows: &[csv::StringRecord]| rows.iter().map(|row| row[row.len() - 1].to_owned()).collect::<BTreeSet<_>>();
    assert!(keys(&rows).len() == 4 && rows.chunks(2).all(|run| keys(run).len() == 1), "the lines of a run follow each other");
    for row in &rows {
        for (name, cell) in columns.iter().zip(row) {
            let types = schema["$defs"]["figures"]["properties"][name]["type"].to_string();
            let value = match cell {
                "" | "none" if types.contains("null") => Value::Null,
                _ if types.contains("string") => json!(cell),
                _ => serde_json::from_str(cell).unwrap_or_else(|error| panic!("{name}: {cell}: {error}")),
            };
            check(&schema, name, &value);
        }
    }
}

#[test]
fn a_capped_furnace_has_the_partial_sum_and_its_bias() {
    let shell = Shell::new();
    let furnace = scene("furnace");
    let exact = ["--directions", "cosine", "--estimator", "path", "--max-bounces", "1"];
    let line = last_line(
        &shell.run(&[&["render", &furnace, "-o", "a.png", "--spp", "2", "--size", "4x4", "--json"], &exact[..]].concat()),
    );
    // Every sample is the partial sum, 1.5 of 2.
    assert_eq!((&line["mean"], &line["bias"]), (&json!([1.5, 1.5, 1.5]), &json!(-0.5)));
    assert_eq!((&line["biased"], &line["exact_samples"]), (&json!("cap at 1"), &json!(true)));
}

#[test]
fn exposure_and_tone_map_change_a_png_and_not_an_exr() {
    let shell = Shell::new();
    let furnace = scene("furnace");
    let render = |file: &str, options: &[&str]| {
        let fixed =
            ["render", &furnace, "-o", file, "--spp", "1", "--size", "4x4", "--directions", "cosine", "--max-bounces", "0"];
        let done = shell.run(&[&fixed[..], options].concat());
        assert!(done.status.success(), "{}", text(&done.stderr));
        let picture = noisefall_render::render::image_file::read(&shell.path(file)).expect("an image");
        (f64::from(picture.radiance[5][1]), text(&done.stderr))
    };
    // Every pixel is 1, up to 1 % for 8-bit codes.
    let near = |x: f64, exact: f64| assert!((x / exact - 1.0).abs() < 0.01, "{x} {exact}");
    near(render("a.png", &[]).0, 1.0);
    near(render("b.png", &["--exposure", "-1"]).0, 0.5);
    near(render("c.png", &["--tone", "reinhard"]).0, 0.5);
    near(render("d.png", &["--tone", "reinhard", "--exposure", "1"]).0, 2.0 / 3.0);
    near(
        render("d.png", &["--tone", "aces", "--exposure", "1"]).0,
        2.0 * (2.51 * 2.0 + 0.03) / (2.0 * (2.43 * 2.0 + 0.59) + 0.14),
    );
    // A million times as bright is the yellow end of the scale.
    near(render("d.png", &["--tone", "false-colour", "--exposure", "20"]).0, linear_from_srgb(231.0 / 255.0));
    // Light of 2700 K is white then: white is blue.
    let balanced = noisefall::WhiteBalance { kelvin: 2700.0, tint: 0.0 }.matrix().expect("it changes something")[1];
    let exact: f32 = balanced.iter().sum::<f32>() / 2.0;
    near(render("d.png", &["--white-balance", "2700", "--exposure", "-1"]).0, exact.into());
    for option in [["--exposure", "-1"], ["--white-balance", "2700"]] {
        let (radiance, notes) = render("e.exr", &option);
        assert!(radiance == 1.0 && notes.contains("affect a PNG only"), "{radiance} {notes}");
    }
}
