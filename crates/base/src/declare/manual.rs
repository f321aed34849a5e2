//! Documents a format for people, in Markdown.
use super::{Choice, CountRange, Declare, Form, Parameter, Parameters, Range, Textured, Value, short};

/// A section for each table at the top of `description`, with a row for each parameter in it. Defaults are those of `description`.
pub fn manual(description: &mut dyn Declare) -> String {
    let mut manual = Manual { text: String::new(), path: Vec::new(), is_optional: false };
    manual.heading("The file", "Keys at the top of the file, before the first table.");
    description.parameters(&mut manual);
    manual.text
}

struct Manual {
    text: String,
    /// The tables around.
    path: Vec<String>,
    /// Whether the next value is optional: what it begins with is no default.
    is_optional: bool,
}

impl Manual {
    fn heading(&mut self, title: &str, doc: &str) {
        self.text += &format!("\n## {title}\n\n{doc}\n\n| key | value | meaning |\n|---|---|---|\n");
    }

    fn row(&mut self, parameter: &Parameter, value: &str) {
        let keys: Vec<&str> = self.path.iter().skip(1).map(String::as_str).chain([parameter.key]).collect();
        let symbol = if parameter.symbol.is_empty() { String::new() } else { format!(" *{}*", parameter.symbol) };
        let unit = if parameter.unit.is_empty() { String::new() } else { format!(" ({})", parameter.unit) };
        let without_default = || value.split(';').next().unwrap_or_default().to_owned();
        let is_optional = std::mem::take(&mut self.is_optional);
        let value = match (parameter.is_required, is_optional) {
            (true, _) => format!("{}, required", without_default()),
            (false, true) => without_default(),
            (false, false) => value.to_owned(),
        };
        let value = value.replace('|', "\\|");
        self.text += &format!("| `{}`{symbol} | {value} | {}{unit} |\n", keys.join("."), parameter.doc);
    }

    fn descend(&mut self, parameter: &Parameter, title: &str, is_list: bool) {
        if self.path.is_empty() {
            let doc = if parameter.is_required { format!("{} Required.", parameter.doc) } else { parameter.doc.to_owned() };
            self.heading(title, &doc);
        } else {
            self.row(parameter, if is_list { "list of tables" } else { "table" });
        }
        self.path.push(parameter.key.to_owned());
    }
}

/// Type, range and default of a value.
fn describe(value: &Value) -> String {
    let range = |range: &Range| {
        if *range == Range::FINITE { String::new() } else { format!(", {} to {}", short(range.least), short(range.most)) }
    };
    let grey = |[r, g, b]: &[f64; 3]| {
        if r == g && g == b { short(*r) } else { format!("[{}, {}, {}]", short(*r), short(*g), short(*b)) }
    };
    match value {
        Value::Number(number, within) => format!("number{}; {}", range(within), short(**number)),
        Value::TexturedNumber(Textured::Constant(number), within) => {
            format!("number or `{{ texture = … }}`{}; {}", range(within), short(*number))
        }
        Value::Count(count, CountRange { least, most: u32::MAX }) => format!("whole number, {least} or more; {count}"),
        Value::Count(count, within) => format!("whole number, {} to {}; {count}", within.least, within.most),
        Value::Flag(flag) => format!("true or false; {flag}"),
        Value::Text(_) => "text".to_owned(),
        Value::File(_) => "path relative to the scene".to_owned(),
        Value::Name(_, family) => format!("name of a {family:?}").to_lowercase(),
        Value::Colour(rgb, within) => format!("colour{}; {}", range(within), grey(rgb)),
        Value::Textured(Textured::Constant(rgb), within) => {
            format!("colour or `{{ texture = … }}`{}; {}", range(within), grey(rgb))
        }
        Value::Textured(..) | Value::TexturedNumber(..) => "`{ texture = … }`".to_owned(),
        Value::Point(p) | Value::Vector(p) => format!("[x, y, z]; [{}, {}, {}]", short(p.x), short(p.y), short(p.z)),
        Value::Factors(_) => "[x, y, z] or one number".to_owned(),
        Value::Pair([a, b]) => format!("two numbers; [{}, {}]", short(*a), short(*b)),
        Value::Counts([a, b]) => format!("two whole numbers; [{a}, {b}]"),
        Value::Matrix(_) => "four rows of four numbers".to_owned(),
        Value::Points(_) => "list of [x, y, z]".to_owned(),
        Value::Triangles(_) => "list of [i, j, k]".to_owned(),
        Value::Word(place, words) => {
            let names: Vec<String> = words.iter().map(|word| format!("\"{}\"", word.name)).collect();
            format!("{}; \"{}\"", names.join(" | "), words[**place].name)
        }
    }
}

impl Parameters for Manual {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        self.row(parameter, &describe(&value));
    }

    fn enter(&mut self, parameter: &Parameter, _: Form) {
        self.is_optional = false;
        self.descend(parameter, &format!("`[{}]`", parameter.key), false);
    }

    fn leave(&mut self) {
        self.path.pop();
    }

    fn present(&mut self, _: &Parameter, _: bool) -> bool {
        self.is_optional = true;
        true
    }

    fn choose(&mut self, choice: &Choice, now: usize) -> usize {
        let names: Vec<String> = choice.alternatives.iter().map(|alternative| format!("`{}`", alternative.name)).collect();
        let around: String = self.path.iter().skip(1).map(|key| format!("`{key}`: ")).collect();
        self.text += &format!("| | | {around}one of {} |\n", names.join(", "));
        now
    }

    fn items(&mut self, _: &Parameter, _: usize) -> usize {
        1
    }

    fn item(&mut self, parameter: &Parameter, _: usize) {
        self.descend(parameter, &format!("`[[{}]]`", parameter.key), true);
    }

    fn names(&mut self, _: &Parameter, _: Vec<String>) -> Vec<String> {
        vec!["NAME".to_owned()]
    }

    fn named(&mut self, parameter: &Parameter, name: &str) {
        self.descend(parameter, &format!("`[{}.{name}]`", parameter.key), false);
    }

    fn sees_all(&self) -> bool {
        true
    }
}
