//! Compares values with their ranges.
use super::{Declare, Form, Parameter, Parameters, Path, Problem, Range, Textured, Value, short};

/// Coordinates beyond this are refused: their squares would leave the range of f32.
const FARTHEST: f64 = 1e12;

/// All values of a description that are out of range.
pub fn check(description: &mut dyn Declare) -> Vec<Problem> {
    let mut checker = RangeCheck { path: Path::default(), outer: Vec::new(), problems: Vec::new() };
    description.parameters(&mut checker);
    checker.problems
}

/// The problem of a single value, if it has one. The path of the problem is empty.
pub fn check_value(parameter: &Parameter, value: &Value<'_>) -> Option<Problem> {
    let key = parameter.key;
    let expected = |range: &Range| match range.expected {
        "" => format!("expected a number from {} to {}", short(range.least), short(range.most)),
        expected => expected.to_owned(),
    };
    let out_of_range =
        |wrong: f64, range: &Range| Problem::at("", format!("`{key}` is out of range: {}", short(wrong)), expected(range));
    let number = |wrong: f64, range: &Range| match wrong {
        _ if wrong < 0.0 && range.least >= 0.0 => {
            Problem::at("", format!("`{key}` is negative: {}", short(wrong)), expected(range)).help(parameter.advice)
        }
        _ if wrong.is_nan() => Problem::at("", format!("`{key}` is not a number"), expected(range)),
        _ => out_of_range(wrong, range),
    };
    let colour =
        |rgb: &[f64; 3], range: &Range| rgb.iter().find(|x| !range.contains(**x)).map(|wrong| out_of_range(*wrong, range));
    match value {
        Value::TexturedNumber(Textured::Constant(wrong), range) if !range.contains(*wrong) => Some(number(*wrong, range)),
        Value::Number(wrong, range) if !range.contains(**wrong) && *range == Range::FINITE => {
            let unit = if parameter.unit.is_empty() { String::new() } else { format!(", in {}", parameter.unit) };
            Some(Problem::at("", format!("`{key}` is not a finite number: {wrong}"), format!("expected a number{unit}")))
        }
        Value::Number(wrong, range) if !range.contains(**wrong) => Some(number(**wrong, range)),
        Value::Count(count, range) if !(range.least..=range.most).contains(*count) => {
            let label = format!("expected a whole number from {} to {}", range.least, range.most);
            Some(Problem::at("", format!("`{key}` is out of range: {count}"), label))
        }
        Value::Colour(rgb, range) => colour(rgb, range),
        Value::Textured(Textured::Constant(rgb), range) => colour(rgb, range),
        Value::Point(point) if !point.to_array().iter().all(|x| x.abs() <= FARTHEST) => {
            let label = format!("coordinates must be finite and at most {FARTHEST:e} in magnitude");
            Some(Problem::at("", format!("`{key}` is not a position"), label))
        }
        _ => None,
    }
}

struct RangeCheck {
    path: Path,
    /// Lengths of the paths of the enclosing tables.
    outer: Vec<usize>,
    problems: Vec<Problem>,
}

impl RangeCheck {
    fn descend(&mut self, path: Path) {
        self.outer.push(self.path.0.len());
        self.path = path;
    }
}

impl Parameters for RangeCheck {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        self.problems.extend(check_value(parameter, &value).map(|problem| problem.within(&self.path.key(parameter.key))));
    }

    fn enter(&mut self, parameter: &Parameter, _: Form) {
        self.descend(self.path.key(parameter.key));
    }

    fn reads_outlines(&self) -> bool {
        false
    }

    fn leave(&mut self) {
        self.path.0.truncate(self.outer.pop().unwrap_or(0));
    }

    fn item(&mut self, parameter: &Parameter, index: usize) {
        self.descend(self.path.key(parameter.key).item(index));
    }

    fn named(&mut self, parameter: &Parameter, name: &str) {
        self.descend(self.path.key(parameter.key).key(name));
    }
}
