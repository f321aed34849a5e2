//! References to materials, textures and files in a description.
use super::walk::{Walk, follows_walk};
use noisefall_base::declare::{Declare, Family, Parameter, Parameters, Path, Textured, Value};

/// Calls `look` with every reference at a path or below it: its path, its family and its name. `look` may change the name.
pub fn references(description: &mut dyn Declare, path: &Path, look: impl FnMut(&Path, Family, &mut String)) {
    let mut searcher = Searcher { walk: Walk::to(path), look };
    description.parameters(&mut searcher);
}

/// The path of the first file below a path that has no name yet.
pub fn nameless_file(description: &mut dyn Declare, path: &Path) -> Option<Path> {
    let mut searcher = FileSearcher { walk: Walk::to(path), found: None };
    description.parameters(&mut searcher);
    searcher.found
}

struct FileSearcher<'p> {
    walk: Walk<'p>,
    found: Option<Path>,
}

impl Parameters for FileSearcher<'_> {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        if self.walk.takes(parameter.key) && matches!(value, Value::File(name) if name.is_empty()) {
            self.found.get_or_insert_with(|| self.walk.path_of(parameter.key));
        }
    }

    follows_walk!();
}

struct Searcher<'p, F> {
    walk: Walk<'p>,
    look: F,
}

impl<F: FnMut(&Path, Family, &mut String)> Parameters for Searcher<'_, F> {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        if !self.walk.takes(parameter.key) {
            return;
        }
        let at = |walk: &Walk<'_>| walk.path_of(parameter.key);
        match value {
            Value::Name(name, family) => (self.look)(&at(&self.walk), family, name),
            Value::Textured(Textured::Texture(name), _) | Value::TexturedNumber(Textured::Texture(name), _) => {
                (self.look)(&at(&self.walk).key("texture"), Family::Texture, name);
            }
            _ => {}
        }
    }

    follows_walk!();
}
