//! Moves, turns and scales objects and lights.
use glam::{DAffine3, DVec3};

use super::{Document, Edit, tree::Tree};
use noisefall_base::declare::{OwnedValue, Path};
use noisefall_scene::shape::{PointMap, Transform, product, tidied};

/// Largest difference of two unit axes that count as the same.
const SAME_AXIS: f64 = 1e-9;
/// Smallest translation, as a fraction of the distance of the pivot; smaller ones come from rounding.
const ROUNDING: f64 = 1e-12;

impl Document {
    /// The edit that transforms an object in world space, turning and scaling about a pivot. It changes the numbers that a person would
    /// change: the points of shapes without transforms, else the last transforms of the list. `None` if there is no such object, or if
    /// the transform cannot be inverted.
    pub fn transformed(&self, object: usize, change: &Transform, pivot: DVec3) -> Option<Edit> {
        let at = Path::of("objects").item(object);
        let described = self.description().objects.get(object)?;
        let about = DAffine3::from_translation(pivot);
        let map = about * product(std::slice::from_ref(change)).ok()? * about.inverse();
        let by = PointMap { change, map: &map };
        let points = described.transform.is_empty().then(|| described.shape.kind().transformed(&by)).flatten();
        Some(match points {
            Some(points) => {
                let at = at.key("shape").key(described.shape.name());
                let set = |(key, value): (&str, OwnedValue)| Edit::set(at.join(&Path::of(key)), value);
                Edit::All(points.into_iter().map(set).collect())
            }
            None => list(&described.transform, &at.key("transform"), change, &map, ROUNDING * pivot.length()),
        })
    }

    /// The edit that transforms a punctual light in world space. Its intensity stays.
    pub fn transformed_light(&self, punctual_light: usize, change: &Transform, pivot: DVec3) -> Option<Edit> {
        let at = Path::of("lights").item(punctual_light);
        let described = self.description().punctual_lights.get(punctual_light)?;
        let about = DAffine3::from_translation(pivot);
        let map = about * product(std::slice::from_ref(change)).ok()? * about.inverse();
        if !described.transform.is_empty() || map.matrix3.determinant() < 0.0 {
            return Some(list(&described.transform, &at.key("transform"), change, &map, ROUNDING * pivot.length()));
        }
        let at = at.key(described.kind.name());
        let kind = described.kind.kind();
        let points = kind.moved(&DAffine3::IDENTITY).into_iter().zip(kind.moved(&map));
        let set = |((key, before), (_, after))| Edit::set(at.key(key), OwnedValue::Vector(tidied(before, after)));
        Some(Edit::All(points.map(set).collect()))
    }
}

/// The edit of a list of transforms: turning and scaling come before the last translation.
fn list(transforms: &[Transform], at: &Path, change: &Transform, map: &DAffine3, rounding: f64) -> Edit {
    let (before, translation) = match transforms.split_last() {
        Some((Transform::Translate(by), before)) => (before, Some(*by)),
        _ => (transforms, None),
    };
    let mut edits = Vec::new();
    let mut count = before.len();
    if !matches!(change, Transform::Translate(_)) {
        let last = before.last().and_then(|last| Some((at.item(count - 1), combined(last, change)?)));
        match last {
            Some((at, (key, value))) => edits.push(Edit::set(at.join(&Path::of(key)), value)),
            None => {
                edits.push(Edit::insert_tree(at.item(count), Tree::of(&mut change.clone())));
                count += 1;
            }
        }
    }
    let start = translation.unwrap_or(DVec3::ZERO);
    let moved = tidied(start, map.transform_point3(start));
    match translation {
        Some(_) => edits.push(Edit::set(at.item(count).key("translate"), OwnedValue::Vector(moved))),
        None if moved.length() > rounding => {
            edits.push(Edit::insert_tree(at.item(count), Tree::of(&mut Transform::Translate(moved))));
        }
        None => {}
    }
    Edit::All(edits)
}

/// The value of one transform that equals two in succession.
fn combined(first: &Transform, then: &Transform) -> Option<(&'static str, OwnedValue)> {
    match (first, then) {
        (Transform::Scale(first), Transform::Scale(then)) => Some(("scale", OwnedValue::Vector(tidied(*first, *first * *then)))),
        (Transform::Rotate(first), Transform::Rotate(then)) => {
            let axes = [first.axis.try_normalize()?, then.axis.try_normalize()?];
            let is_same = axes[0].distance(axes[1]) < SAME_AXIS;
            let sum = tidied(DVec3::splat(first.degrees), DVec3::splat(first.degrees + then.degrees)).x;
            is_same.then_some(("rotate.degrees", OwnedValue::Number(sum)))
        }
        _ => None,
    }
}
