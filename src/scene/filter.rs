//! How a scene file writes pixel filters.
use serde::{
    Deserialize, Deserializer,
    de::{self, MapAccess},
};

use super::named::{self, Named};
use crate::sampling::Filter;

pub struct FilterDesc(pub Filter);

/// What stands behind `tent`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Tent {
    radius: f32,
}

/// What stands behind `gaussian`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Gaussian {
    sigma: f32,
}

impl<'de> Deserialize<'de> for FilterDesc {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        named::deserialize(deserializer).map(FilterDesc)
    }
}

impl Named for Filter {
    const WHAT: &'static str = "filter";
    const EXPECTED: &'static str = "\"box\", \"tent\", \"gaussian\", { tent = { radius = … } } or { gaussian = { sigma = … } }";

    fn of_name<E: de::Error>(name: &str) -> Result<Self, E> {
        match name {
            "box" => Ok(Filter::Box),
            "tent" => Ok(Filter::TENT),
            "gaussian" => Ok(Filter::GAUSSIAN),
            _ => Err(de::Error::unknown_variant(name, &["box", "tent", "gaussian"])),
        }
    }

    fn of_kind<'de, A: MapAccess<'de>>(kind: &str, map: &mut A) -> Result<Self, A::Error> {
        match kind {
            "tent" => map.next_value().map(|Tent { radius }| Filter::Tent { radius }),
            "gaussian" => map.next_value().map(|Gaussian { sigma }| Filter::Gaussian { sigma }),
            _ => Err(de::Error::unknown_field(kind, &["tent", "gaussian"])),
        }
    }
}
