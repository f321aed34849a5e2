//! Mutations of JSON that stay JSON.
use rand::{Rng, rngs::SmallRng};
use serde_json::{Value, json};

use super::mutation::{outside, pick, text};

/// Longer JSON is changed as text, bytes.
const LONGEST_JSON: usize = 1 << 14;

/// Changes a value, or the text if it is long or no JSON. Returns whether it now names a file outside of its folder.
pub fn mutate(bytes: &mut Vec<u8>, random: &mut SmallRng) -> bool {
    let parsed =
        if bytes.len() <= LONGEST_JSON && random.random_bool(0.8) { serde_json::from_slice::<Value>(bytes).ok() } else { None };
    let Some(mut value) = parsed else { return text(bytes, random) };
    let leaves = change(&mut value, random);
    *bytes = value.to_string().into_bytes();
    leaves
}

/// Changes a value at a random place.
fn change(value: &mut Value, random: &mut SmallRng) -> bool {
    let descends = random.random_bool(0.85);
    match value {
        Value::Object(table) if !table.is_empty() => {
            let key = table.keys().nth(random.random_range(0..table.len())).cloned().unwrap_or_default();
            if descends {
                return table.get_mut(&key).is_some_and(|part| change(part, random));
            }
            table.remove(&key);
        }
        Value::Array(list) if !list.is_empty() => {
            let at = random.random_range(0..list.len());
            if descends {
                return change(&mut list[at], random);
            }
            let copy = list[at].clone();
            match random.random_range(0..3) {
                0 => drop(list.remove(at)),
                1 => list.extend(vec![copy; 1usize << random.random_range(0..8u32)]),
                _ => list[at] = list[random.random_range(0..list.len())].clone(),
            }
        }
        Value::String(name) => {
            let path = outside(name, random);
            *value = json!(path.clone().unwrap_or_else(|| pick(&["", "SCALAR", "MAT4", "data:,", "\u{0}"], random).to_owned()));
            return path.is_some();
        }
        _ => {
            let numbers = [
                json!(0),
                json!(-1),
                json!(1),
                json!(2),
                json!(4),
                json!(7),
                json!(5121),
                json!(4_294_967_295u64),
                json!(u64::MAX),
            ];
            let others = [json!(1e308), json!(-1e-320), json!(null), json!(0.5), json!([]), json!({}), json!(true), json!("")];
            let all: Vec<&Value> = numbers.iter().chain(&others).collect();
            *value = pick(&all, random).clone();
        }
    }
    false
}
