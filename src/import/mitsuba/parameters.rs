//! Parameters: `$name` in attributes stands for a value from the command line or from a `<default>`.

/// Values of parameters. The first value of a name counts.
#[derive(Clone, Debug, Default)]
pub struct Substitutions(Vec<(String, String)>);

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
    /// Those of the command line.
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
        if name.is_empty() || self.0.iter().any(|(known, _)| known == name) {
            return;
        }
        // The longest names come first: `$size_x` is not `$size` with `_x` behind it.
        let place = self.0.partition_point(|(known, _)| known.len() >= name.len());
        self.0.insert(place, (name.to_owned(), value.to_owned()));
    }

    /// The text with values for parameters.
    pub fn apply(&self, text: &str) -> Result<String, Unsubstituted> {
        let mut result = String::new();
        let mut rest = text;
        while let Some(at) = rest.find('$') {
            let (before, after) = rest.split_at(at);
            let after = &after[1..];
            let Some((name, value)) = self.0.iter().find(|(name, _)| after.starts_with(name.as_str())) else {
                let word = after.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                return Err(Unsubstituted::Undefined(word));
            };
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
