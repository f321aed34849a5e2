//! Textures of several others as a scene describes them: what is refused.
use std::collections::{BTreeMap, BTreeSet};

use crate::texture::{
    TextureCompiler, TextureKind,
    mix::Mix,
    noise::Noise,
    product::Product,
    ramp::{Ramp, Stop},
};
use noisefall_base::declare::{Problem, Resources, Textured};

fn named(name: &str) -> Textured {
    Textured::Texture(name.to_owned())
}

fn noise(high: f64) -> TextureKind {
    Noise { high: [high; 3], ..Noise::default() }.into()
}

/// The problems of named textures.
fn problems(textures: impl IntoIterator<Item = (&'static str, TextureKind)>) -> Vec<Problem> {
    let described: BTreeMap<String, TextureKind> = textures.into_iter().map(|(name, kind)| (name.to_owned(), kind)).collect();
    let (resources, mut problems) = (Resources::new(""), Vec::new());
    TextureCompiler::new(&resources, &described, BTreeSet::new(), std::iter::empty(), &mut problems);
    problems
}

/// The only problem of named textures: its place and message.
fn problem(textures: impl IntoIterator<Item = (&'static str, TextureKind)>) -> (String, String) {
    let mut problems = problems(textures);
    assert_eq!(problems.len(), 1, "{problems:?}");
    let Problem { path, message, label, .. } = problems.remove(0);
    assert!(!label.is_empty(), "{message}");
    (path.to_string(), message)
}

#[test]
fn textures_that_would_take_too_many_lookups_are_refused() {
    let squared = |name: &str| TextureKind::from(Product { a: named(name), b: named(name) });
    let five = [("p0", noise(0.5)), ("p1", squared("p0")), ("p2", squared("p1")), ("p3", squared("p2")), ("p4", squared("p3"))];
    let deep = || five.clone().into_iter().chain([("p5", squared("p4"))]);
    // 2, 6, 14, 30, 62.
    assert_eq!(problems(deep()), []);
    let (place, message) = problem(deep().chain([("p6", squared("p5"))]));
    assert_eq!(place, "textures.p6.product");
    assert_eq!(message, "a lookup of this texture takes 126 lookups of others, more than 64");
}

#[test]
fn fractions_and_products_stay_within_their_range() {
    let mix = Mix { weight: Textured::Texture("n".to_owned()), ..Mix::default() };
    let (place, message) = problem([("m", mix.clone().into()), ("n", noise(5.0))]);
    assert_eq!(
        (place.as_str(), message.as_str()),
        ("textures.m.mix.weight.texture", "`weight` is out of range: texture `n` reaches 5")
    );
    assert_eq!(problems([("m", mix.into()), ("n", noise(1.0))]), []);
    let ramp = Ramp { input: Textured::Texture("n".to_owned()), ..Ramp::default() };
    let (place, _) = problem([("m", ramp.into()), ("n", noise(1.5))]);
    assert_eq!(place, "textures.m.ramp.input.texture");
    let product = Product { a: named("n"), b: named("n") };
    let (place, message) = problem([("m", product.into()), ("n", noise(1e14))]);
    assert_eq!(place, "textures.m.product.b");
    assert!(message.starts_with("the product is out of range"), "{message}");
}

#[test]
fn stops_of_ramps_are_few_and_ascend() {
    let refused = |places: &[f64]| {
        let stops = places.iter().map(|at| Stop { at: *at, color: [0.5; 3] }).collect();
        let mut found = problems([("r", Ramp { stops, ..Ramp::default() }.into())]);
        found.pop().map(|problem| (problem.path.to_string(), problem.message))
    };
    let not_ascending = |place: &str| Some((place.to_owned(), "the stops are not in ascending order".to_owned()));
    assert_eq!(refused(&[0.0, 0.5, 0.5, 1.0]), None);
    assert_eq!(refused(&[0.3]), None);
    assert_eq!(refused(&[0.0, 0.5, 0.25]), not_ascending("textures.r.ramp.stops[2].at"));
    assert_eq!(refused(&[]), Some(("textures.r.ramp.stops".to_owned(), "the ramp has 0 stops".to_owned())));
    assert_eq!(refused(&[0.5; 257]), Some(("textures.r.ramp.stops".to_owned(), "the ramp has 257 stops".to_owned())));
}

#[test]
fn combined_textures_in_a_circle_are_refused() {
    let product = |name: &str| TextureKind::from(Product { a: named(name), b: Textured::grey(0.5) });
    let found = problems([("a", product("b")), ("b", product("a"))]);
    assert!(found.iter().any(|problem| problem.message == "textures in a circle: `a` uses `b` uses `a`"), "{found:?}");
}
