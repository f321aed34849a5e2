//! The types of the Python module, which the gate does not build, have every key and every word of the scene format.
use std::collections::BTreeSet;

use serde_json::Value;

use crate::command_line::{Shell, text};

const STUBS: &str = include_str!("../../python/noisefall/description.pyi");
const ARGUMENTS: &str = include_str!("../../python/noisefall/scene.py");

/// The lines and types that a part of the schema asks for.
fn expect(schema: &Value, expected: &mut BTreeSet<String>) {
    let keys = schema["properties"].as_object().into_iter().flatten();
    expected.extend(keys.map(|(key, _)| format!("\n    {key}: ")));
    expected.extend(schema["enum"].as_array().filter(|words| !words.is_empty()).map(|words| literal(words, '\'')));
    match schema {
        Value::Object(parts) => parts.values().for_each(|part| expect(part, expected)),
        Value::Array(parts) => parts.iter().for_each(|part| expect(part, expected)),
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
    let mut expected = BTreeSet::new();
    expect(&schema, &mut expected);
    assert!(expected.len() > 200, "{} keys and lists of words", expected.len());
    let missing: Vec<&String> = expected.iter().filter(|line| !STUBS.contains(*line)).collect();
    assert!(missing.is_empty(), "python -m noisefall.stubs > python/noisefall/description.pyi would add {missing:?}");
    for (name, key) in [("Estimator", "estimator"), ("Directions", "directions"), ("Sampler", "sampler"), ("Reuse", "reuse")] {
        let words = schema["properties"]["render"]["properties"][key]["enum"].as_array().expect("a list of words");
        let line = format!("\n{name} = {}\n", literal(words, '"'));
        assert!(ARGUMENTS.contains(&line), "python/noisefall/scene.py lacks {line}");
    }
}
