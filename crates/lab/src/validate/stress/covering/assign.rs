//! Gives a description the levels of a row.
use std::collections::HashMap;

use glam::DVec3;

use super::{
    array::Row,
    factors::{ITEM, KIND, MIRROR, PRESENCE, SceneFactor, TEXTURE},
    place::{Place, SUBJECT, growth, is_left_out},
};
use crate::validate::stress::dice::Dice;
use noisefall_base::declare::{Choice, CountRange, Family, Form, Parameter, Parameters, Range, Textured, Value};

/// The files that scenes name.
pub const MESH: &str = "mesh.obj";
pub const IMAGE: &str = "image.png";
/// The texture that others name.
pub const INNER: &str = "inner";
/// Counts stay small: of triangles, spheres, bounces.
const MOST: u32 = 24;

/// The visitor that gives values their levels. Changed numbers are functions of the path.
pub struct Assign<'a> {
    row: &'a Row,
    by_path: HashMap<&'a str, Vec<usize>>,
    materials: &'a [String],
    place: Place,
    lists: HashMap<String, usize>,
}

impl<'a> Assign<'a> {
    pub fn new(factors: &'a [SceneFactor], row: &'a Row, materials: &'a [String]) -> Self {
        let mut by_path: HashMap<&str, Vec<usize>> = HashMap::new();
        for (number, factor) in factors.iter().enumerate() {
            by_path.entry(&factor.path).or_default().push(number);
        }
        Assign { row, by_path, materials, place: Place::default(), lists: HashMap::new() }
    }

    /// The level of the factor at a path that exists in the row.
    fn level(&self, path: &str) -> Option<usize> {
        self.by_path.get(path)?.iter().find_map(|factor| self.row[*factor])
    }

    /// The name of the texture that a value of the current table gets: within textures another one.
    fn texture(&self) -> String {
        if self.place.is_within("textures") { INNER } else { SUBJECT }.to_owned()
    }

    /// Whether a factor beside the value of a path is on.
    fn is_on(&self, path: &str, suffix: &str) -> bool {
        self.level(&(path.to_owned() + suffix)) == Some(1)
    }

    fn file(&self, parameter: &Parameter) -> String {
        let is_mesh = self.place.is_within("objects") && parameter.key == "path";
        if is_mesh { MESH } else { IMAGE }.to_owned()
    }
}

impl Parameters for Assign<'_> {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        let path = self.place.path_of(parameter.key);
        let level = self.level(&path).unwrap_or(0);
        let mut dice = Dice::new(&path, 0);
        match value {
            Value::Flag(flag) => *flag = self.level(&path).map_or(*flag, |level| level == 1),
            Value::Word(word, _) => *word = self.level(&path).unwrap_or(*word),
            Value::Name(name, Family::Texture) if name.is_empty() => *name = self.texture(),
            Value::Name(name, Family::Material) if name.is_empty() => name.clone_from(&self.materials[level]),
            Value::File(file) if file.is_empty() => *file = self.file(parameter),
            Value::Textured(textured, _) if self.is_on(&path, TEXTURE) => *textured = Textured::Texture(self.texture()),
            Value::TexturedNumber(textured, _) if self.is_on(&path, TEXTURE) => *textured = Textured::Texture(self.texture()),
            Value::Count(count, range) => *count = counted(*count, level, &range),
            Value::Factors(factors) => {
                let is_direction = self.place.is_within("environment");
                *factors *= match level {
                    0 => DVec3::ONE,
                    // Directions are not distorted.
                    _ if is_direction => DVec3::splat(dice.within(0.7, 1.3)),
                    _ => vector(&mut dice, 0.7, 1.3),
                };
                factors.x *= if self.is_on(&path, MIRROR) { -1.0 } else { 1.0 };
            }
            _ if level == 0 || is_left_out(parameter) => {}
            Value::Textured(Textured::Constant(rgb), range) | Value::Colour(rgb, range) => {
                *rgb = rgb.map(|x| near(&mut dice, x, parameter, &range));
            }
            Value::TexturedNumber(Textured::Constant(number), range) | Value::Number(number, range) => {
                *number = near(&mut dice, *number, parameter, &range);
            }
            Value::Point(point) | Value::Vector(point) => *point += vector(&mut dice, -0.2, 0.2),
            Value::Pair([a, b]) => (*a, *b) = (*a + 0.1, *b - 0.1),
            Value::Matrix(rows) if self.place.is_within("environment") => rows.swap(0, 1),
            Value::Matrix(rows) => rows[0][1] += dice.within(0.1, 0.4),
            _ => {}
        }
    }

    fn enter(&mut self, parameter: &Parameter, _: Form) {
        self.place.enter(parameter);
    }

    fn leave(&mut self) {
        self.place.leave();
    }

    fn skips(&self) -> bool {
        self.place.is_fixed()
    }

    fn present(&mut self, parameter: &Parameter, now: bool) -> bool {
        self.level(&(self.place.path_of(parameter.key) + PRESENCE)).map_or(now, |level| level == 1)
    }

    fn choose(&mut self, choice: &Choice, now: usize) -> usize {
        self.level(&(self.place.path_of(choice.what) + KIND)).unwrap_or(now)
    }

    fn items(&mut self, parameter: &Parameter, now: usize) -> usize {
        let path = self.place.path_of(parameter.key);
        let further = (now..now + growth(&self.place, now)).take_while(|item| self.is_on(&format!("{path}.{item}"), ITEM));
        let count = now + further.count();
        self.lists.insert(path, now);
        count
    }

    fn item(&mut self, parameter: &Parameter, index: usize) {
        let now = self.lists.get(&self.place.path_of(parameter.key)).copied().unwrap_or(0);
        let is_fixed = index < now && !(self.place.is_top() && index > 0);
        self.place.enter_item(parameter, index, is_fixed);
    }

    fn named(&mut self, parameter: &Parameter, name: &str) {
        self.place.enter_named(parameter, name);
    }

    fn reads_outlines(&self) -> bool {
        false
    }
}

fn counted(count: u32, level: usize, range: &CountRange) -> u32 {
    let most = MOST.max(range.least);
    if level == 0 { count.min(most) } else { (count.min(most - 1) + 1).min(range.most) }
}

fn vector(dice: &mut Dice, least: f64, most: f64) -> DVec3 {
    DVec3::new(dice.within(least, most), dice.within(least, most), dice.within(least, most))
}

/// A number that is as usual as the default: in the middle of a narrow range, otherwise of the same size.
fn near(dice: &mut Dice, default: f64, parameter: &Parameter, range: &Range) -> f64 {
    let Range { least, most, .. } = *range;
    let number = if most - least <= 2.0 {
        least + (most - least) * dice.within(0.25, 0.75)
    } else if parameter.unit == "°" {
        default + dice.within(8.0, 35.0)
    } else if default == 0.0 {
        dice.within(0.05, 0.3)
    } else if default.abs() <= 1.0 {
        // Fractions stay fractions.
        default * dice.within(0.7, 0.95)
    } else {
        default * dice.within(0.75, 1.3)
    };
    number.clamp(least, most)
}
