//! The materials of a scene by number, for the legend of a view.
use std::collections::HashMap;

use super::{Object, Scene};

/// The materials of the objects of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// Names of the materials, in the order of the first objects that use them. Objects without a material are `black`.
    pub names: Vec<String>,
    /// The material of every object, as an index into the names.
    pub of_object: Vec<u32>,
}

impl Scene {
    /// The names of the materials with their colours.
    pub fn legend(&self) -> Legend {
        let mut numbers: HashMap<Option<u32>, u32> = HashMap::new();
        let mut names = Vec::new();
        let number = |object: &Object| {
            *numbers.entry(object.material).or_insert_with(|| {
                names.push(self.material(object).map_or("black", |material| material.name.as_str()).to_owned());
                names.len() as u32 - 1
            })
        };
        let of_object = self.objects.iter().map(number).collect();
        Legend { names, of_object }
    }
}
