//! Elements of XML.
use std::fmt::Write;

use glam::{DAffine3, DMat4, DVec3};

/// An element with its attributes and children.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    tag: &'static str,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Element>,
}

impl Element {
    /// An element without attributes.
    pub fn new(tag: &'static str) -> Element {
        Element { tag, attributes: Vec::new(), children: Vec::new() }
    }

    /// An object of a plugin, such as `<shape type="sphere">`.
    pub fn plugin(tag: &'static str, kind: &str) -> Element {
        Element::new(tag).attribute("type", kind)
    }

    /// A reference to an object, by the name of a parameter or none.
    pub fn reference(name: &str, id: &str) -> Element {
        let reference = Element::new("ref");
        let reference = if name.is_empty() { reference } else { reference.attribute("name", name) };
        reference.attribute("id", id)
    }

    /// A number with a name.
    pub fn number(name: &str, value: f64) -> Element {
        Element::value("float", name, value.to_string())
    }

    /// A colour with a name.
    pub fn color(name: &str, color: [f64; 3]) -> Element {
        Element::value("rgb", name, words(&color))
    }

    fn value(tag: &'static str, name: &str, value: impl Into<String>) -> Element {
        Element::new(tag).attribute("name", name).attribute("value", value)
    }

    pub fn attribute(mut self, name: &'static str, value: impl Into<String>) -> Element {
        self.attributes.push((name, value.into()));
        self
    }

    pub fn with(mut self, child: Element) -> Element {
        self.children.push(child);
        self
    }

    /// Puts a child before the others.
    pub fn before(mut self, child: Element) -> Element {
        self.children.insert(0, child);
        self
    }

    pub fn with_all(mut self, children: impl IntoIterator<Item = Element>) -> Element {
        self.children.extend(children);
        self
    }

    pub fn float(self, name: &str, value: f64) -> Element {
        self.with(Element::number(name, value))
    }

    pub fn integer(self, name: &str, value: i64) -> Element {
        self.with(Element::value("integer", name, value.to_string()))
    }

    pub fn flag(self, name: &str, value: bool) -> Element {
        self.with(Element::value("boolean", name, value.to_string()))
    }

    pub fn text(self, name: &str, value: &str) -> Element {
        self.with(Element::value("string", name, value))
    }

    pub fn point(self, name: &str, point: DVec3) -> Element {
        self.with(Element::value("point", name, words(&point.to_array())))
    }

    pub fn vector(self, name: &str, vector: DVec3) -> Element {
        self.with(Element::value("vector", name, words(&vector.to_array())))
    }

    /// A transform by its matrix; nothing for the identity.
    pub fn transform(self, name: &str, map: &DAffine3) -> Element {
        if *map == DAffine3::IDENTITY {
            return self;
        }
        let rows = DMat4::from(*map).transpose().to_cols_array();
        let matrix = Element::new("matrix").attribute("value", words(&rows));
        self.with(Element::new("transform").attribute("name", name).with(matrix))
    }

    /// Visits the paths of files.
    pub fn for_each_file(&mut self, visit: &mut impl FnMut(&mut String)) {
        if let [("name", name), ("value", path)] = &mut self.attributes[..]
            && self.tag == "string"
            && name.as_str() == FILE
        {
            visit(path);
        }
        self.children.iter_mut().for_each(|child| child.for_each_file(visit));
    }

    /// The element as text, indented by its depth.
    pub fn write(&self, out: &mut String, depth: usize) {
        let indent = "    ".repeat(depth);
        let _ = write!(out, "{indent}<{}", self.tag);
        for (name, value) in &self.attributes {
            let _ = write!(out, " {name}=\"{}\"", escaped(value));
        }
        if self.children.is_empty() {
            out.push_str("/>\n");
            return;
        }
        out.push_str(">\n");
        self.children.iter().for_each(|child| child.write(out, depth + 1));
        let _ = writeln!(out, "{indent}</{}>", self.tag);
    }
}

/// The name of the parameter that holds the path of a file.
pub const FILE: &str = "filename";

/// Numbers with spaces between them.
pub fn words(numbers: &[f64]) -> String {
    // Adding 0 turns −0 into 0.
    numbers.iter().map(|x| (x + 0.0).to_string()).collect::<Vec<_>>().join(" ")
}

/// Text of an attribute. XML has no word for control characters.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c if c.is_control() || c == '\u{fffe}' || c == '\u{ffff}' => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parser_reads_the_same_text() {
        let odd = "a < b & \"c\" > 'd' é";
        let element = Element::plugin("shape", "ply").attribute("id", odd).text(FILE, odd).float("x", -1e-300).float("y", 0.1);
        let mut text = String::new();
        element.write(&mut text, 0);
        let document = roxmltree::Document::parse(&text).expect("it is XML");
        let root = document.root_element();
        assert_eq!(root.attribute("id"), Some(odd));
        let values: Vec<_> = root.children().filter_map(|child| child.attribute("value")).collect();
        assert_eq!((values[0], values[1].parse(), values[2]), (odd, Ok(-1e-300), "0.1"));
    }

    #[test]
    fn paths_of_files_are_visited() {
        let mut scene = Element::new("scene").with(Element::plugin("shape", "ply").text(FILE, "a.ply").text("name", "filename"));
        let mut paths = Vec::new();
        scene.for_each_file(&mut |path| paths.push(std::mem::replace(path, "b.ply".to_owned())));
        let mut text = String::new();
        scene.write(&mut text, 0);
        assert!(paths == ["a.ply"] && text.contains("value=\"b.ply\""), "{paths:?} {text}");
    }
}
