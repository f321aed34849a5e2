//! A validator of JSON Schemas for the keywords that our schemas use.
use serde_json::Value;

/// Whether a value fits a schema: types, objects, lists, words, choices, and references within the schema. Ranges of numbers are not
/// checked.
pub fn fits(value: &Value, schema: &Value) -> bool {
    fits_in(value, schema, schema)
}

/// Whether a value fits a part of a schema, such as `replay`.
pub fn fits_part(value: &Value, part: &str, schema: &Value) -> bool {
    fits_in(value, &schema["$defs"][part], schema)
}

fn fits_in(value: &Value, schema: &Value, whole: &Value) -> bool {
    if let Some(name) = schema["$ref"].as_str() {
        let part = name.strip_prefix('#').and_then(|pointer| whole.pointer(pointer));
        return fits_in(value, part.unwrap_or_else(|| panic!("{name} is described")), whole);
    }
    if let Some(choices) = schema["anyOf"].as_array() {
        return choices.iter().any(|choice| fits_in(value, choice, whole));
    }
    if let Some(words) = schema["enum"].as_array() {
        return words.contains(value);
    }
    match &schema["type"] {
        Value::String(kind) => is(value, kind, schema, whole),
        Value::Array(kinds) => kinds.iter().filter_map(Value::as_str).any(|kind| is(value, kind, schema, whole)),
        _ => panic!("{schema:#} states no type"),
    }
}

/// Whether a value has this type, and fits what the schema says of values of this type.
fn is(value: &Value, kind: &str, schema: &Value, whole: &Value) -> bool {
    match (kind, value) {
        ("object", Value::Object(table)) => {
            let has = |key: &Value| key.as_str().is_some_and(|key| table.contains_key(key));
            let all = |keys: &Value| keys.as_array().into_iter().flatten().all(has);
            let one_of = |choice: &Value| {
                choice["oneOf"].as_array().into_iter().flatten().filter(|one| all(&one["required"])).count() == 1
            };
            let known = |(key, value): (&String, &Value)| match schema["properties"].get(key) {
                Some(schema) => fits_in(value, schema, whole),
                None => schema["additionalProperties"].is_object() && fits_in(value, &schema["additionalProperties"], whole),
            };
            table.iter().all(known) && all(&schema["required"]) && schema["allOf"].as_array().into_iter().flatten().all(one_of)
        }
        ("array", Value::Array(items)) => {
            let length = |key: &str, or: usize| schema[key].as_u64().map_or(or, |length| length as usize);
            (length("minItems", 0)..=length("maxItems", usize::MAX)).contains(&items.len())
                && items.iter().all(|item| fits_in(item, &schema["items"], whole))
        }
        ("number", Value::Number(_)) | ("string", Value::String(_)) | ("boolean", Value::Bool(_)) | ("null", Value::Null) => true,
        ("integer", Value::Number(number)) => number.is_u64() || number.is_i64(),
        _ => false,
    }
}
