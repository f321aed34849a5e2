//! How a scene file writes roulette: by name, as on the command line, or with a value.
use serde::{
    Deserialize, Deserializer,
    de::{self, MapAccess, Unexpected},
};

use super::{
    Roulette,
    named::{self, Named},
};

pub struct RouletteDesc(pub Roulette);

/// What stands behind `throughput`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Throughput {
    start: Option<u32>,
}

impl<'de> Deserialize<'de> for RouletteDesc {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        named::deserialize(deserializer).map(RouletteDesc)
    }
}

impl Named for Roulette {
    const WHAT: &'static str = "roulette";
    const EXPECTED: &'static str = "\"off\", \"throughput\", { fixed = … } or { throughput = { start = … } }";

    fn of_name<E: de::Error>(name: &str) -> Result<Self, E> {
        match name {
            "off" => Ok(Roulette::Off),
            "throughput" => Ok(Roulette::BY_THROUGHPUT),
            "fixed" => Err(de::Error::invalid_type(Unexpected::UnitVariant, &"newtype variant")),
            _ => Err(de::Error::unknown_variant(name, &["off", "throughput"])),
        }
    }

    fn of_kind<'de, A: MapAccess<'de>>(kind: &str, map: &mut A) -> Result<Self, A::Error> {
        match kind {
            "fixed" => map.next_value().map(Roulette::Fixed),
            "throughput" => {
                map.next_value().map(|Throughput { start }| Roulette::Throughput { start: start.unwrap_or(Roulette::FIRST) })
            }
            _ => Err(de::Error::unknown_field(kind, &["fixed", "throughput"])),
        }
    }
}
