//! The light that passes between two vertices.
use fearless_simd_macros::simd;

use super::{
    passage::{Decisions, MOST_CROSSINGS, Passage},
    work::Work,
};
use crate::{
    geometry::Nearest,
    math::{F, Lanes, M, Pick, U, V},
    sampling::Dimension,
};

/// A straight way to a vertex.
pub(super) struct Way<L: Lanes> {
    pub o: V<L>,
    /// Unit.
    pub d: V<L>,
    /// What lies at least as far away is not between.
    pub distance: F<L>,
    /// The primitive and the element there, and nothing else, if rays may meet them from behind.
    pub end: Option<[U<L>; 2]>,
    pub slot: U<L>,
}

impl<L: Lanes> Way<L> {
    /// Lanes whose next surface is the end, or beyond.
    #[inline(always)]
    fn is_open(&self, nearest: &Nearest<L>) -> M<L> {
        let far = nearest.t.ge(self.distance);
        match self.end {
            Some([primitive, element]) => far & nearest.primitive.equals(primitive) & nearest.element.equals(element),
            None => far,
        }
    }
}

/// The fraction of light that arrives along a way in the lanes of `live`: 1 or 0 where every surface stops light. Counts the rays beyond
/// the first one of each way.
#[inline(always)]
pub(super) fn visible_fraction<L: Lanes>(l: L, work: &Work, live: M<L>, way: &Way<L>, reflection: u32, rays: &mut u64) -> F<L> {
    let time = work.time(l, way.slot);
    let nearest = work.scene.shapes.closest(l, live, way.o, way.d, time);
    if work.has_passages() {
        return fraction_through_surfaces(l, work, live, way, nearest, reflection, rays);
    }
    (live & way.is_open(&nearest)).pick(l.f(1.0), l.f(0.0))
}

/// The same where light passes through surfaces, the first of which is `nearest`.
#[simd]
fn fraction_through_surfaces<L: Lanes>(
    l: L,
    work: &Work,
    live: M<L>,
    way: &Way<L>,
    nearest: Nearest<L>,
    reflection: u32,
    rays: &mut u64,
) -> F<L> {
    let scene = work.scene;
    let part = if work.has_blends() { work.stream(l, way.slot).one(Dimension::shadow_blend(reflection)) } else { l.f(0.5) };
    let mut passage = Passage::new(l, [way.o, way.d], work.time(l, way.slot), nearest);
    let (mut open, mut passed, mut arrives) = (live, l.f(1.0), l.first(0));
    for crossed in 0..=MOST_CROSSINGS {
        arrives = arrives | (open & way.is_open(&passage.nearest()));
        let is_before = passage.nearest().t.lt(way.distance);
        let hit = passage.hits(open & is_before & !arrives);
        let crossing = passage.crossing(l, scene, hit);
        let (alpha, _) = crossing.opacity(l, scene, hit, Decisions::Random.of_crossing(part, crossed), Decisions::Random);
        passed = (hit & !crossing.again).pick(passed * (1.0 - alpha), passed);
        open = hit & passed.above(0.0);
        if crossed == MOST_CROSSINGS || !open.any() {
            break;
        }
        *rays += open.count() as u64;
        passage.cross(l, scene, open, &crossing);
    }
    arrives.pick(passed, l.f(0.0))
}
