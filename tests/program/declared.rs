//! The declarations of the scene format: manual, schema, writer, and ranges.
use std::{fs, path::Path};

use noisefall_base::declare::{
    CountRange, Declare, Dice, Parameter, Parameters, Range, Textured, Value, check, manual, schema, write,
};
use noisefall_scene::scene::{describe, description::SceneDescription};
use rand::{SeedableRng, rngs::SmallRng};

use super::json_schema::fits;

pub(super) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The texts of all shipped scenes.
fn shipped() -> impl Iterator<Item = (String, String)> {
    let files = fs::read_dir(root().join("scenes")).expect("the folder can be read").map(|entry| entry.expect("an entry").path());
    let scenes = files.filter(|path| path.extension().is_some_and(|extension| extension == "toml"));
    scenes.map(|path| (path.display().to_string(), fs::read_to_string(&path).expect("a scene is text")))
}

fn drawn(seed: u64) -> SceneDescription {
    let mut random = SmallRng::seed_from_u64(seed);
    let mut description = SceneDescription::default();
    description.parameters(&mut Dice::new(&mut random));
    description
}

/// Set this variable to update the manual.
const UPDATE: &str = "NOISEFALL_UPDATE_MANUAL";

#[test]
fn the_manual_agrees_with_the_declarations() {
    let path = root().join("docs/scene-format.md");
    let known = fs::read_to_string(&path).expect("the manual is there");
    const BEGIN: &str = "<!-- from here on made from the declarations: NOISEFALL_UPDATE_MANUAL=1 cargo test --release --test program manual -->\n";
    let (before, _) = known.split_once(BEGIN).expect("the place where the tables begin");
    let now = format!("{before}{BEGIN}{}", manual(&mut SceneDescription::default()));
    if std::env::var_os(UPDATE).is_some() {
        fs::write(&path, &now).expect("the manual is written");
    }
    assert!(known == now || std::env::var_os(UPDATE).is_some(), "docs/scene-format.md is old: set {UPDATE}=1 and run this test");
}

#[test]
fn written_scenes_read_back_the_same() {
    for (name, text) in shipped() {
        let description = describe(&name, text).unwrap_or_else(|error| panic!("{}", error.report()));
        let again = describe(&name, description.to_text()).unwrap_or_else(|error| panic!("{name}: {}", error.report()));
        assert_eq!(description, again, "{name}");
    }
    for seed in 0..2_000 {
        let description = drawn(seed);
        let text = description.to_text();
        let again = describe("drawn", text.clone()).unwrap_or_else(|error| panic!("seed {seed}: {}\n{text}", error.report()));
        assert_eq!(description, again, "seed {seed}:\n{text}");
    }
}

#[test]
fn random_values_are_within_their_ranges() {
    for seed in 0..1000 {
        assert_eq!(check(&mut drawn(seed)), [], "seed {seed}");
    }
}

/// Moves one number of a description just outside its range.
struct Spoiler {
    /// Numbers that are still to be skipped.
    left: usize,
    above: bool,
    spoiled: Option<&'static str>,
}

impl Spoiler {
    fn outside(&mut self, parameter: &Parameter, range: &Range) -> Option<f64> {
        let beyond = if self.above { range.most * (1.0 + 1e-6) } else { range.least * (1.0 - 1e-6 * range.least.signum()) };
        let beyond = if beyond == 0.0 { -1e-30 } else { beyond };
        if *range == Range::FINITE || !beyond.is_finite() {
            return None;
        }
        let is_here = self.left == 0 && self.spoiled.is_none();
        self.left = self.left.saturating_sub(1);
        if is_here {
            self.spoiled = Some(parameter.key);
        }
        is_here.then_some(beyond)
    }
}

impl Parameters for Spoiler {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        match value {
            Value::Number(number, range) => *number = self.outside(parameter, &range).unwrap_or(*number),
            Value::TexturedNumber(number, range) => {
                if let Some(wrong) = self.outside(parameter, &range) {
                    *number = Textured::Constant(wrong);
                }
            }
            Value::Colour(colour, range) => colour[1] = self.outside(parameter, &range).unwrap_or(colour[1]),
            Value::Textured(colour, range) => {
                if let Some(wrong) = self.outside(parameter, &range) {
                    *colour = Textured::Constant([0.5, wrong, 0.5]);
                }
            }
            Value::Count(count, CountRange { least, most }) => {
                let beyond = if self.above { most.checked_add(1) } else { least.checked_sub(1) };
                let is_here = self.left == 0 && self.spoiled.is_none();
                if let (Some(beyond), true) = (beyond, is_here && parameter.key != "format") {
                    (*count, self.spoiled) = (beyond, Some(parameter.key));
                }
                self.left = self.left.saturating_sub(usize::from(beyond.is_some()));
            }
            _ => {}
        }
    }
}

#[test]
fn a_number_just_outside_of_its_range_is_refused_by_name() {
    let mut tried = std::collections::BTreeSet::new();
    for seed in 0..60 {
        for left in 0..40 {
            for above in [false, true] {
                let mut description = drawn(seed);
                let mut spoiler = Spoiler { left, above, spoiled: None };
                description.parameters(&mut spoiler);
                let Some(key) = spoiler.spoiled else { continue };
                let error = describe("spoiled", description.to_text()).expect_err(key).report();
                let says = |what: &str| error.contains(&format!("`{key}` is {what}"));
                assert!(says("out of range") || says("negative"), "seed {seed}, {key}: {error}");
                assert!(!check(&mut description).is_empty(), "seed {seed}, {key}");
                tried.insert((key, above));
            }
        }
    }
    assert!(tried.len() > 30, "{tried:?}");
}

#[test]
fn scenes_fit_the_schema_and_misspelled_ones_do_not() {
    let schema = schema("scene", &mut SceneDescription::default());
    let json = |text: &str| serde_json::to_value(toml::from_str::<toml::Table>(text).expect("TOML")).expect("JSON");
    for (name, text) in shipped() {
        let scene = json(&text);
        assert!(fits(&scene, &schema), "{name}");
        if text.contains("albedo") {
            assert!(!fits(&json(&text.replace("albedo", "albido")), &schema), "{name}");
        }
        assert!(!fits(&json(&text.replace("resolution", "resolutions")), &schema), "{name}");
    }
    for seed in 0..200 {
        let written = serde_json::to_value(write(&mut drawn(seed))).expect("JSON");
        assert!(fits(&written, &schema), "seed {seed}: {written:#}");
    }
}
