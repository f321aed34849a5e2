//! The visitor of the files that a description names.
use super::{Declare, Parameter, Parameters, Value};

/// Calls a function with the path of each file that a description names, which it may replace.
pub fn for_each_file(description: &mut dyn Declare, visit: &mut dyn FnMut(&mut String)) {
    description.parameters(&mut FileVisitor(visit));
}

struct FileVisitor<'f>(&'f mut dyn FnMut(&mut String));

impl Parameters for FileVisitor<'_> {
    fn value(&mut self, _: &Parameter, value: Value<'_>) {
        if let Value::File(path) = value {
            (self.0)(path);
        }
    }
}
