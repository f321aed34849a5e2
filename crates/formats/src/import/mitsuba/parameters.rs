//! Parameters: `$name` in attributes stands for a value from the command line or from a `<default>`.
use std::cell::Cell;

/// Values of parameters. The first value of a name counts.
#[derive(Clone, Debug, Default)]
pub struct Substitutions(Vec<Parameter>);

#[derive(Clone, Debug)]
struct Parameter {
    name: String,
    value: String,
    /// Whether the scene has it.
    is_used: Cell<bool>,
}

/// Longer values are refused: defaults that name each other could double again and again.
const LONGEST: usize = 1 << 16;

/// Why an attribute has no value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unsubstituted {
    /// Nothing defines the parameter.
    Undefined(String),
    /// The value is too long.
    TooLong,
}

impl Substitutions {
    /// Starts with the definitions of the command line.
    pub fn new(defines: &[(String, String)]) -> Substitutions {
        let mut all = Substitutions::default();
        defines.iter().for_each(|(name, value)| all.add(name, value));
        all
    }

    /// Number of names.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Adds a value unless the name has one.
    pub fn add(&mut self, name: &str, value: &str) {
        let known = self.0.iter().find(|parameter| parameter.name == name);
        known.iter().for_each(|parameter| parameter.is_used.set(true));
        if name.is_empty() || known.is_some() {
            return;
        }
        // The longest names come first: `$size_x` is not `$size` with `_x` behind it.
        let place = self.0.partition_point(|known| known.name.len() >= name.len());
        self.0.insert(place, Parameter { name: name.to_owned(), value: value.to_owned(), is_used: Cell::new(false) });
    }

    /// Whether nothing in the scene uses a parameter.
    pub fn is_unused(&self, name: &str) -> bool {
        self.0.iter().any(|parameter| parameter.name == name && !parameter.is_used.get())
    }

    /// The text with values for parameters.
    pub fn apply(&self, text: &str) -> Result<String, Unsubstituted> {
        let mut result = String::new();
        let mut rest = text;
        while let Some(at) = rest.find('$') {
            let (before, after) = rest.split_at(at);
            let after = &after[1..];
            let Some(Parameter { name, value, is_used }) = self.0.iter().find(|known| after.starts_with(&known.name)) else {
                let word = after.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                return Err(Unsubstituted::Undefined(word));
            };
            is_used.set(true);
            result += before;
            result += value;
            rest = &after[name.len()..];
            if result.len() > LONGEST {
                return Err(Unsubstituted::TooLong);
            }
        }
        result += rest;
        Ok(result)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_name_counts_and_the_first_value() {
        let mut all = Substitutions::new(&[("spp".into(), "16".into())]);
        all.add("spp", "128");
        all.add("size", "4");
        all.add("size_x", "8");
        assert_eq!(all.apply("$spp"), Ok("16".to_owned()));
        assert_eq!(all.apply("a $size, $size_x."), Ok("a 4, 8.".to_owned()));
        all.add("sizes", "1");
        assert_eq!(["size", "size_x", "sizes"].map(|name| all.is_unused(name)), [false, false, true]);
        assert_eq!(all.apply("$width px"), Err(Unsubstituted::Undefined("width".to_owned())));
    }

    #[test]
    fn values_are_not_expanded_again_and_do_not_explode() {
        let mut all = Substitutions::default();
        all.add("a", "$b");
        all.add("long", &"x".repeat(1 << 12));
        assert_eq!(all.apply("$a"), Ok("$b".to_owned()));
        assert_eq!(all.apply(&"$long".repeat(100)), Err(Unsubstituted::TooLong));
    }
}
