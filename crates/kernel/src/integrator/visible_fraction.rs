//! The light that passes between two vertices.
use fearless_simd_macros::simd;

use super::{
    transparent_ray::{MOST_CROSSINGS, TransparentRay},
    work::Work,
};
use noisefall_base::math::{F, Lanes, M, Pick, U, V};
use noisefall_scene::geometry::Nearest;

/// A ray that meets a surface from behind may do so shortly before the point that is stored of it. Of a surface that is not convex it may
/// meet another part first.
const NEARLY: f32 = 0.999;

/// A straight way between two vertices.
pub(super) struct Segment<L: Lanes> {
    pub o: V<L>,
    /// Unit.
    pub d: V<L>,
    pub distance: F<L>,
    /// The primitive and the element of the second vertex, which the ray has to meet; `None` if it is in free space, as at the camera.
    pub end: Option<[U<L>; 2]>,
    pub slot: U<L>,
}

impl<L: Lanes> Segment<L> {
    /// Lanes where nothing lies before the end if this is the next surface.
    #[inline(always)]
    fn is_open(&self, nearest: &Nearest<L>) -> M<L> {
        match self.end {
            Some([primitive, element]) => {
                let same = nearest.primitive.equals(primitive) & nearest.element.equals(element);
                same & nearest.t.ge(self.distance * NEARLY)
            }
            None => nearest.t.ge(self.distance),
        }
    }
}

/// The fraction of light that arrives along a segment in the lanes of `live`: 1 or 0 where every surface stops light. Counts the rays beyond
/// the first one of each.
#[inline(always)]
pub(super) fn visible_fraction<L: Lanes>(
    l: L,
    work: &Work,
    live: M<L>,
    segment: &Segment<L>,
    reflection: u32,
    rays: &mut u64,
) -> F<L> {
    let time = work.time(l, segment.slot);
    let nearest = work.scene.shapes.closest(l, live, segment.o, segment.d, time);
    if work.has_passages() {
        return fraction_through_surfaces(l, work, live, segment, nearest, reflection, rays);
    }
    (live & segment.is_open(&nearest)).pick(l.f(1.0), l.f(0.0))
}

/// The fraction of light that arrives through surfaces, the first of which is `nearest`.
#[simd]
fn fraction_through_surfaces<L: Lanes>(
    l: L,
    work: &Work,
    live: M<L>,
    segment: &Segment<L>,
    nearest: Nearest<L>,
    reflection: u32,
    rays: &mut u64,
) -> F<L> {
    let scene = work.scene;
    let part = work.shadow_part(l, segment.slot, reflection);
    let mut transparent_ray = TransparentRay::new(l, [segment.o, segment.d], work.time(l, segment.slot), nearest);
    let (mut open, mut passed, mut arrives) = (live, l.f(1.0), l.first(0));
    for crossed in 0..=MOST_CROSSINGS {
        arrives = arrives | (open & segment.is_open(&transparent_ray.nearest()));
        let is_before = transparent_ray.nearest().t.lt(segment.distance);
        let hit = transparent_ray.hits(open & is_before & !arrives);
        let (crossing, alpha) = transparent_ray.crossing_and_opacity(l, scene, hit, part, crossed);
        passed = (hit & !crossing.again).pick(passed * (1.0 - alpha), passed);
        open = hit & passed.above(0.0);
        if crossed == MOST_CROSSINGS || !open.any() {
            break;
        }
        *rays += open.count() as u64;
        transparent_ray.cross(l, scene, open, &crossing);
    }
    arrives.pick(passed, l.f(0.0))
}
