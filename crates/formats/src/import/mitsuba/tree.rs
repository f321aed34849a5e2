//! The elements of a scene after parameters and includes, and the objects that they refer to.
use std::{cell::Cell, collections::HashMap, ops::Range};

use noisefall_scene::scene::{SceneError, SourceText};

/// All elements of a scene.
#[derive(Default)]
pub struct Tree {
    pub nodes: Vec<Node>,
    /// The scene file, and those that it includes.
    files: Vec<SourceText>,
    /// Ends of their lines, bytes.
    lines: Vec<Vec<usize>>,
    /// Elements by their `id`.
    pub ids: HashMap<String, usize>,
    /// Further names of ids.
    pub aliases: HashMap<String, String>,
}

/// An element.
pub struct Node {
    pub tag: String,
    pub attributes: Vec<(String, String)>,
    pub children: Vec<usize>,
    pub place: FileSpan,
    /// Whether its file is of version 0.6.
    pub is_old: bool,
    /// Whether the translation has read it.
    pub seen: Cell<bool>,
}

/// Bytes of a file.
#[derive(Clone)]
pub struct FileSpan {
    pub file: usize,
    pub span: Range<usize>,
}

/// An element, as the translation reads it.
#[derive(Clone, Copy)]
pub struct Element<'t> {
    tree: &'t Tree,
    /// Its number.
    pub index: usize,
}

/// Columns that are counted in a line.
const MOST_COLUMNS: usize = 4096;
/// Longer chains of aliases are circles.
const MOST_ALIASES: usize = 64;

impl Tree {
    /// Adds a file, and returns its number.
    pub fn add_file(&mut self, source: SourceText) -> usize {
        self.lines.push(source.text.match_indices('\n').map(|(end, _)| end).collect());
        self.files.push(source);
        self.files.len() - 1
    }

    /// The first element.
    pub fn root(&self) -> Element<'_> {
        Element { tree: self, index: 0 }
    }

    /// An error at a place.
    pub fn error(&self, place: &FileSpan, message: impl Into<String>, help: impl Into<String>) -> SceneError {
        self.files[place.file].error(place.span.clone(), message, "here").with_help(help)
    }

    fn target(&self, id: &str) -> Option<usize> {
        let mut id = id;
        for _ in 0..MOST_ALIASES {
            match self.aliases.get(id) {
                Some(next) => id = next,
                None => return self.ids.get(id).copied(),
            }
        }
        None
    }
}

impl<'t> Element<'t> {
    fn node(self) -> &'t Node {
        &self.tree.nodes[self.index]
    }

    /// Its tag, such as `bsdf`.
    pub fn tag(self) -> &'t str {
        &self.node().tag
    }

    /// An attribute.
    pub fn attribute(self, name: &str) -> Option<&'t str> {
        self.node().attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }

    /// Its type, such as `dielectric`.
    pub fn kind(self) -> &'t str {
        self.attribute("type").unwrap_or_default()
    }

    /// Whether its file is of Mitsuba 0.6, whose defaults are others.
    pub fn is_old(self) -> bool {
        self.node().is_old
    }

    /// Its `id`, or else its type.
    pub fn label(self) -> &'t str {
        self.attribute("id").filter(|id| !id.is_empty()).unwrap_or(self.kind())
    }

    /// Marks it as read. What nothing reads is reported.
    pub fn see(self) -> Element<'t> {
        self.node().seen.set(true);
        self
    }

    /// Whether the translation has read it.
    pub fn is_seen(self) -> bool {
        self.node().seen.get()
    }

    /// The elements within it, as they stand.
    pub fn children(self) -> impl Iterator<Item = Element<'t>> {
        self.node().children.iter().map(move |index| Element { tree: self.tree, index: *index })
    }

    /// The element that it refers to, if it is a reference, or else itself.
    pub fn resolved(self) -> Result<Element<'t>, SceneError> {
        if self.tag() != "ref" {
            return Ok(self);
        }
        self.see();
        let id = self.attribute("id").unwrap_or_default();
        match self.tree.target(id) {
            Some(index) => Ok(Element { tree: self.tree, index }),
            None => Err(self.error(format!("nothing has the id \"{id}\""), "define it in the scene or in an included file")),
        }
    }

    /// The objects within it that have one of these tags, references resolved, each with the name of its role.
    pub fn objects(self, tags: &[&str]) -> Result<Vec<(&'t str, Element<'t>)>, SceneError> {
        let mut found = Vec::new();
        for child in self.children() {
            let object = child.resolved()?;
            if tags.contains(&object.tag()) {
                child.see();
                found.push((child.attribute("name").unwrap_or_default(), object.see()));
            }
        }
        Ok(found)
    }

    /// The value or object with this name. The last one counts.
    pub fn property(self, name: &str) -> Result<Option<Element<'t>>, SceneError> {
        let mut found = None;
        for child in self.children().filter(|child| child.attribute("name") == Some(name)) {
            found = Some(child.see().resolved()?.see());
        }
        Ok(found)
    }

    /// Whether it has a value or an object with this name.
    pub fn has(self, name: &str) -> bool {
        self.children().any(|child| child.attribute("name") == Some(name))
    }

    /// Marks values that do not change the image as read.
    pub fn ignore(self, names: &[&str]) {
        self.children().filter(|child| child.attribute("name").is_some_and(|name| names.contains(&name))).for_each(|child| {
            child.see();
        });
    }

    /// Where it stands, for remarks: `scene.xml:12:5`.
    pub fn place(self) -> String {
        let FileSpan { file, span } = &self.node().place;
        let (source, ends) = (&self.tree.files[*file], &self.tree.lines[*file]);
        let line = ends.partition_point(|end| *end < span.start);
        let start = line.checked_sub(1).map_or(0, |before| ends[before] + 1);
        // A file of one line with many remarks must not be counted through for each.
        let column = source.text[start..span.start].chars().take(MOST_COLUMNS).count() + 1;
        format!("{}:{}:{column}", source.name, line + 1)
    }

    /// The beginning of its tag as in the file: `<bsdf type="hair">`.
    pub fn shown(self) -> String {
        let attributes: String = self
            .node()
            .attributes
            .iter()
            .filter(|(key, _)| matches!(key.as_str(), "type" | "name" | "value"))
            .map(|(key, value)| format!(" {key}=\"{}\"", noisefall_base::quote::piece(value)))
            .collect();
        format!("`<{}{attributes}>`", self.tag())
    }

    /// An error at its place.
    pub fn error(self, message: impl Into<String>, help: impl Into<String>) -> SceneError {
        self.tree.error(&self.node().place, message, help)
    }
}
