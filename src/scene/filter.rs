//! How a scene file writes pixel filters: by name, `"gaussian"`, or with a width, `{ gaussian = { sigma = 0.4 } }`.
use serde::{
    Deserialize, Deserializer,
    de::{self, MapAccess, Visitor},
};

use crate::sampling::Filter;

pub struct FilterDesc(pub Filter);

/// The forms with a width.
#[derive(Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
enum Wide {
    Tent { radius: f32 },
    Gaussian { sigma: f32 },
}

impl<'de> Deserialize<'de> for FilterDesc {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(FilterVisitor)
    }
}

struct FilterVisitor;

impl<'de> Visitor<'de> for FilterVisitor {
    type Value = FilterDesc;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("\"box\", \"tent\", \"gaussian\", { tent = { radius = … } } or { gaussian = { sigma = … } }")
    }
    fn visit_str<E: de::Error>(self, name: &str) -> Result<FilterDesc, E> {
        match name {
            "box" => Ok(FilterDesc(Filter::Box)),
            "tent" => Ok(FilterDesc(Filter::TENT)),
            "gaussian" => Ok(FilterDesc(Filter::GAUSSIAN)),
            _ => Err(de::Error::unknown_variant(name, &["box", "tent", "gaussian"])),
        }
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<FilterDesc, A::Error> {
        let filter = match Wide::deserialize(de::value::MapAccessDeserializer::new(&mut map))? {
            Wide::Tent { radius } => Filter::Tent { radius },
            Wide::Gaussian { sigma } => Filter::Gaussian { sigma },
        };
        match map.next_key::<String>()? {
            None => Ok(FilterDesc(filter)),
            Some(second) => Err(de::Error::custom(format!("a second kind of filter, `{second}`: there can be one"))),
        }
    }
}
