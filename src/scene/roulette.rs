//! How a scene file writes roulette: by name, as on the command line, or with a value, `{ fixed = 0.9 }`.
use serde::{
    Deserialize, Deserializer,
    de::{self, MapAccess, Unexpected, Visitor},
};

use super::Roulette;

pub struct RouletteDesc(pub Roulette);

/// What stands behind `throughput`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Throughput {
    start: Option<u32>,
}

impl<'de> Deserialize<'de> for RouletteDesc {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RouletteVisitor)
    }
}

struct RouletteVisitor;

impl<'de> Visitor<'de> for RouletteVisitor {
    type Value = RouletteDesc;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("\"off\", \"throughput\", { fixed = … } or { throughput = { start = … } }")
    }
    fn visit_str<E: de::Error>(self, name: &str) -> Result<RouletteDesc, E> {
        match name {
            "off" => Ok(RouletteDesc(Roulette::Off)),
            "throughput" => Ok(RouletteDesc(Roulette::BY_THROUGHPUT)),
            "fixed" => Err(de::Error::invalid_type(Unexpected::UnitVariant, &"newtype variant")),
            _ => Err(de::Error::unknown_variant(name, &["off", "throughput"])),
        }
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<RouletteDesc, A::Error> {
        let roulette = match map.next_key::<String>()?.as_deref() {
            Some("fixed") => Roulette::Fixed(map.next_value()?),
            Some("throughput") => {
                let Throughput { start } = map.next_value()?;
                Roulette::Throughput { start: start.unwrap_or(Roulette::FIRST) }
            }
            Some(other) => return Err(de::Error::unknown_field(other, &["fixed", "throughput"])),
            None => return Err(de::Error::invalid_length(0, &self)),
        };
        match map.next_key::<String>()? {
            None => Ok(RouletteDesc(roulette)),
            Some(second) => Err(de::Error::custom(format!("a second kind of roulette, `{second}`: there can be one"))),
        }
    }
}
