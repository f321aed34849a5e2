//! The materials of a scene by number, as the legend of a picture shows them.
use std::collections::HashMap;

use super::{Object, Scene};

/// Which materials the objects of a scene have.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// Names in the order in which the objects need them; `black` is what objects without a material are.
    pub names: Vec<String>,
    /// The material of every object, as a place among the names.
    pub of_object: Vec<u32>,
}

impl Scene {
    pub fn legend<'s>(&'s self) -> Legend {
        let mut numbers: HashMap<Option<&'s str>, u32> = HashMap::new();
        let mut names = Vec::new();
        let number = |object: &'s Object| {
            let name = object.coating.as_ref().map(|coating| coating.name.as_str());
            *numbers.entry(name).or_insert_with(|| {
                names.push(name.unwrap_or("black").to_owned());
                names.len() as u32 - 1
            })
        };
        let of_object = self.objects.iter().map(number).collect();
        Legend { names, of_object }
    }
}
