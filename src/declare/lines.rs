//! The values of a description as lines of text, for people.
use super::{Parameter, Parameters, Textured, Value, short};

/// A line for every value that `declaration` visits: symbol or key, value, unit.
pub fn lines_of(declaration: impl FnOnce(&mut dyn Parameters)) -> Vec<String> {
    let mut lines = Lines(Vec::new());
    declaration(&mut lines);
    lines.0
}

struct Lines(Vec<String>);

impl Parameters for Lines {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        let value = match value {
            Value::Number(&mut number, _) | Value::TexturedNumber(&mut Textured::Constant(number), _) => short(number),
            Value::Count(count, _) => count.to_string(),
            Value::Flag(flag) => (if *flag { "yes" } else { "no" }).to_owned(),
            Value::Text(text) | Value::File(text) | Value::Name(text, _) => text.clone(),
            Value::Colour(rgb, _) | Value::Textured(Textured::Constant(rgb), _) => colour(rgb),
            Value::Textured(Textured::Texture(name), _) | Value::TexturedNumber(Textured::Texture(name), _) => {
                format!("by texture `{name}`")
            }
            Value::Point(v) | Value::Vector(v) | Value::Factors(v) => format!("{} {} {}", short(v.x), short(v.y), short(v.z)),
            Value::Pair(pair) => format!("{} {}", short(pair[0]), short(pair[1])),
            Value::Counts(counts) => format!("{} {}", counts[0], counts[1]),
            Value::Matrix(_) => "a matrix".to_owned(),
            Value::Points(points) => format!("{} points", points.len()),
            Value::Triangles(triangles) => triangles.len().to_string(),
            Value::Word(place, words) => words[*place].name.to_owned(),
        };
        let name = parameter.key.replace('_', " ");
        let symbol = if parameter.symbol.is_empty() { String::new() } else { format!(" {}", parameter.symbol) };
        let unit = if parameter.unit.is_empty() { String::new() } else { format!(" {}", parameter.unit) };
        self.0.push(format!("{name}{symbol}: {value}{unit}"));
    }
}

fn colour([r, g, b]: &[f64; 3]) -> String {
    if r == g && g == b { short(*r) } else { format!("{} {} {}", short(*r), short(*g), short(*b)) }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::{super::CountRange, *};

    #[test]
    fn values_keep_the_order_of_their_parts() {
        const SHUTTER: Parameter = Parameter::new("open_time", "When it is open.").symbol("t").unit("s");
        let line = |value: Value<'_>| lines_of(|p| p.value(&SHUTTER, value));
        for (value, text) in [
            (Value::Pair(&mut [0.25, 1.5]), "0.25 1.5"),
            (Value::Counts(&mut [3, 4]), "3 4"),
            (Value::Point(&mut DVec3::new(1.0, 2.0, 3.0)), "1 2 3"),
            (Value::Count(&mut 7, CountRange::ANY), "7"),
            (Value::Flag(&mut true), "yes"),
        ] {
            assert_eq!(line(value), [format!("open time t: {text} s")]);
        }
    }
}
