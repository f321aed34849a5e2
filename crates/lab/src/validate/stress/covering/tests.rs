//! Covering arrays contain what they claim.
use std::collections::BTreeSet;

use super::{
    array::{Factor, Row, covering_array},
    frame::Frame,
};
use crate::validate::stress::dice::Dice;
use noisefall_base::declare::OneOf;
use noisefall_scene::{
    light::{emission::EmissionSource, environment::EnvironmentDescription, punctual_light::PunctualLightKind},
    material::Material,
    sampling::{Filter, Sampler},
    scene::{Estimator, Projection, Reuse, Roulette},
    shape::{ShapeKind, Transform},
    texture::TextureKind,
};

fn factor(levels: usize, parent: Option<(usize, usize)>) -> Factor {
    Factor { levels, parent, is_choice: false }
}

/// All combinations of the levels of `strength` factors in a row.
fn of_row(row: &Row, strength: usize) -> BTreeSet<Vec<(usize, usize)>> {
    let levels: Vec<(usize, usize)> = row.iter().enumerate().filter_map(|(f, level)| Some((f, (*level)?))).collect();
    let mut all = BTreeSet::from([Vec::new()]);
    for _ in 0..strength {
        let longer = |some: &Vec<(usize, usize)>| {
            let next = levels.iter().filter(|level| some.last().is_none_or(|last| last.0 < level.0));
            next.map(|level| [some.as_slice(), &[*level]].concat()).collect::<Vec<_>>()
        };
        all = all.iter().flat_map(longer).collect();
    }
    all
}

/// Every row that there could be.
fn all_rows(factors: &[Factor]) -> Vec<Row> {
    let mut rows: Vec<Row> = vec![Vec::new()];
    for factor in factors {
        let longer = |row: &Row| -> Vec<Row> {
            let exists = factor.parent.is_none_or(|(parent, level)| row[parent] == Some(level));
            let levels = if exists { (0..factor.levels).map(Some).collect() } else { vec![None] };
            levels.into_iter().map(|level| [row.as_slice(), &[level]].concat()).collect()
        };
        rows = rows.iter().flat_map(longer).collect();
    }
    rows
}

/// A choice between three, two of which have parameters, and things beside it.
fn some_factors() -> Vec<Factor> {
    let roots = [factor(3, None), factor(4, None), factor(2, None)];
    let below = [factor(2, Some((0, 1))), factor(3, Some((0, 2))), factor(2, Some((4, 2))), factor(2, None), factor(5, None)];
    roots.into_iter().chain(below).collect()
}

fn is_covered(strength: usize, refuses: impl Fn(&Row) -> Option<Vec<(usize, usize)>> + Copy, most: usize) {
    let factors = some_factors();
    let array = covering_array(&factors, strength, &mut Dice::new("array", 1), refuses);
    let rows = all_rows(&factors);
    assert!(array.rows.iter().all(|row| rows.contains(row) && refuses(row).is_none()));
    let possible = rows.iter().filter(|row| refuses(row).is_none()).flat_map(|row| of_row(row, strength));
    let possible: BTreeSet<_> = possible.collect();
    let covered: BTreeSet<_> = array.rows.iter().flat_map(|row| of_row(row, strength)).collect();
    assert_eq!(covered, possible);
    assert_eq!(array.covered, possible.len());
    assert!(array.rows.len() <= most, "{} rows", array.rows.len());
}

#[test]
fn all_pairs_and_all_triples_are_in_few_rows() {
    is_covered(2, |_| None, 40);
    is_covered(3, |_| None, 150);
}

#[test]
fn refused_combinations_are_left_out_and_all_others_are_there() {
    let refuses = |row: &Row| {
        let sets = [vec![(1, 3), (2, 1)], vec![(4, 1), (6, 0), (7, 4)]];
        sets.into_iter().find(|set| set.iter().all(|(factor, level)| row[*factor] == Some(*level)))
    };
    is_covered(2, refuses, 42);
    is_covered(3, refuses, 160);
}

#[test]
fn rows_are_functions_of_the_seed() {
    let rows = |seed| covering_array(&some_factors(), 2, &mut Dice::new("array", seed), |_| None).rows;
    assert!(rows(3) == rows(3) && rows(3) != rows(4));
}

#[test]
fn parameters_of_two_kinds_are_not_combined() {
    let of_kinds = |is_choice: bool| {
        let choices = [3, 4].map(|levels| Factor { is_choice, ..factor(levels, None) });
        let parameters = (0..3).map(|kind| factor(6, Some((0, kind)))).chain((0..4).map(|kind| factor(6, Some((1, kind)))));
        let factors: Vec<Factor> = choices.into_iter().chain(parameters).collect();
        covering_array(&factors, 2, &mut Dice::new("array", 1), |_| None).rows.len()
    };
    // Every parameter with every kind: 3 · 4 · 6. Every parameter with every other one: 3 · 4 · 6².
    assert!((72..100).contains(&of_kinds(true)) && of_kinds(false) >= 432, "{} {}", of_kinds(true), of_kinds(false));
}

/// A new kind is a level, and its parameters are factors.
#[test]
fn factors_are_those_of_the_declarations() {
    let frame = Frame::new().expect("the plain scene compiles");
    let levels = |path: &str| {
        let found = frame.factors.iter().find(|factor| factor.path == path);
        found.unwrap_or_else(|| panic!("{path} varies")).levels.len()
    };
    for (path, count) in [
        ("materials.subject.material:", Material::alternatives().len()),
        ("textures.subject.texture:", TextureKind::alternatives().len()),
        ("objects.1.shape.shape:", ShapeKind::alternatives().len()),
        ("objects.2.shape.shape:", ShapeKind::alternatives().len()),
        ("objects.2.emission.emission:", EmissionSource::alternatives().len()),
        ("objects.1.transform.0.transform:", Transform::alternatives().len()),
        ("lights.0.light:", PunctualLightKind::alternatives().len()),
        ("environment.environment:", EnvironmentDescription::alternatives().len()),
        ("camera.projection.projection:", Projection::alternatives().len()),
        ("camera.filter.filter:", Filter::alternatives().len()),
        ("render.roulette.roulette:", Roulette::alternatives().len()),
        ("render.estimator", Estimator::ALL.len()),
        ("render.sampler", Sampler::ALL.len()),
        ("render.reuse", Reuse::ALL.len()),
        ("render.adaptive", 2),
        ("camera.lens?", 2),
        ("materials.subject.opacity?", 2),
        ("materials.subject.opacity~", 2),
        ("materials.subject.blend.weight~", 2),
        ("materials.subject.dielectric.transmittance", 2),
        ("materials.subject.lambertian.albedo~", 2),
        ("objects.1.transform.0.scale-", 2),
    ] {
        assert_eq!(levels(path), count, "{path}");
    }
    let places: BTreeSet<_> = frame.factors.iter().map(|factor| (&factor.path, factor.factor.parent)).collect();
    assert_eq!(places.len(), frame.factors.len(), "a factor has a place of its own");
    assert!(frame.factors.iter().all(|factor| factor.factor.parent.is_none_or(|(parent, _)| !frame.factors[parent].is_number)));
}
