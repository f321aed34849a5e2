//! Every row of the table of settings, at random values, in every place that shows settings.
use noisefall_base::declare::{Datum, Declare, Dice};
use noisefall_scene::scene::{Estimator, RenderSettings, Reuse, Setting};
use rand::{SeedableRng, rngs::SmallRng};
use serde_json::{Value, json};

use super::command_line::{Shell, scene, text};

const RENDERS: u64 = 8;

/// Random settings that render in a moment, and their options.
fn random(seed: u64) -> (RenderSettings, Vec<String>) {
    let mut settings = RenderSettings::default();
    settings.parameters(&mut Dice::new(&mut SmallRng::seed_from_u64(seed)));
    settings.max_bounces = settings.max_bounces.map(|cap| cap.min(3));
    let options = RenderSettings::TABLE.iter().flat_map(|setting| [format!("--{}", setting.option()), setting.value(&settings)]);
    (settings, options.collect())
}

fn run(shell: &Shell, command: &[&str], options: &[String]) -> String {
    let options: Vec<&str> = options.iter().map(String::as_str).collect();
    let output = shell.run(&[command, &options[..]].concat());
    assert!(output.status.success(), "{options:?}: {}", text(&output.stderr));
    text(&output.stdout)
}

#[test]
fn every_setting_is_a_key_of_scene_files_an_option_and_a_list() {
    let shell = Shell::new();
    let schema: Value = serde_json::from_str(&run(&shell, &["schema"], &[])).expect("it is JSON");
    let [render, study, sheet] = ["render", "study", "sheet"].map(|command| run(&shell, &[command, "--help"], &[]));
    for setting in RenderSettings::TABLE {
        let doc = schema["properties"]["render"]["properties"][setting.key()]["description"].as_str().unwrap_or_default();
        assert!(doc.starts_with(setting.parameter.doc), "{setting:?}: {doc}");
        assert!(render.contains(&format!("--{} <", setting.option())), "{setting:?}: {render}");
    }
    for (setting, help) in RenderSettings::axes().flat_map(|setting| [(setting, &study), (setting, &sheet)]) {
        assert!(help.contains(&format!("--{} <LIST>", setting.list.replace('_', "-"))), "{setting:?}: {help}");
    }
}

#[test]
fn every_setting_is_a_figure_and_stands_in_the_heading_of_a_path() {
    let shell = Shell::new();
    let furnace = scene("furnace");
    for seed in 0..RENDERS {
        let (settings, options) = random(seed);
        let command = ["render", &furnace, "-o", "a.png", "--spp", "1", "--size", "4x4", "--json"];
        let line: Value = serde_json::from_str(run(&shell, &command, &options).lines().last().expect("a line")).expect("JSON");
        let heading = run(&shell, &["render", &furnace, "--pixel", "1,1", "--size", "4x4"], &options);
        for setting in RenderSettings::TABLE {
            let (key, value) = (setting.key(), setting.value(&settings));
            let figure = match setting.datum(&settings) {
                Datum::Count(count) => json!(count),
                _ => json!(value),
            };
            assert_eq!(line[key], figure, "{key}: {line}");
            // A heading tells the decision of a trial, not the setting that asked for it.
            let is_decided = match key {
                "estimator" => settings.estimator.traces_light_paths() || settings.estimator == Estimator::Auto,
                "merging" => true,
                "reuse" => settings.reuse == Reuse::Auto,
                _ => false,
            };
            let expected = if is_decided { format!("{key} ") } else { format!("{key} {value}") };
            assert!(heading.contains(&expected), "{expected}: {heading}");
        }
    }
}

#[test]
fn every_setting_is_a_column_and_an_axis_of_a_study() {
    let shell = Shell::new();
    let furnace = scene("furnace");
    let lists = RenderSettings::axes().flat_map(|setting| {
        let word = setting.value(&RenderSettings::default());
        [format!("--{}", setting.list.replace('_', "-")), if setting.key() == "max_bounces" { "1,none".to_owned() } else { word }]
    });
    let lists: Vec<String> = lists.collect();
    run(&shell, &["study", &furnace, "-o", "found", "--spp", "2", "--size", "4x4", "--repeats", "1"], &lists);
    let csv = std::fs::read_to_string(shell.path("found/study.csv")).expect("it is written");
    let mut lines = csv::Reader::from_reader(csv.as_bytes());
    let columns = lines.headers().expect("names").clone();
    let rows: Vec<csv::StringRecord> = lines.records().map(|row| row.expect("a row")).collect();
    for setting in RenderSettings::TABLE {
        let at = columns.iter().position(|column| column == setting.key());
        let at = at.unwrap_or_else(|| panic!("{setting:?} is missing: {columns:?}"));
        let expected = setting.value(&RenderSettings::default());
        let is_axis = setting == RenderSettings::MAX_BOUNCES;
        assert!(rows.iter().any(|row| row[at] == expected), "{setting:?}");
        assert_eq!(rows.iter().any(|row| row[at] != expected), is_axis, "{setting:?}");
    }
}

#[test]
fn every_setting_is_an_argument_in_python() {
    let python = include_str!("../../python/noisefall/scene.py");
    let body =
        &python[python.find("    def render(").expect("the method")..python.find("    def replay(").expect("the next one")];
    let (arguments, call) = body.split_once(") -> Image:").expect("its arguments");
    for Setting { parameter, .. } in RenderSettings::TABLE {
        let key = parameter.key;
        assert!(arguments.contains(&format!("        {key}: ")), "{key}: {arguments}");
        assert!(call.contains(&format!("            {key}={key},")), "{key}: {call}");
    }
}
