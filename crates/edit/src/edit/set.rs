//! Sets a value.
use super::walk::{Walk, follows_walk};
use noisefall_base::declare::{Declare, OwnedValue, Parameter, Parameters, Path, Value};

/// State of a path before a value was set.
pub enum PreviousValue {
    /// The value.
    Present(OwnedValue),
    /// The value itself, or the table at this path above it, was absent and has been added.
    Absent(Path),
}

/// Why a value cannot be set. Nothing is changed then, but absent tables may have been added.
pub enum Failure {
    /// There is no such value.
    Missing,
    /// The value is of another type.
    Type,
}

/// Sets the value at a path. Reports the table that was added on the way, even on failure.
pub fn set(description: &mut dyn Declare, path: &Path, value: &OwnedValue) -> (Result<PreviousValue, Failure>, Option<Path>) {
    let mut setter = Setter { walk: Walk::to(path), value, appeared: None, outcome: Err(Failure::Missing) };
    description.parameters(&mut setter);
    let Setter { appeared, outcome, .. } = setter;
    let found = outcome.map(|was| appeared.clone().map_or(PreviousValue::Present(was), PreviousValue::Absent));
    (found, appeared)
}

struct Setter<'p> {
    walk: Walk<'p>,
    value: &'p OwnedValue,
    appeared: Option<Path>,
    outcome: Result<OwnedValue, Failure>,
}

impl Parameters for Setter<'_> {
    fn value(&mut self, parameter: &Parameter, mut value: Value<'_>) {
        if self.walk.is_at(parameter.key) {
            let was = OwnedValue::of(&value);
            self.outcome = if self.value.assign(&mut value) { Ok(was) } else { Err(Failure::Type) };
        }
    }

    follows_walk!();

    fn present(&mut self, parameter: &Parameter, now: bool) -> bool {
        let appears = !now && self.walk.leads_through(parameter.key);
        if appears && self.appeared.is_none() {
            self.appeared = Some(self.walk.path_of(parameter.key));
        }
        now || appears
    }
}
