//! The types of the Python module, which the gate does not build, have every key and every word of the scene format.
use std::collections::BTreeSet;

use serde_json::Value;

use crate::command_line::{Shell, text};

const STUBS: &str = include_str!("../../python/noisefall/description.pyi");
const ARGUMENTS: &str = include_str!("../../python/noisefall/scene.py");

/// The keys of each class of the types.
fn classes() -> Vec<BTreeSet<&'static str>> {
    let key = |line: &'static str| {
        let (key, _) = line.strip_prefix("    ")?.split_once(": ")?;
        key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_').then_some(key)
    };
    STUBS.split("\nclass ").skip(1).map(|class| class.lines().filter_map(key).collect()).collect()
}

/// The sets of keys and the types that a part of the schema asks for.
fn expect<'a>(schema: &'a Value, keys: &mut BTreeSet<BTreeSet<&'a str>>, types: &mut BTreeSet<String>) {
    if let Some(properties) = schema["properties"].as_object().filter(|properties| !properties.is_empty()) {
        keys.insert(properties.keys().map(String::as_str).collect());
    }
    types.extend(schema["enum"].as_array().filter(|words| !words.is_empty()).map(|words| literal(words, '\'')));
    match schema {
        Value::Object(parts) => parts.values().for_each(|part| expect(part, keys, types)),
        Value::Array(parts) => parts.iter().for_each(|part| expect(part, keys, types)),
        _ => {}
    }
}

fn literal(words: &[Value], quote: char) -> String {
    let words = words.iter().map(|word| word.as_str().map_or_else(|| word.to_string(), |word| format!("{quote}{word}{quote}")));
    format!("Literal[{}]", words.collect::<Vec<_>>().join(", "))
}

#[test]
fn the_python_module_has_every_key_and_word_of_the_scene_format() {
    let output = Shell::new().run(&["schema"]);
    let schema: Value = serde_json::from_str(&text(&output.stdout)).expect("it is JSON");
    let (mut keys, mut types) = (BTreeSet::new(), BTreeSet::new());
    expect(&schema, &mut keys, &mut types);
    assert!(keys.len() > 50 && types.len() > 10, "{} tables and {} lists of words", keys.len(), types.len());
    let classes = classes();
    let tables: Vec<_> = keys.into_iter().filter(|keys| !classes.iter().any(|class| keys.is_subset(class))).collect();
    let words: Vec<_> = types.into_iter().filter(|words| !STUBS.contains(words)).collect();
    let advice = "python -m noisefall.stubs > python/noisefall/description.pyi";
    assert!(tables.is_empty() && words.is_empty(), "{advice} would add {tables:?} {words:?}");
    for (name, key) in [("Estimator", "estimator"), ("Directions", "directions"), ("Sampler", "sampler"), ("Reuse", "reuse")] {
        let words = schema["properties"]["render"]["properties"][key]["enum"].as_array().expect("a list of words");
        let line = format!("\n{name} = {}\n", literal(words, '"'));
        assert!(ARGUMENTS.contains(&line), "python/noisefall/scene.py lacks {line}");
    }
}
