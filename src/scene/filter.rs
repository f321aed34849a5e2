//! How a scene file writes pixel filters: by name, `"gaussian"`, or with a width, `{ gaussian = { sigma = 0.4 } }`.
use serde::{
    Deserialize, Deserializer,
    de::{self, MapAccess, Visitor},
};

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
        let filter = match map.next_key::<String>()?.as_deref() {
            Some("tent") => {
                let Tent { radius } = map.next_value()?;
                Filter::Tent { radius }
            }
            Some("gaussian") => {
                let Gaussian { sigma } = map.next_value()?;
                Filter::Gaussian { sigma }
            }
            Some(other) => return Err(de::Error::unknown_field(other, &["tent", "gaussian"])),
            None => return Err(de::Error::invalid_length(0, &self)),
        };
        match map.next_key::<String>()? {
            None => Ok(FilterDesc(filter)),
            Some(second) => Err(de::Error::custom(format!("a second kind of filter, `{second}`: there can be one"))),
        }
    }
}
