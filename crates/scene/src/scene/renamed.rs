//! Keys and values of scene files that had other names before version 0.1.

use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

/// A key or a value with its former name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Renamed {
    /// Keys of the place: of the key itself, or of the key that has the value.
    pub place: &'static [&'static str],
    /// The former name.
    pub former: &'static str,
    /// The name now.
    pub now: &'static str,
}

/// All of them. Former keys are still read, since scripts outside of the project write them: a warning names the new key. Former values are
/// refused. `noisefall convert` rewrites files.
pub const RENAMED: [Renamed; 6] = [
    key("lamps", "lights"),
    key("truth", "reference"),
    key("background", "environment"),
    value(&["render", "estimator"], "forward", "light_tracing"),
    value(&["render", "reuse"], "on", "suffixes"),
    value(&["render", "reuse"], "bright", "outliers"),
];

const fn key(former: &'static str, now: &'static str) -> Renamed {
    Renamed { place: &[], former, now }
}

const fn value(place: &'static [&'static str], former: &'static str, now: &'static str) -> Renamed {
    Renamed { place, former, now }
}

/// The value of a key at the top of a file, which may be under its former name.
pub(super) fn value_of<'t>(file: &'t DeTable<'t>, key: &str) -> Option<&'t Spanned<DeValue<'t>>> {
    file.get(key).or_else(|| file.get(former(key)?))
}

/// Whether a key at the top of a file is the former name of a key that is absent.
pub(super) fn is_read(file: &DeTable, word: &str) -> bool {
    keys().any(|renamed| renamed.former == word && !file.contains_key(renamed.now))
}

/// Warnings about the former keys of a file.
pub(super) fn warnings(file: &DeTable) -> Vec<String> {
    let former = keys().filter(|renamed| is_read(file, renamed.former) && file.contains_key(renamed.former));
    former
        .map(|Renamed { former, now, .. }| format!("`{former}` is now `{now}`: `noisefall convert` rewrites the file"))
        .collect()
}

fn keys() -> impl Iterator<Item = &'static Renamed> {
    RENAMED.iter().filter(|renamed| renamed.place.is_empty())
}

fn former(key: &str) -> Option<&'static str> {
    keys().find(|renamed| renamed.now == key).map(|renamed| renamed.former)
}
