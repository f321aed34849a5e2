//! References to materials and textures in a description.
use super::walk::{Walk, follows_walk};
use crate::declare::{Declare, Family, Parameter, Parameters, Path, Textured, Value};

/// Calls `look` with every reference at a path or below it: its path, its family and its name. `look` may change the name.
pub fn references(description: &mut dyn Declare, path: &Path, look: impl FnMut(&Path, Family, &mut String)) {
    let mut searcher = Searcher { walk: Walk::to(path), look };
    description.parameters(&mut searcher);
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
