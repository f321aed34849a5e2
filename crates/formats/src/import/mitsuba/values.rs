//! Values of elements: numbers, flags, vectors and lists.
use glam::DVec3;

use super::tree::Element;
use noisefall_scene::scene::SceneError;

/// The words between commas and white space.
pub fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split([' ', ',', '\t', '\n', '\r']).filter(|word| !word.is_empty())
}

impl<'t> Element<'t> {
    /// Its `value` attribute.
    pub fn value(self) -> Result<&'t str, SceneError> {
        let missing = || self.error(format!("{} has no value", self.shown()), "add value=\"…\"");
        self.attribute("value").ok_or_else(missing)
    }

    /// A finite number from a text of this element.
    pub fn parse_number(self, text: &str) -> Result<f64, SceneError> {
        let number = text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        number.ok_or_else(|| self.error(format!("\"{text}\" is not a finite number"), "write a number such as 0.5"))
    }

    /// The numbers of a text of this element.
    pub fn parse_numbers(self, text: &str) -> Result<Vec<f64>, SceneError> {
        words(text).map(|word| self.parse_number(word)).collect()
    }

    /// Three numbers, or one for all three.
    pub fn parse_three(self, text: &str) -> Result<[f64; 3], SceneError> {
        match self.parse_numbers(text)?[..] {
            [x] => Ok([x; 3]),
            [x, y, z] => Ok([x, y, z]),
            _ => Err(self.error(format!("\"{text}\" are not three numbers"), "write one or three numbers")),
        }
    }

    /// The number with this name.
    pub fn number(self, name: &str, default: f64) -> Result<f64, SceneError> {
        Ok(self.optional_number(name)?.unwrap_or(default))
    }

    /// The number with this name, if there is one.
    pub fn optional_number(self, name: &str) -> Result<Option<f64>, SceneError> {
        let Some(property) = self.property(name)? else { return Ok(None) };
        match property.tag() {
            // Other words for a number that are as clear.
            "float" | "integer" | "string" | "spectrum" | "rgb" => property.parse_number(property.value()?).map(Some),
            "boolean" => Ok(Some(f64::from(u8::from(property.parse_flag()?)))),
            tag => Err(property.error(format!("`{name}` is a {tag}, not a number"), "write `<float name=\"…\" value=\"…\"/>`")),
        }
    }

    /// The whole number with this name, if there is one.
    pub fn integer(self, name: &str) -> Result<Option<i64>, SceneError> {
        let Some(property) = self.property(name)? else { return Ok(None) };
        let number = property.parse_number(property.value()?)?;
        if number.fract() != 0.0 || number.abs() > 1e15 {
            return Err(property.error(format!("`{name}` is not a whole number"), "write a whole number"));
        }
        Ok(Some(number as i64))
    }

    /// The flag with this name.
    pub fn flag(self, name: &str, default: bool) -> Result<bool, SceneError> {
        let Some(property) = self.property(name)? else { return Ok(default) };
        property.parse_flag()
    }

    /// Its value as a flag, also one that is written as a number.
    fn parse_flag(self) -> Result<bool, SceneError> {
        let value = self.value()?.trim();
        match (value.to_ascii_lowercase().as_str(), value.parse::<f64>()) {
            ("true", _) | (_, Ok(1.0)) => Ok(true),
            ("false", _) | (_, Ok(0.0)) => Ok(false),
            (other, _) => Err(self.error(format!("\"{other}\" is neither true nor false"), "write true or false")),
        }
    }

    /// The text with this name, if there is one.
    pub fn text(self, name: &str) -> Result<Option<&'t str>, SceneError> {
        self.property(name)?.map(Element::value).transpose()
    }

    /// The text with this name, which is required.
    pub fn required_text(self, name: &str) -> Result<&'t str, SceneError> {
        let missing = || self.error(format!("{} has no `{name}`", self.shown()), format!("add `<string name=\"{name}\" …/>`"));
        self.text(name)?.ok_or_else(missing)
    }

    /// The point or vector with this name, if there is one.
    pub fn vector(self, name: &str) -> Result<Option<DVec3>, SceneError> {
        self.property(name)?.map(|property| property.components(0.0)).transpose()
    }

    /// Its `value` of three numbers, or its `x`, `y` and `z`, each `default` if it is missing.
    pub fn components(self, default: f64) -> Result<DVec3, SceneError> {
        if let Some(value) = self.attribute("value") {
            return self.parse_three(value).map(DVec3::from);
        }
        let component = |name: &str| self.attribute(name).map_or(Ok(default), |text| self.parse_number(text));
        Ok(DVec3::new(component("x")?, component("y")?, component("z")?))
    }
}
