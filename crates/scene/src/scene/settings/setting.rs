//! A setting, whatever its type: what files, options, tables, legends and the window need to know of it.
use super::RenderSettings;
use noisefall_base::declare::{Accepted, Datum, Parameter, Parameters, SettingValue};

/// The effect of a setting on the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Changes {
    /// How the image is estimated. All values converge to the same image.
    Estimate,
    /// The image that it converges to.
    Limit,
    /// The random numbers alone.
    Seed,
}

/// A row of the [table of settings](RenderSettings::TABLE).
#[derive(Clone, Copy)]
pub struct Setting {
    /// Key, title, symbol, sentence and aliases.
    pub parameter: Parameter,
    /// The part of the image that it changes.
    pub changes: Changes,
    /// The option for a list of values. Empty for settings that are never compared.
    pub list: &'static str,
    /// The number that an optional count begins with, and the largest that the window offers.
    pub counts: [u32; 2],
    /// The name before its value in a label; empty where the value says it.
    noun: &'static str,
    /// Whether a label tells it even if it has its default.
    is_always_told: bool,
    words: fn(&RenderSettings) -> String,
    access: Access,
}

/// Access to the value in the settings of a render.
#[derive(Clone, Copy)]
pub(super) struct Access {
    pub accepted: fn() -> Accepted,
    pub datum: fn(&RenderSettings) -> Datum,
    pub read: fn(&mut RenderSettings, &str) -> bool,
    pub copy: fn(&mut RenderSettings, &RenderSettings),
    pub differs: fn(&RenderSettings, &RenderSettings) -> bool,
    pub visit: fn(&Parameter, &mut RenderSettings, &mut dyn Parameters),
}

/// The access to a field. `$visit` visits it as a parameter of a scene file.
macro_rules! access {
    ($field:ident, $visit:expr) => {
        Access {
            accepted: || accepted(|settings: &RenderSettings| &settings.$field),
            datum: |settings| settings.$field.datum(),
            read: |settings, word| SettingValue::read(word).map(|value| settings.$field = value).is_some(),
            copy: |to, from| to.$field = from.$field,
            differs: |a, b| a.$field != b.$field,
            visit: |parameter, settings, p| ($visit)(parameter, &mut settings.$field, p),
        }
    };
}
pub(super) use access;

/// The values of the type of a field.
pub(super) fn accepted<V: SettingValue>(_: fn(&RenderSettings) -> &V) -> Accepted {
    V::accepted()
}

impl Setting {
    /// A setting that changes the estimate, with its value in words.
    pub(super) const fn new(parameter: Parameter, access: Access, words: fn(&RenderSettings) -> String) -> Setting {
        let (changes, list, counts) = (Changes::Estimate, parameter.key, [0, u32::MAX]);
        Setting { parameter, changes, list, counts, noun: "", is_always_told: false, words, access }
    }

    pub(super) const fn changes(self, changes: Changes) -> Setting {
        Setting { changes, ..self }
    }

    pub(super) const fn list(self, list: &'static str) -> Setting {
        Setting { list, ..self }
    }

    pub(super) const fn counts(self, counts: [u32; 2]) -> Setting {
        Setting { counts, ..self }
    }

    pub(super) const fn noun(self, noun: &'static str) -> Setting {
        Setting { noun, ..self }
    }

    pub(super) const fn always_told(self) -> Setting {
        Setting { is_always_told: true, ..self }
    }

    /// Its name in files, tables, figures and Python.
    pub const fn key(&self) -> &'static str {
        self.parameter.key
    }

    /// Its option on the command line, without dashes.
    pub fn option(&self) -> String {
        self.key().replace('_', "-")
    }

    /// Its label in the window.
    pub fn label(&self) -> String {
        self.parameter.label()
    }

    /// Its name within a sentence.
    pub fn name(&self) -> String {
        self.label().to_lowercase()
    }

    /// The values that it takes.
    pub fn accepted(&self) -> Accepted {
        (self.access.accepted)()
    }

    /// Its value.
    pub fn datum(&self, settings: &RenderSettings) -> Datum {
        (self.access.datum)(settings)
    }

    /// Its value as a word of the command line.
    pub fn value(&self, settings: &RenderSettings) -> String {
        self.datum(settings).to_string()
    }

    /// Its value in the words of the window.
    pub fn words(&self, settings: &RenderSettings) -> String {
        (self.words)(settings)
    }

    /// Its value in a label, with its name if the value alone is ambiguous.
    pub fn labelled_value(&self, settings: &RenderSettings) -> String {
        match self.datum(settings) {
            Datum::Count(None) => format!("no {}", self.noun),
            datum if self.noun.is_empty() => datum.to_string(),
            datum => format!("{} {datum}", self.noun),
        }
    }

    /// Whether a label of these settings alone tells it: it says how light is estimated, or differs from the default.
    pub fn is_told(&self, settings: &RenderSettings) -> bool {
        self.is_always_told || self.changes != Changes::Seed && self.differs(settings, &RenderSettings::default())
    }

    /// Gives it the value of a word. The error says which words there are.
    pub fn read(&self, settings: &mut RenderSettings, word: &str) -> Result<(), String> {
        (self.access.read)(settings, word).then_some(()).ok_or_else(|| format!("expected {}", self.accepted()))
    }

    /// `settings` with its value in `from`.
    pub fn with(&self, settings: &RenderSettings, from: &RenderSettings) -> RenderSettings {
        let mut changed = *settings;
        (self.access.copy)(&mut changed, from);
        changed
    }

    /// Whether two settings have different values of it.
    pub fn differs(&self, a: &RenderSettings, b: &RenderSettings) -> bool {
        (self.access.differs)(a, b)
    }

    /// Visits it as a parameter of a scene file.
    pub fn visit(&self, settings: &mut RenderSettings, p: &mut dyn Parameters) {
        (self.access.visit)(&self.parameter, settings, p);
    }
}

/// There is one setting for each key.
impl PartialEq for Setting {
    fn eq(&self, other: &Setting) -> bool {
        self.key() == other.key()
    }
}

impl std::fmt::Debug for Setting {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.key())
    }
}
