//! Documents a format for editors: as a JSON Schema.
use serde_json::{Map, Value as Json, json};

use super::{Choice, Declare, Form, Parameter, Parameters, Range, Value};

/// The JSON Schema (draft 2020-12) of what `description` declares.
pub fn schema(title: &str, description: &mut dyn Declare) -> Json {
    let mut schema = Schema { tables: vec![Table::new(None)] };
    description.parameters(&mut schema);
    let table = schema.tables.pop().unwrap_or_else(|| Table::new(None));
    let mut json = table.into_json();
    json["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    json["title"] = json!(title);
    json
}

struct Schema {
    tables: Vec<Table>,
}

/// A table while its keys are collected.
struct Table {
    parameter: Option<Parameter>,
    shape: Shape,
    keys: Map<String, Json>,
    required: Vec<&'static str>,
    /// The keys that each alternative of its choices needs.
    choices: Vec<Vec<Vec<&'static str>>>,
    in_choice: bool,
}

/// The container of a table.
#[derive(Clone, PartialEq)]
enum Shape {
    Table,
    /// The table or one of these names.
    Named(Vec<&'static str>),
    List,
    /// A table of tables by name.
    ByName,
}

impl Table {
    fn new(parameter: Option<&Parameter>) -> Table {
        Table {
            parameter: parameter.copied(),
            shape: Shape::Table,
            keys: Map::new(),
            required: Vec::new(),
            choices: Vec::new(),
            in_choice: false,
        }
    }

    fn add(&mut self, parameter: &Parameter, mut json: Json) {
        let unit = if parameter.unit.is_empty() { String::new() } else { format!(" ({})", parameter.unit) };
        json["description"] = json!(format!("{}{unit}", parameter.doc));
        match self.keys.get_mut(parameter.key) {
            // Alternatives that share a key.
            Some(known) if *known != json => *known = json!({ "anyOf": [known.clone(), json] }),
            _ => {
                self.keys.insert(parameter.key.to_owned(), json);
            }
        }
        if parameter.is_required {
            match self.choices.last_mut().and_then(|alternatives| alternatives.last_mut()).filter(|_| self.in_choice) {
                Some(alternative) => alternative.push(parameter.key),
                None => self.required.push(parameter.key),
            }
        }
    }

    fn into_json(self) -> Json {
        let mut json = json!({ "type": "object", "properties": self.keys, "additionalProperties": false });
        if !self.required.is_empty() {
            json["required"] = json!(self.required);
        }
        let one_of = |alternatives: &Vec<Vec<&'static str>>| {
            let needed: Vec<Json> = alternatives.iter().map(|keys| json!({ "required": keys })).collect();
            json!({ "oneOf": needed })
        };
        let strict: Vec<Json> =
            self.choices.iter().filter(|alternatives| alternatives.iter().all(|keys| !keys.is_empty())).map(one_of).collect();
        if !strict.is_empty() {
            json["allOf"] = json!(strict);
        }
        json
    }
}

impl Schema {
    fn table(&mut self) -> &mut Table {
        self.tables.last_mut().expect("the whole file is around")
    }
}

fn number(range: &Range) -> Json {
    if *range == Range::FINITE {
        json!({ "type": "number" })
    } else {
        json!({ "type": "number", "minimum": range.least, "maximum": range.most })
    }
}

fn list(items: &Json, count: usize) -> Json {
    json!({ "type": "array", "items": items, "minItems": count, "maxItems": count })
}

fn colour(range: &Range) -> Vec<Json> {
    vec![list(&number(range), 3), number(range)]
}

fn texture() -> Json {
    let name = json!({ "texture": { "type": "string" } });
    json!({ "type": "object", "properties": name, "required": ["texture"], "additionalProperties": false })
}

fn describe(value: &Value) -> Json {
    let numbers = json!({ "type": "number" });
    let whole = json!({ "type": "integer", "minimum": 0 });
    match value {
        Value::Number(_, range) => number(range),
        Value::TexturedNumber(_, range) => json!({ "anyOf": [number(range), texture()] }),
        Value::Count(_, range) => json!({ "type": "integer", "minimum": range.least, "maximum": range.most }),
        Value::Flag(_) => json!({ "type": "boolean" }),
        Value::Text(_) | Value::File(_) | Value::Name(..) => json!({ "type": "string" }),
        Value::Colour(_, range) => json!({ "anyOf": colour(range) }),
        Value::Textured(_, range) => {
            let mut forms = colour(range);
            forms.push(texture());
            json!({ "anyOf": forms })
        }
        Value::Point(_) | Value::Vector(_) => list(&numbers, 3),
        Value::Factors(_) => json!({ "anyOf": [list(&numbers, 3), numbers] }),
        Value::Pair(_) => list(&numbers, 2),
        Value::Counts(_) => list(&whole, 2),
        Value::Matrix(_) => list(&list(&numbers, 4), 4),
        Value::Points(_) => json!({ "type": "array", "items": list(&numbers, 3) }),
        Value::Triangles(_) => json!({ "type": "array", "items": list(&whole, 3) }),
        Value::Word(_, words) => json!({ "enum": words.iter().map(|word| word.name).collect::<Vec<_>>() }),
    }
}

impl Parameters for Schema {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        let json = describe(&value);
        self.table().add(parameter, json);
    }

    fn enter(&mut self, parameter: &Parameter, form: Form) {
        let shape = if form == Form::NameOrTable { Shape::Named(Vec::new()) } else { Shape::Table };
        self.tables.push(Table { shape, ..Table::new(Some(parameter)) });
    }

    fn leave(&mut self) {
        let Some(table) = self.tables.pop() else { return };
        let (parameter, shape) = (table.parameter, table.shape.clone());
        let json = table.into_json();
        let json = match shape {
            Shape::Table => json,
            Shape::Named(names) => json!({ "anyOf": [{ "enum": names }, json] }),
            Shape::List => json!({ "type": "array", "items": json }),
            Shape::ByName => json!({ "type": "object", "additionalProperties": json }),
        };
        if let Some(parameter) = parameter {
            self.table().add(&parameter, json);
        }
    }

    fn present(&mut self, _: &Parameter, _: bool) -> bool {
        true
    }

    fn choose(&mut self, choice: &Choice, now: usize) -> usize {
        let takes_name = |outline: &super::Outline| !outline.iter().any(|entry| entry.parameter.is_required);
        let names = choice.alternatives.iter().filter(|alternative| takes_name(&alternative.outline));
        if let Shape::Named(known) = &mut self.table().shape {
            known.extend(names.map(|alternative| alternative.name));
        }
        self.table().choices.push(Vec::new());
        now
    }

    fn items(&mut self, _: &Parameter, _: usize) -> usize {
        1
    }

    fn item(&mut self, parameter: &Parameter, _: usize) {
        self.tables.push(Table { shape: Shape::List, ..Table::new(Some(parameter)) });
    }

    fn names(&mut self, _: &Parameter, _: Vec<String>) -> Vec<String> {
        vec!["NAME".to_owned()]
    }

    fn named(&mut self, parameter: &Parameter, _: &str) {
        self.tables.push(Table { shape: Shape::ByName, ..Table::new(Some(parameter)) });
    }

    fn sees_all(&self) -> bool {
        true
    }

    fn alternative(&mut self, name: Option<&'static str>) {
        let table = self.table();
        table.in_choice = name.is_some();
        if let (Some(_), Some(alternatives)) = (name, table.choices.last_mut()) {
            alternatives.push(Vec::new());
        }
    }
}
