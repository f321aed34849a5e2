//! Description of a parameter: words and ranges.

/// A parameter as a scene file and a person know it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Its name in scene files.
    pub key: &'static str,
    /// One sentence that describes it.
    pub doc: &'static str,
    /// Its symbol in the equations; may be empty.
    pub symbol: &'static str,
    /// Its unit; may be empty.
    pub unit: &'static str,
    /// Whether a scene file must give it.
    pub is_required: bool,
    /// Names in other renderers, separated by spaces; the reader suggests the key for them.
    pub aliases: &'static str,
    /// Its title in the window; may be empty: see [`Parameter::label`].
    pub title: &'static str,
    /// Advice for those who use an alias or a value of a wrong type.
    pub advice: &'static str,
    /// Its meaning, if kinds have it under different keys.
    pub meaning: Option<Meaning>,
}

/// The meaning of a parameter that kinds have under different keys. A change of kind keeps its value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// The colour of a surface in white light, such as its albedo.
    Colour,
    /// The square root of the width α of the microfacet slopes.
    Roughness,
    /// The width α of the microfacet slopes.
    SlopeWidth,
    /// The index of refraction behind a surface.
    IndexOfRefraction,
}

impl Parameter {
    /// A parameter with its key and its sentence.
    pub const fn new(key: &'static str, doc: &'static str) -> Parameter {
        Parameter { key, doc, symbol: "", unit: "", is_required: false, aliases: "", title: "", advice: "", meaning: None }
    }

    /// Makes the parameter required in scene files.
    pub const fn required(self) -> Parameter {
        Parameter { is_required: true, ..self }
    }

    /// Sets the symbol.
    pub const fn symbol(self, symbol: &'static str) -> Parameter {
        Parameter { symbol, ..self }
    }

    /// Sets the unit.
    pub const fn unit(self, unit: &'static str) -> Parameter {
        Parameter { unit, ..self }
    }

    /// Sets the aliases, separated by spaces.
    pub const fn aliases(self, aliases: &'static str) -> Parameter {
        Parameter { aliases, ..self }
    }

    /// Sets the title.
    pub const fn title(self, title: &'static str) -> Parameter {
        Parameter { title, ..self }
    }

    /// Sets the advice.
    pub const fn advice(self, advice: &'static str) -> Parameter {
        Parameter { advice, ..self }
    }

    /// Sets the meaning.
    pub const fn means(self, meaning: Meaning) -> Parameter {
        Parameter { meaning: Some(meaning), ..self }
    }

    /// Whether a value of one parameter is one of the other: they have the same declared meaning, or else the same key and symbol.
    pub fn means_same(&self, other: &Parameter) -> bool {
        match (self.meaning, other.meaning) {
            (None, None) => (self.key, self.symbol) == (other.key, other.symbol),
            (one, another) => one == another,
        }
    }

    /// Its label in the window: the title, or else the key in words.
    pub fn label(&self) -> String {
        if !self.title.is_empty() {
            return self.title.to_owned();
        }
        capitalised(&key_in_words(self.key))
    }

    /// Whether a word is another renderer's name for this parameter.
    pub fn is_alias(&self, word: &str) -> bool {
        self.aliases.split(' ').any(|alias| alias == word)
    }
}

/// A key of scene files in the words and the spelling of the window: "base_color" is "base colour".
pub fn key_in_words(key: &str) -> String {
    let word = |word| match word {
        "ior" => "IOR",
        "color" => "colour",
        "center" => "centre",
        other => other,
    };
    key.split('_').map(word).collect::<Vec<_>>().join(" ")
}

/// Capitalises the first letter, for a title or the beginning of a sentence.
pub fn capitalised(clause: &str) -> String {
    let first = clause.chars().next().map_or(0, char::len_utf8);
    clause[..first].to_uppercase() + &clause[first..]
}

/// A closed range of numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The smallest number.
    pub least: f64,
    /// The largest number.
    pub most: f64,
    /// Scale of a slider over the range.
    pub scale: SliderScale,
    /// The expectation that a message states if the ends alone would not explain it; may be empty.
    pub expected: &'static str,
}

/// Scale of a slider.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SliderScale {
    /// In proportion.
    Linear,
    /// By powers of ten.
    Log,
}

impl Range {
    /// Parts: reflectances, transmittances, roughness.
    pub const UNIT: Range = Range::linear(0.0, 1.0);
    /// Reflectances, channel by channel.
    pub const REFLECTANCE: Range =
        Range::UNIT.expected("every channel must lie in [0, 1]: a surface cannot reflect more light than it receives");
    /// Roughness and α.
    pub const ROUGHNESS: Range = Range::UNIT.expected("expected a number from 0 to 1");
    /// W·sr⁻¹·m⁻², channel by channel.
    pub const RADIANCE: Range = Range::log(0.0, 1e15).expected("every channel must be a number from 0 to 1e15");
    /// Refractive indices of transparent media.
    pub const INDEX: Range = Range::linear(0.05, 20.0);
    /// Metres.
    pub const LENGTH: Range = Range::log(1e-12, 1e12);
    /// Any finite number.
    pub const FINITE: Range = Range::linear(f64::MIN, f64::MAX);

    /// A range with a linear scale.
    pub const fn linear(least: f64, most: f64) -> Range {
        Range { least, most, scale: SliderScale::Linear, expected: "" }
    }

    /// A range with a logarithmic scale.
    pub const fn log(least: f64, most: f64) -> Range {
        Range { least, most, scale: SliderScale::Log, expected: "" }
    }

    /// Sets the expectation that messages state.
    pub const fn expected(self, expected: &'static str) -> Range {
        Range { expected, ..self }
    }

    /// False for NaN.
    pub fn contains(&self, x: f64) -> bool {
        (self.least..=self.most).contains(&x)
    }
}

/// A closed range of whole numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CountRange {
    /// The smallest number.
    pub least: u32,
    /// The largest number.
    pub most: u32,
}

impl CountRange {
    /// Any whole number of 32 bits.
    pub const ANY: CountRange = CountRange { least: 0, most: u32::MAX };

    /// The range from `least` to `most`.
    pub const fn new(least: u32, most: u32) -> CountRange {
        CountRange { least, most }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_of_one_key_mean_the_same_unless_symbol_or_declaration_differ() {
        const T: Parameter = Parameter::new("transmittance", "").symbol("T").unit("m⁻¹");
        assert!(T.means_same(&T.required().title("Tint")));
        assert!(!T.means_same(&T.symbol("τ")) && !T.means_same(&Parameter { key: "tint", ..T }));
        let albedo = Parameter::new("albedo", "").means(Meaning::Colour);
        assert!(albedo.means_same(&Parameter::new("f0", "").symbol("F₀").means(Meaning::Colour)));
        assert!(!albedo.means_same(&Parameter::new("albedo", "")) && !albedo.means_same(&albedo.means(Meaning::Roughness)));
    }

    #[test]
    fn a_sentence_begins_with_a_capital() {
        assert_eq!(["über allem", "", "A"].map(capitalised), ["Über allem", "", "A"]);
    }
}
