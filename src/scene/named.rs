//! How a scene file writes a choice: by name, `"gaussian"`, or as a table of one kind with its numbers, `{ gaussian = { … } }`.
use std::{fmt, marker::PhantomData};

use serde::{
    Deserializer,
    de::{self, MapAccess, Visitor},
};

/// A choice that can be written in both ways.
pub trait Named: Sized {
    /// What the choice is about.
    const WHAT: &'static str;
    /// All that may be written.
    const EXPECTED: &'static str;

    fn of_name<E: de::Error>(name: &str) -> Result<Self, E>;

    /// The kind of this name, with the value that comes next in `map`.
    fn of_kind<'de, A: MapAccess<'de>>(kind: &str, map: &mut A) -> Result<Self, A::Error>;
}

pub fn deserialize<'de, T: Named, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
    deserializer.deserialize_any(NamedVisitor(PhantomData))
}

struct NamedVisitor<T>(PhantomData<T>);

impl<'de, T: Named> Visitor<'de> for NamedVisitor<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(T::EXPECTED)
    }
    fn visit_str<E: de::Error>(self, name: &str) -> Result<T, E> {
        T::of_name(name)
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<T, A::Error> {
        let Some(kind) = map.next_key::<String>()? else { return Err(de::Error::invalid_length(0, &self)) };
        let choice = T::of_kind(&kind, &mut map)?;
        match map.next_key::<String>()? {
            None => Ok(choice),
            Some(second) => Err(de::Error::custom(format!("a second kind of {}, `{second}`: there can be one", T::WHAT))),
        }
    }
}
