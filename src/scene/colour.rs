//! How a scene file writes colours.
use serde::{
    Deserialize, Deserializer,
    de::{self, IgnoredAny, MapAccess, SeqAccess, Visitor},
};
use toml::Spanned;

/// A colour: `[r, g, b]`, one number for grey, or the name of a texture.
pub enum Colour {
    Rgb([f64; 3]),
    /// `{ texture = "…" }`: the name of a texture.
    Texture(Spanned<String>),
}

impl<'de> Deserialize<'de> for Colour {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ColourVisitor)
    }
}

struct ColourVisitor;

impl<'de> Visitor<'de> for ColourVisitor {
    type Value = Colour;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a colour: [red, green, blue], or one number for grey")
    }
    fn visit_f64<E: de::Error>(self, grey: f64) -> Result<Colour, E> {
        Ok(Colour::Rgb([grey; 3]))
    }
    fn visit_i64<E: de::Error>(self, grey: i64) -> Result<Colour, E> {
        self.visit_f64(grey as f64)
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Colour, A::Error> {
        let mut rgb = [0.0; 3];
        for (i, channel) in rgb.iter_mut().enumerate() {
            *channel = seq.next_element()?.ok_or_else(|| de::Error::invalid_length(i, &self))?;
        }
        match seq.next_element::<IgnoredAny>()? {
            None => Ok(Colour::Rgb(rgb)),
            Some(_) => Err(de::Error::invalid_length(4, &self)),
        }
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Colour, A::Error> {
        let mut name = None;
        while let Some(key) = map.next_key::<String>()? {
            if key != "texture" {
                return Err(de::Error::unknown_field(&key, &["texture"]));
            }
            name = Some(map.next_value()?);
        }
        name.map(Colour::Texture).ok_or_else(|| de::Error::missing_field("texture"))
    }
}
