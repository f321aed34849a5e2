//! The place of a visitor in a description.
use noisefall_base::declare::Parameter;

/// The name of the texture and of the material that vary.
pub const SUBJECT: &str = "subject";

/// Parameters that no sample depends on, and those that follow from others.
const LEFT_OUT: [&str; 9] = ["format", "title", "notes", "name", "resolution", "fov", "spp", "exposure", "reference"];

/// Whether a parameter stays as it is.
pub fn is_left_out(parameter: &Parameter) -> bool {
    LEFT_OUT.contains(&parameter.key)
}

/// The tables around a visitor, each with its path and whether it stays as it is.
#[derive(Default)]
pub struct Place {
    tables: Vec<(String, bool)>,
}

impl Place {
    /// The path of a parameter in the current table.
    pub fn path_of(&self, key: &str) -> String {
        match self.tables.last() {
            Some((path, _)) => format!("{path}.{key}"),
            None => key.to_owned(),
        }
    }

    /// Whether the current table is the whole description.
    pub fn is_top(&self) -> bool {
        self.tables.is_empty()
    }

    /// Whether the current table stays as it is.
    pub fn is_fixed(&self) -> bool {
        self.tables.last().is_some_and(|(_, fixed)| *fixed)
    }

    /// Whether the current table is within one of these tables of the description.
    pub fn is_within(&self, table: &str) -> bool {
        self.tables.first().is_some_and(|(path, _)| path.split('.').next() == Some(table))
    }

    pub fn enter(&mut self, parameter: &Parameter) {
        self.tables.push((self.path_of(parameter.key), is_left_out(parameter)));
    }

    pub fn enter_item(&mut self, parameter: &Parameter, index: usize, is_fixed: bool) {
        self.tables.push((format!("{}.{index}", self.path_of(parameter.key)), is_fixed));
    }

    pub fn enter_named(&mut self, parameter: &Parameter, name: &str) {
        self.tables.push((format!("{}.{name}", self.path_of(parameter.key)), name != SUBJECT));
    }

    pub fn leave(&mut self) {
        self.tables.pop();
    }
}

/// Items that a list may get: two at the top of the description, as lights, and one elsewhere, as transforms. Lists with items keep them.
pub fn growth(place: &Place, now: usize) -> usize {
    match (now, place.is_top()) {
        (0, true) => 2,
        (0, false) => 1,
        _ => 0,
    }
}
