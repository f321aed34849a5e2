//! Light selection.
//!
//! A light is chosen in proportion to an estimate of its unoccluded irradiance at the point, E ≈ π L sin²θ · max(cos) over its
//! cone of half angle θ; textured emitters count with their mean radiance (Shirley et al. 1996 discuss good choices). A few
//! lights are weighted one by one. Many lights form a tree, except those of outstanding size.
#[cfg(test)]
mod tests;

use fearless_simd_macros::simd;
use glam::{DVec3, Vec3};

use super::{
    Emission, LightCoordinates, ReferencePoint,
    bound::Bound,
    punctual_light::{MOST_DIRECTIONAL, PunctualLight},
    source::Source,
    tree::{Item, Traversal, Tree, light_of_word, word_of_light},
};
use crate::{
    geometry::{MISS, Motion, Shape},
    sampling::hash::GOLDEN,
};
use noisefall_base::math::{F, Lanes, M, Pick, U};

/// Up to this number of candidates, the choice needs no large table of weights.
const VERY_FEW: usize = 8;
/// Maximum number of lights that are weighted one by one. Compared with the tree, time × relMSE is 1.1 to 1.4 times better for 64
/// lights, equal for 96, and up to 1.15 times worse for 128.
const FEW: usize = 64;
/// If there are more lights, maximum number of those of outstanding size that are weighted one by one.
const LARGE: usize = 16;
/// Number of heads of the tree. With twice as many, a choice takes 15 to 50 % longer, and its variance, about a tenth of that of
/// a light sample, mostly falls by a third.
const HEADS: usize = 32;
const MOST_CANDIDATES: usize = if FEW > LARGE + HEADS { FEW } else { LARGE + HEADS };
/// The tree needs some heads beside the lights that are weighted one by one.
const _: () = assert!(LARGE + MOST_DIRECTIONAL + 8 <= MOST_CANDIDATES);

/// The environment, as a light.
#[derive(Clone, Copy, Default)]
pub(super) struct Sky {
    /// Its mean luminance.
    pub luminance: f32,
    /// Whether it has the same radiance everywhere.
    pub is_even: bool,
}

/// The candidates of a choice: the environment, the lights that are weighted one by one, and the heads of the tree.
#[derive(Default)]
pub(super) struct Selection {
    sky: Sky,
    sources: Vec<Source>,
    tree: Tree,
    /// Words of sources and heads, as in the tree.
    words: Vec<u32>,
}

impl Selection {
    /// Builds the selection. `lights` are the emitting shapes with their motion, and lights are numbered after them. `near` is a point
    /// near the middle of the scene.
    pub fn new(lights: &[(Shape, Motion, Emission)], punctual_lights: &[PunctualLight], sky: Sky, near: DVec3) -> Selection {
        let count = lights.len() + punctual_lights.len();
        let surface = |(shape, motion, emission): &(Shape, Motion, Emission)| Bound::new(shape, motion, emission);
        let (single, tree) = if count <= FEW {
            ((0..count as u32).collect(), Tree::default())
        } else {
            let bounds = lights.iter().map(|light| Some(surface(light))).chain(punctual_lights.iter().map(Bound::of_punctual));
            let (mut items, mut single) = (Vec::new(), Vec::new());
            for (light, bound) in (0..).zip(bounds) {
                match bound {
                    Some(bound) => items.push(Item::new(&bound, light)),
                    // A light without a position has no place in the tree.
                    None => single.push(light),
                }
            }
            let small = items.len() - outstanding(&mut items);
            single.extend(items.drain(small..).map(|item| item.light));
            let tree = Tree::new(&mut items, &single, HEADS.min(MOST_CANDIDATES - single.len()));
            (single, tree)
        };
        let source = |light: &u32| match lights.get(*light as usize) {
            Some(light) => Source::new(&light.0, &surface(light), near),
            None => Source::of_punctual(&punctual_lights[*light as usize - lights.len()]),
        };
        Selection {
            sky,
            sources: single.iter().map(source).collect(),
            words: single.iter().map(|light| word_of_light(*light)).chain(tree.words()).collect(),
            tree,
        }
    }

    pub fn is_without_tree(&self) -> bool {
        self.tree.is_empty()
    }

    /// The weight of the environment.
    #[inline(always)]
    fn sky<L: Lanes>(&self, l: L, at: &ReferencePoint<L>) -> F<L> {
        let Sky { luminance, is_even } = self.sky;
        let Some(lobe) = &at.lobe else { return l.f(luminance) };
        let weight = lobe.of_sky() * luminance;
        if is_even { lobe.is_narrow().pick(l.f(0.0), weight) } else { weight }
    }

    /// Chooses a light, or [`MISS`] for the environment, and returns it with its probability.
    #[simd]
    pub fn choose<L: Lanes>(&self, l: L, at: &ReferencePoint<L>, u: &LightCoordinates<L>) -> (U<L>, F<L>) {
        let chosen = if self.words.len() <= VERY_FEW {
            self.choose_candidate::<L, VERY_FEW>(l, at, u.choice)
        } else {
            self.choose_candidate::<L, MOST_CANDIDATES>(l, at, u.choice)
        };
        let LightChoice { mut word, mut pmf, u: rest } = chosen;
        let sky = word.is(MISS);
        if !self.tree.is_empty() {
            let bits = u.choice.bits() ^ ((u.place.0.bits() + u.place.1.bits() * GOLDEN) * GOLDEN);
            (word, pmf) = self.tree.descend(l, at, &Traversal { inside: !sky, word, u: rest, bits, pmf });
        }
        (sky.pick(word, light_of_word(word)), pmf)
    }

    /// Chooses a candidate. `MOST` is an upper bound on their number.
    #[inline(always)]
    fn choose_candidate<L: Lanes, const MOST: usize>(&self, l: L, at: &ReferencePoint<L>, u: F<L>) -> LightChoice<L> {
        let mut weights = [l.f(0.0); MOST];
        let sky = self.sky(l, at);
        let mut total = sky;
        for (i, weight) in weights.iter_mut().enumerate().take(self.words.len()) {
            *weight = self.weight(l, at, i);
            total = total + *weight;
        }
        // The last candidate whose share begins at or before the chosen place.
        let place = u * total;
        let (mut word, mut chosen, mut begin, mut end) = (l.u(MISS), sky, l.f(0.0), sky);
        for (weight, candidate) in weights.iter().zip(&self.words) {
            let here = place.ge(end) & weight.above(0.0);
            word = here.pick(l.u(*candidate), word);
            chosen = here.pick(*weight, chosen);
            begin = here.pick(end, begin);
            end = end + *weight;
        }
        let pmf = total.above(0.0).pick(chosen / total, l.f(0.0));
        LightChoice { word, pmf, u: ((place - begin) / chosen).max(l.f(0.0)).min(l.f(1.0 - f32::EPSILON)) }
    }

    /// The probability that [`Selection::choose`] chooses the light `target` in the lanes of `emits`, and the environment in the
    /// others.
    #[simd]
    pub fn probability<L: Lanes>(&self, l: L, at: &ReferencePoint<L>, emits: M<L>, target: U<L>) -> F<L> {
        let light = emits.pick(target, l.u(0));
        let (candidate, trail) = if self.tree.is_empty() { (light, light) } else { self.tree.place(l, light) };
        let sky = self.sky(l, at);
        let (mut total, mut chosen, mut word) = (sky, sky, l.u(0));
        for (i, word_here) in self.words.iter().enumerate() {
            let weight = self.weight(l, at, i);
            let here = emits & candidate.is(i as u32);
            chosen = here.pick(weight, chosen);
            word = here.pick(l.u(*word_here), word);
            total = total + weight;
        }
        let pmf = total.above(0.0).pick(chosen / total, l.f(0.0));
        if self.tree.is_empty() { pmf } else { self.tree.follow(l, at, emits, word, trail, pmf) }
    }

    /// The weight of a source or a head.
    #[inline(always)]
    fn weight<L: Lanes>(&self, l: L, at: &ReferencePoint<L>, candidate: usize) -> F<L> {
        match self.sources.get(candidate) {
            Some(source) => source.weight(l, at),
            None => self.tree.head_weight(l, at, candidate - self.sources.len()),
        }
    }
}

/// A chosen candidate.
struct LightChoice<L: Lanes> {
    /// [`MISS`] for the environment.
    word: U<L>,
    pmf: F<L>,
    /// The remainder of the random number, uniform in (0, 1).
    u: F<L>,
}

/// Moves lights as large as the space around all others to the end, and returns their number: any node of the tree with one of
/// them would be as large.
fn outstanding(items: &mut [Item]) -> usize {
    let begin = items.len() - LARGE.min(items.len());
    let by_size = |a: &Item, b: &Item| a.radius.total_cmp(&b.radius).then(a.light.cmp(&b.light));
    if begin > 0 {
        items.select_nth_unstable_by(begin, by_size);
    }
    items[begin..].sort_unstable_by(by_size);
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for (i, item) in items.iter().enumerate() {
        if i >= begin && item.radius > 0.25 * low.distance(high) {
            return items.len() - i;
        }
        low = low.min(item.center);
        high = high.max(item.center);
    }
    0
}
