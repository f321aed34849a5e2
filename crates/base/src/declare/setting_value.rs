//! Values of settings as one word: on the command line, in tables, in figures and in the window.
use std::fmt;

use super::value::{Word, Words};
use crate::quote::either;

/// The value of a setting.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Datum {
    /// One of a few words, or a word that holds a number.
    Word(String),
    /// On or off.
    Flag(bool),
    /// A whole number; `None` for none.
    Count(Option<u32>),
}

/// The word on the command line and in tables.
impl fmt::Display for Datum {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Datum::Word(word) => f.write_str(word),
            Datum::Flag(true) => f.write_str("on"),
            Datum::Flag(false) => f.write_str("off"),
            Datum::Count(Some(count)) => write!(f, "{count}"),
            Datum::Count(None) => f.write_str("none"),
        }
    }
}

/// The values that a setting takes.
#[derive(Clone, Debug, PartialEq)]
pub enum Accepted {
    /// One of these words.
    Words(Vec<Word>),
    /// `on` or `off`.
    Flag,
    /// A whole number.
    Count,
    /// A whole number, or `none`.
    OptionalCount,
    /// Other words: descriptions of them.
    Other(Vec<String>),
}

impl Accepted {
    /// Words, or descriptions of them.
    pub fn alternatives(&self) -> Vec<String> {
        match self {
            Accepted::Words(words) => words.iter().map(|word| word.name.to_owned()).collect(),
            Accepted::Flag => vec!["on".to_owned(), "off".to_owned()],
            Accepted::Count => vec![format!("a whole number from 0 to {}", u32::MAX)],
            Accepted::OptionalCount => vec!["a whole number, 0 or more,".to_owned(), "`none`".to_owned()],
            Accepted::Other(words) => words.clone(),
        }
    }
}

/// `a, b or c`, for messages.
impl fmt::Display for Accepted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&either(&self.alternatives()))
    }
}

/// Types of settings.
pub trait SettingValue: Sized {
    /// The values that [`SettingValue::read`] takes.
    fn accepted() -> Accepted;

    /// The value as a word, from which [`SettingValue::read`] makes the same value.
    fn datum(&self) -> Datum;

    /// The value of a word; `None` if there is none.
    fn read(word: &str) -> Option<Self>;
}

impl<T: Words> SettingValue for T {
    fn accepted() -> Accepted {
        Accepted::Words(T::words().iter().map(|(word, _)| *word).collect())
    }

    fn datum(&self) -> Datum {
        let name = T::words().iter().find(|(_, value)| value == self).map_or("", |(word, _)| word.name);
        Datum::Word(name.to_owned())
    }

    fn read(text: &str) -> Option<Self> {
        T::words().iter().find(|(word, _)| word.name == text).map(|(_, value)| *value)
    }
}

impl SettingValue for bool {
    fn accepted() -> Accepted {
        Accepted::Flag
    }

    fn datum(&self) -> Datum {
        Datum::Flag(*self)
    }

    fn read(word: &str) -> Option<Self> {
        match word {
            "on" => Some(true),
            "off" => Some(false),
            _ => None,
        }
    }
}

impl SettingValue for u32 {
    fn accepted() -> Accepted {
        Accepted::Count
    }

    fn datum(&self) -> Datum {
        Datum::Count(Some(*self))
    }

    fn read(word: &str) -> Option<Self> {
        word.parse().ok()
    }
}

impl SettingValue for Option<u32> {
    fn accepted() -> Accepted {
        Accepted::OptionalCount
    }

    fn datum(&self) -> Datum {
        Datum::Count(*self)
    }

    fn read(word: &str) -> Option<Self> {
        if word == "none" { Some(None) } else { word.parse().ok().map(Some) }
    }
}
